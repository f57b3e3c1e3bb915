// Plots two or three axes of a device against each other, with the path behind them; in a recording also the path that
// lies ahead.
import { html, useEffect, useRef, useState } from './preact.js';
import { drawFlat, drawTurned } from './plane_drawing.js';
import { askQuietly, onLook, store, unwant, valueOf, want } from './store.js';
import { Button, Choice, grouped } from './small.js';
import { useKept } from './kept.js';

const kMaxPlaces = 6000;
const kMaxAxes = 24;  // whose paths are kept
const kDots = 3000;

// For each device with several axes: where they have been since the page was opened.
let of = null;
const paths = new Map();

/// Called whenever the page is drawn, whichever panel is visible.
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

/// The whole path of a recording; the time of each place follows its coordinates.
function useRecordedPath(device, axes) {
  const [path, setPath] = useState([]);
  useEffect(() => {
    if (!store.timeline) return;
    const { begin_ns, end_ns } = store.timeline;
    const names = axes.map((axis) => `${device.name}.${axis}.position`);
    askQuietly({ do: 'curves', names, from_ns: begin_ns, to_ns: end_ns, dots: kDots }).then((reply) => {
      if (!reply.ok) return;
      const at = (row, i) => (reply.curves[row].least[i] + reply.curves[row].greatest[i]) / 2;
      setPath(reply.curves[0].least.map((_, i) => [...axes.map((_, row) => at(row, i)), begin_ns + (end_ns - begin_ns) * (i + 0.5) / kDots]));
    });
  }, [device.name, axes.join(), store.timeline]);
  return path;
}

const kStraight = { yaw: -0.6, pitch: 0.5 };

/// Turns the picture of three axes by dragging it, or with the arrow keys.
function useTurning(key) {
  const [turned, turn] = useKept(`turned ${key}`, kStraight);
  const by = (across, upwards) => turn({ yaw: turned.yaw + across, pitch: Math.max(-1.55, Math.min(1.55, turned.pitch + upwards)) });
  const hands = {
    tabindex: 0,
    onPointerDown: (event) => event.currentTarget.setPointerCapture(event.pointerId),
    onPointerMove: (event) => { if (event.currentTarget.hasPointerCapture(event.pointerId)) by(event.movementX * 0.01, event.movementY * 0.01); },
    onDblClick: () => turn(kStraight),
    onKeyDown: (event) => {
      const way = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
      if (!way) return;
      event.preventDefault();
      by(way[0], way[1]);
    },
  };
  return [turned, hands];
}

export function Plane({ device }) {
  const names = device.axes.map((axis) => axis.name);
  const [axes, choose] = useKept(`plane of ${device.name}`, [names[0], names[1]]);
  const [isWhole, setWhole] = useKept(`whole travel of ${device.name}`, false);
  const [turned, hands] = useTurning(device.name);
  const [across, upwards, deep] = axes;
  const canvas = useRef(null);
  const recorded = useRecordedPath(device, axes);
  const now = axes.map((axis) => valueOf(`${device.name}.${axis}.position`));

  useEffect(() => {
    if (!canvas.current || now.some((coordinate) => typeof coordinate !== 'number')) return;
    const isBehind = (place) => place[axes.length] <= store.look.time_ns;
    const columns = axes.map((axis) => names.indexOf(axis));
    const behind = store.timeline ? recorded.filter(isBehind)
      : (paths.get(device.name)?.places ?? []).map((place) => columns.map((column) => place[column]));
    const ahead = store.timeline ? recorded.filter((place) => !isBehind(place)) : [];
    const machines = axes.map((axis) => device.axes.find(({ name }) => name === axis).machine);
    const picture = { behind: [...behind, now], ahead, at: now, machines, isWhole, axes };
    deep ? drawTurned(canvas.current, picture, turned) : drawFlat(canvas.current, picture);
  });

  const options = (others) => names.filter((name) => !others.includes(name));
  return html`<figure class="plane" aria-label=${`${axes.join(', ')} ${deep ? 'in space' : 'in a plane'}`}>
    <canvas ref=${canvas} width="960" height="720" role="img" ...${deep ? hands : {}} class=${deep ? 'turnable' : ''}
      title=${deep ? 'drag it, or use the arrow keys, to turn it; double-click to turn it back' : undefined}
      aria-label=${axes.map((axis, i) => `${axis} ${grouped(now[i])}`).join(', ')}></canvas>
    <figcaption class="bar">
      <${Choice} label="axis to the right" value=${across} options=${options([upwards, deep])} takes=${(name) => choose([name, ...axes.slice(1)])} />
      <${Choice} label="axis upwards" value=${upwards} options=${options([across, deep])} takes=${(name) => choose([across, name, ...axes.slice(2)])} />
      ${names.length > 2 && html`<${Choice} label="third axis" value=${deep ?? ''} options=${[['', 'flat'], ...options([across, upwards])]}
        takes=${(name) => choose([across, upwards, name].filter(Boolean))} />`}
      <${Button} kind="small" title="show the whole travel" pressed=${isWhole} does=${() => setWhole(!isWhole)}>travel<//>
      ${!store.timeline && html`<${Button} kind="small" title="clear the path" does=${() => paths.get(device.name)?.places.splice(0)}>clear<//>`}
      <small>pulses</small>
    </figcaption>
  </figure>`;
}
