// Plots two axes of a device against each other, with the path behind them.
import { html, useEffect, useRef } from './preact.js';
import { onLook, valueOf } from './store.js';
import { Button, Choice, grouped } from './small.js';
import { useKept } from './kept.js';

const kMaxPlaces = 6000;

export function Plane({ device }) {
  const names = device.axes.map((axis) => axis.name);
  const [[across, upwards], choose] = useKept(`plane of ${device.name}`, [names[0], names[1]]);
  const canvas = useRef(null);
  const trail = useRef([]);

  useEffect(() => {
    trail.current = [];
    const paint = () => {
      const place = [across, upwards].map((axis) => valueOf(`${device.name}.${axis}.position`));
      if (place.some((coordinate) => typeof coordinate !== 'number')) return;
      const last = trail.current.at(-1);
      if (!last || last[0] !== place[0] || last[1] !== place[1]) trail.current.push(place);
      if (trail.current.length > kMaxPlaces) trail.current.splice(0, kMaxPlaces / 10);
      if (canvas.current) drawTrail(canvas.current, trail.current);
    };
    paint();
    return onLook(paint);
  }, [device.name, across, upwards]);

  const last = trail.current.at(-1) ?? [0, 0];
  return html`<figure class="plane" aria-label=${`${across} and ${upwards} in a plane`}>
    <canvas ref=${canvas} width="480" height="360" role="img"
      aria-label=${`${across} ${grouped(last[0])}, ${upwards} ${grouped(last[1])}`}></canvas>
    <figcaption class="bar">
      <${Choice} label="axis to the right" value=${across} options=${names} takes=${(name) => choose([name, upwards])} />
      <${Choice} label="axis upwards" value=${upwards} options=${names} takes=${(name) => choose([across, name])} />
      <${Button} kind="small" title="clear the path" does=${() => { trail.current = []; }}>clear<//>
    </figcaption>
  </figure>`;
}

function drawTrail(canvas, trail) {
  const look = getComputedStyle(canvas);
  const context = canvas.getContext('2d');
  const { width, height } = canvas;
  context.clearRect(0, 0, width, height);
  if (trail.length === 0) return;
  const span = (number) => {
    const all = trail.map((place) => place[number]);
    return [Math.min(...all), Math.max(...all)];
  };
  const [[left, right], [low, high]] = [span(0), span(1)];
  const size = Math.max((right - left) / width, (high - low) / height, 1 / width) * 1.15;  // pulses per pixel, in both directions
  const x = (pulses) => width / 2 + (pulses - (left + right) / 2) / size;
  const y = (pulses) => height / 2 - (pulses - (low + high) / 2) / size;
  context.strokeStyle = look.getPropertyValue('--line');
  context.lineWidth = 1;
  context.beginPath();
  for (const [fromX, fromY, toX, toY] of [[x(0), 0, x(0), height], [0, y(0), width, y(0)]]) {
    context.moveTo(fromX, fromY);
    context.lineTo(toX, toY);
  }
  context.stroke();
  context.strokeStyle = look.getPropertyValue('--c0');
  context.lineWidth = 2;
  context.beginPath();
  trail.forEach((place, i) => (i === 0 ? context.moveTo(x(place[0]), y(place[1])) : context.lineTo(x(place[0]), y(place[1]))));
  context.stroke();
  const at = trail.at(-1);
  context.fillStyle = look.getPropertyValue('--ink');
  context.beginPath();
  context.arc(x(at[0]), y(at[1]), 5, 0, 7);
  context.fill();
}
