// Draws the path of two or three axes on a canvas, with a scale, the travel of the machine and its limit switches.
import { grouped } from './small.js';

const kRoom = 44;  // dots at the edges, for the numbers

/// A round number of pulses between two lines.
function stepOf(rough) {
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((factor) => factor * power).find((it) => it >= rough);
}

/// The minimum and maximum coordinate of one axis, including the whole travel if that is requested.
function spanOf(picture, axis) {
  let [low, high] = [picture.at[axis], picture.at[axis]];
  for (const place of [...picture.behind, ...picture.ahead]) [low, high] = [Math.min(low, place[axis]), Math.max(high, place[axis])];
  if (picture.isWhole) for (const edge of edgesOf(picture.machines[axis])) [low, high] = [Math.min(low, edge.at), Math.max(high, edge.at)];
  return [low, high];
}

/// The hard stops and the limit switches of an axis.
function edgesOf(machine) {
  const limits = ['lower_limit', 'upper_limit'].map((name) => machine[name]?.at).filter((at) => Math.abs(at) < 1e12);
  return [...(machine.travel ?? []).map((at) => ({ at, isStop: true })), ...limits.map((at) => ({ at, isStop: false }))];
}

/// Pulses per dot; in steps, so that it does not change with each picture.
const sizeOf = (rough) => 2 ** (Math.ceil(Math.log2(rough) * 2) / 2);

function penOf(canvas) {
  const look = getComputedStyle(canvas);
  const context = canvas.getContext('2d');
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.font = '26px system-ui, sans-serif';
  const colour = (name) => look.getPropertyValue(name).trim();
  const line = (dots, name, wide, dashes = []) => {
    context.strokeStyle = colour(name);
    context.lineWidth = wide;
    context.setLineDash(dashes);
    context.beginPath();
    dots.forEach(([x, y], i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
    context.stroke();
  };
  const text = (words, x, y, name = '--faint') => { context.fillStyle = colour(name); context.fillText(words, x, y); };
  const dot = ([x, y]) => {
    context.fillStyle = colour('--ink');
    context.beginPath();
    context.arc(x, y, 9, 0, 7);
    context.fill();
  };
  return { line, text, dot };
}

function drawPath(pen, picture, place) {
  pen.line([picture.at, ...picture.ahead].map(place), '--edge', 2);
  pen.line(picture.behind.map(place), '--c0', 4);
  pen.dot(place(picture.at));
}

/// `picture`: { behind, ahead, at, machines, isWhole, axes }.
export function drawFlat(canvas, picture) {
  const { width, height } = canvas;
  const pen = penOf(canvas);
  const [[left, right], [low, high]] = [spanOf(picture, 0), spanOf(picture, 1)];
  const size = sizeOf(Math.max((right - left) / (width - 4 * kRoom), (high - low) / (height - 4 * kRoom), 200 / width));
  const x = (pulses) => width / 2 + (pulses - (left + right) / 2) / size;
  const y = (pulses) => height / 2 - (pulses - (low + high) / 2) / size;
  const step = stepOf(size * 150);
  const first = (middle, dots) => Math.ceil((middle - dots / 2 * size) / step) * step;
  for (let at = first((left + right) / 2, width); x(at) < width; at += step) {
    const dots = Math.round(x(at)) + 0.5;
    pen.line([[dots, 0], [dots, height]], at === 0 ? '--edge' : '--line', at === 0 ? 2 : 1);
    pen.text(grouped(at + 0), x(at) + 5, height - 8);
  }
  for (let at = first((low + high) / 2, height); y(at) > 0; at += step) {
    const dots = Math.round(y(at)) + 0.5;
    pen.line([[0, dots], [width, dots]], at === 0 ? '--edge' : '--line', at === 0 ? 2 : 1);
    if (y(at) < height - 40) pen.text(grouped(at + 0), 6, y(at) - 6);
  }
  for (const { at, isStop } of edgesOf(picture.machines[0])) pen.line([[x(at), 0], [x(at), height]], isStop ? '--ink' : '--bad', 3, isStop ? [] : [12, 8]);
  for (const { at, isStop } of edgesOf(picture.machines[1])) pen.line([[0, y(at)], [width, y(at)]], isStop ? '--ink' : '--bad', 3, isStop ? [] : [12, 8]);
  drawPath(pen, picture, (place) => [x(place[0]), y(place[1])]);
}

/// The corners of a box, as numbers of three bits, and the pairs that an edge joins.
const kEdges = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((from) => [1, 2, 4].filter((bit) => !(from & bit)).map((bit) => [from, from | bit]));

/// Three axes, turned by two angles; the box around the path has numbers at its ends.
export function drawTurned(canvas, picture, { yaw, pitch }) {
  const { width, height } = canvas;
  const pen = penOf(canvas);
  const spans = [0, 1, 2].map((axis) => spanOf(picture, axis));
  const middle = spans.map(([low, high]) => (low + high) / 2);
  const longest = Math.hypot(...spans.map(([low, high]) => high - low));
  const size = sizeOf(Math.max(longest / (height - 3 * kRoom), 200 / width));
  const place = (at) => {
    const [x, y, z] = middle.map((it, axis) => (at[axis] - it) / size);
    const [right, back] = [x * Math.cos(yaw) - z * Math.sin(yaw), x * Math.sin(yaw) + z * Math.cos(yaw)];
    return [width / 2 + right, height / 2 - (y * Math.cos(pitch) + back * Math.sin(pitch))];
  };
  const corner = (bits) => spans.map((span, axis) => span[bits >> axis & 1]);
  for (const [from, to] of kEdges) pen.line([place(corner(from)), place(corner(to))], '--line', 2);
  picture.axes.forEach((name, axis) => {
    const [low, high] = spans[axis];
    if (low === high) return;
    const [x, y] = place(corner(1 << axis));
    pen.text(`${name} ${grouped(high)}`, Math.max(6, Math.min(width - 190, x + 8)), Math.max(26, Math.min(height - 8, y + 8)));
  });
  const [x, y] = place(corner(0));
  pen.text(spans.map(([low]) => grouped(low)).join(', '), Math.max(6, Math.min(width - 300, x + 8)), Math.max(26, Math.min(height - 8, y + 34)));
  drawPath(pen, picture, place);
}
