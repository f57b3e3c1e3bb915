// Plots two axes of a device against each other, with the path behind them; in a recording also the path that lies ahead.
import { html, useEffect, useRef, useState } from './preact.js';
import { askQuietly, onLook, store, unwant, valueOf, want } from './store.js';
import { Button, Choice, grouped } from './small.js';
import { useKept } from './kept.js';

const kMaxPlaces = 6000;
const kMaxAxes = 24;  // whose paths are kept
const kDots = 3000;

// Of each device with several axes where all of them have been, since the page was opened.
let of = null;
const paths = new Map();

/// Whatever panel is in view. Called whenever the page is drawn.
export function keepPaths() {
  if (of === store.bench) return;
  of = store.bench;
  paths.clear();
  let axes = 0;
  for (const device of Object.values(store.devices)) {
    axes += device.axes.length;
    if (of && !store.timeline && device.axes.length > 1 && axes <= kMaxAxes) paths.set(device.name, { names: device.axes.map((axis) => axis.name), places: [] });
  }
  const names = [...paths].flatMap(([device, path]) => path.names.map((axis) => `${device}.${axis}.position`));
  names.length > 0 ? want('paths', names) : unwant('paths');
}

onLook(() => {
  for (const [device, { names, places }] of paths) {
    const place = names.map((axis) => valueOf(`${device}.${axis}.position`));
    if (place.some((coordinate) => typeof coordinate !== 'number')) continue;
    if (places.at(-1)?.join() !== place.join()) places.push(place);
    if (places.length > kMaxPlaces) places.splice(0, kMaxPlaces / 10);
  }
});

/// Of a recording the whole path, with the time of each place.
function useRecordedPath(device, axes) {
  const [path, setPath] = useState([]);
  useEffect(() => {
    if (!store.timeline) return;
    const { begin_ns, end_ns } = store.timeline;
    const names = axes.map((axis) => `${device.name}.${axis}.position`);
    askQuietly({ do: 'curves', names, from_ns: begin_ns, to_ns: end_ns, dots: kDots }).then((reply) => {
      if (!reply.ok) return;
      const at = (row, i) => (reply.curves[row].least[i] + reply.curves[row].greatest[i]) / 2;
      setPath(reply.curves[0].least.map((_, i) => [at(0, i), at(1, i), begin_ns + (end_ns - begin_ns) * (i + 0.5) / kDots]));
    });
  }, [device.name, axes.join(), store.timeline]);
  return path;
}

export function Plane({ device }) {
  const names = device.axes.map((axis) => axis.name);
  const [axes, choose] = useKept(`plane of ${device.name}`, [names[0], names[1]]);
  const [across, upwards] = axes;
  const canvas = useRef(null);
  const recorded = useRecordedPath(device, axes);
  const now = axes.map((axis) => valueOf(`${device.name}.${axis}.position`));

  useEffect(() => {
    if (!canvas.current || now.some((coordinate) => typeof coordinate !== 'number')) return;
    if (store.timeline) {
      const isBehind = (place) => place[2] <= store.look.time_ns;
      drawPaths(canvas.current, [...recorded.filter(isBehind), now], recorded.filter((place) => !isBehind(place)), now);
      return;
    }
    const [x, y] = axes.map((axis) => names.indexOf(axis));
    const places = paths.get(device.name)?.places ?? [];
    drawPaths(canvas.current, [...places.map((place) => [place[x], place[y]]), now], [], now);
  });

  return html`<figure class="plane" aria-label=${`${across} and ${upwards} in a plane`}>
    <canvas ref=${canvas} width="960" height="720" role="img"
      aria-label=${`${across} ${grouped(now[0])}, ${upwards} ${grouped(now[1])}`}></canvas>
    <figcaption class="bar">
      <${Choice} label="axis to the right" value=${across} options=${names} takes=${(name) => choose([name, upwards])} />
      <${Choice} label="axis upwards" value=${upwards} options=${names} takes=${(name) => choose([across, name])} />
      ${!store.timeline && html`<${Button} kind="small" title="clear the path" does=${() => paths.get(device.name)?.places.splice(0)}>clear<//>`}
      <small>pulses</small>
    </figcaption>
  </figure>`;
}

const kRoom = 44;  // for the numbers at the edges

/// A round number of pulses between two lines.
function stepOf(rough) {
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((factor) => factor * power).find((it) => it >= rough);
}

function drawPaths(canvas, behind, ahead, at) {
  const look = getComputedStyle(canvas);
  const colour = (name) => look.getPropertyValue(name).trim();
  const context = canvas.getContext('2d');
  const { width, height } = canvas;
  context.clearRect(0, 0, width, height);
  const all = [...behind, ...ahead];
  const span = (number) => all.reduce(([low, high], place) => [Math.min(low, place[number]), Math.max(high, place[number])], [Infinity, -Infinity]);
  const [[left, right], [low, high]] = [span(0), span(1)];
  // Pulses per pixel, in both directions; in steps, so that it does not change with each picture.
  const rough = Math.max((right - left) / (width - 4 * kRoom), (high - low) / (height - 4 * kRoom), 200 / width);
  const size = 2 ** (Math.ceil(Math.log2(rough) * 2) / 2);
  const x = (pulses) => width / 2 + (pulses - (left + right) / 2) / size;
  const y = (pulses) => height / 2 - (pulses - (low + high) / 2) / size;
  const step = stepOf(size * 150);
  context.font = '26px system-ui, sans-serif';
  context.lineWidth = 1;
  const first = (middle, dots) => Math.ceil((middle - dots / 2 * size) / step) * step;
  for (let place = first((left + right) / 2, width); x(place) < width; place += step) {
    context.fillStyle = colour(place === 0 ? '--edge' : '--line');
    context.fillRect(Math.round(x(place)), 0, place === 0 ? 2 : 1, height);
    context.fillStyle = colour('--faint');
    context.fillText(grouped(place + 0), x(place) + 5, height - 8);
  }
  for (let place = first((low + high) / 2, height); y(place) > 0; place += step) {
    context.fillStyle = colour(place === 0 ? '--edge' : '--line');
    context.fillRect(0, Math.round(y(place)), width, place === 0 ? 2 : 1);
    context.fillStyle = colour('--faint');
    if (y(place) < height - 40) context.fillText(grouped(place + 0), 6, y(place) - 6);
  }
  const line = (path, name, wide) => {
    context.strokeStyle = colour(name);
    context.lineWidth = wide;
    context.beginPath();
    path.forEach((place, i) => (i === 0 ? context.moveTo : context.lineTo).call(context, x(place[0]), y(place[1])));
    context.stroke();
  };
  line([at, ...ahead], '--edge', 2);
  line(behind, '--c0', 4);
  context.fillStyle = colour('--ink');
  context.beginPath();
  context.arc(x(at[0]), y(at[1]), 9, 0, 7);
  context.fill();
}
