// The lanes of the timeline, from the top to the bottom, and how they are drawn.
import { store } from './store.js';
import { grouped } from './small.js';

const kDigital = ['digital_in', 'digital_out', 'pulse_out', 'dip_switch'];
const kMaxSignals = 120;
export const kRuler = 26;

/// The names whose curves the timeline shows for these devices.
export function namesOf(devices) {
  const axes = devices.flatMap((device) => device.axes.flatMap((axis) => ['position', 'speed'].map((it) => `${device.name}.${axis.name}.${it}`)));
  const signals = devices.flatMap((device) => device.terminals.filter((it) => kDigital.includes(it.kind)).map((it) => `${device.name}.${it.name}`));
  return [...axes, ...signals.slice(0, kMaxSignals)];
}

function rangeOf(curve) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of curve?.least ?? []) if (value < low) low = value;
  for (const value of curve?.greatest ?? []) if (value > high) high = value;
  return [low, high];
}

/// The ranges of switches and stops, in which a machine should not be.
function bandsOf(machine) {
  const at = (place) => (typeof place === 'number' ? place : undefined);
  const [low, high] = [at(machine.lower_limit?.at), at(machine.upper_limit?.at)];
  return [[-Infinity, low, '--limit'], [high, Infinity, '--limit'], [-Infinity, machine.travel?.[0], '--stop'], [machine.travel?.[1], Infinity, '--stop']]
    .filter(([from, to]) => from !== undefined && to !== undefined);
}

/// The lanes to show, each with its `height`; signals only if they change.
export function lanesOf(devices, { curves, spans }) {
  /** @type {any[]} */
  const lanes = [];
  const isOne = Object.keys(store.devices).length === 1;
  for (const device of devices) {
    for (const axis of device.axes) {
      const name = `${device.name}.${axis.name}`;
      const label = isOne ? axis.name : name;
      lanes.push({ kind: 'curve', label: `${label} position`, name: `${name}.position`, bands: bandsOf(axis.machine), height: 64, colour: '--c0', unit: 'pulses' });
      lanes.push({ kind: 'curve', label: `${label} speed`, name: `${name}.speed`, bands: [], height: 40, colour: '--c1', unit: 'pulses/s' });
    }
  }
  const order = ['frame', 'wait', 'program', 'fault', 'power', 'failed', 'event'];
  const byLane = new Map();
  for (const line of store.bench?.lines ?? []) byLane.set(line.name, { kind: 'frame', spans: [] });
  for (const span of spans) {
    const lane = byLane.get(span.lane) ?? { kind: span.kind === 'failed' ? 'event' : span.kind, spans: [] };
    byLane.set(span.lane, lane);
    lane.spans.push(span);
  }
  const sorted = [...byLane].sort(([, one], [, other]) => order.indexOf(one.kind) - order.indexOf(other.kind));
  for (const [label, lane] of sorted) lanes.push({ kind: lane.kind === 'event' ? 'events' : 'spans', label: lane.kind === 'program' ? `${label} program` : label, spans: lane.spans, height: 24 });
  for (const device of devices) {
    for (const { name, functions } of device.terminals) {
      const whole = `${device.name}.${name}`;
      const [low, high] = rangeOf(curves[whole]);
      if (low < high) lanes.push({ kind: 'level', label: `${isOne ? name : whole}${functions?.length ? ` ${functions[0]}` : ''}`, name: whole, height: 20, colour: '--c2' });
    }
  }
  let top = kRuler;
  for (const lane of lanes) { lane.top = top; top += lane.height; }
  return lanes;
}

export const heightOf = (lanes) => (lanes.length > 0 ? lanes.at(-1).top + lanes.at(-1).height : kRuler) + 4;

/// A round number of nanoseconds between marks of time that are at least this far apart.
function stepOf(rough_ns) {
  const power = 10 ** Math.floor(Math.log10(Math.max(rough_ns, 1)));
  return [1, 2, 5, 10].map((factor) => factor * power).find((it) => it >= rough_ns);
}
const placesFor = (step_ns) => Math.max(0, Math.min(9, 9 - Math.floor(Math.log10(step_ns))));

const lengthOf = (ns) => (ns < 1e9 ? `${+(ns / 1e6).toPrecision(3)} ms` : `${+(ns / 1e9).toFixed(3)} s`);

/// Describes a span in one line.
export function wordsOf(span) {
  if (span.count > 1) return `${grouped(span.count)} ${span.kind}s${span.bad ? ', one of them: ' : ', the first: '}${wordsOf({ ...span, count: 1 })}`;
  if (span.kind === 'frame') {
    return [span.text, span.reply && `${span.text ? '→ ' : ''}${span.reply}`, span.remark && `(${span.remark})`,
            span.latency_ns !== undefined && `${(span.latency_ns / 1e6).toFixed(2)} ms`].filter(Boolean).join(' ');
  }
  if (span.kind === 'wait') return `${span.text}, ${lengthOf(span.end_ns - span.begin_ns)}`;
  if (span.kind === 'program') return `${span.line ? `line ${span.line}: ` : ''}${span.text.trim()}${span.waits_for ? ` waits for ${span.waits_for}` : ''}`;
  if (span.kind === 'event') {
    if (span.what === 'power') return `${span.device} ${Number(span.value) === 0 ? 'off' : 'on'} by ${span.by}`;
    const value = span.value !== undefined && span.value !== '' && !span.text ? ` = ${span.value}` : '';
    return [span.what, span.by && `by ${span.by}`, `${span.name ?? span.device ?? ''}${value}`, span.text].filter(Boolean).join(' ');
  }
  return span.text ?? span.kind;
}

/// Draws all lanes. `look`: { context, width, left, dots, stretch, course, now, failed_ns, hover, mark, find }.
export function drawLanes(lanes, look) {
  const { context, width, left, dots, stretch: [from, to], course } = look;
  const style = getComputedStyle(context.canvas);
  const colour = (name) => style.getPropertyValue(name).trim();
  const height = heightOf(lanes);
  const x = (time) => left + (time - from) / (to - from) * dots;
  context.clearRect(0, 0, width, height);
  context.font = '12px system-ui, sans-serif';
  context.textBaseline = 'middle';
  drawRuler(look, x, colour, height);
  for (const lane of lanes) {
    context.fillStyle = colour('--line');
    context.fillRect(0, lane.top + lane.height - 1, width, 1);
    context.save();
    context.beginPath();
    context.rect(left, lane.top, width - left, lane.height - 1);
    context.clip();
    if (lane.kind === 'curve' || lane.kind === 'level') drawCurve(lane, look, course.curves[lane.name], colour, x);
    else (lane.kind === 'events' ? drawEvents : drawSpans)(lane, look, colour, x);
    context.restore();
    drawLabel(lane, look, colour);
  }
  const line = (time, name, dash = []) => {
    if (time === undefined || time === null || time < from || time > to) return;
    context.strokeStyle = colour(name);
    context.lineWidth = dash.length ? 1 : 2;
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(x(time), dash.length ? kRuler : 4);
    context.lineTo(x(time), height);
    context.stroke();
    context.setLineDash([]);
  };
  if (look.mark) {
    context.globalAlpha = 0.16;
    context.fillStyle = colour('--accent');
    const begin = Math.max(left, x(look.mark[0]));
    context.fillRect(begin, 0, Math.max(1, x(look.mark[1]) - begin), height);
    context.globalAlpha = 1;
  }
  line(look.failed_ns, '--bad');
  line(look.hover, '--faint', [4, 3]);
  line(look.now, '--accent');
}

function drawRuler({ context, width, left, stretch: [from, to] }, x, colour, height) {
  const step = stepOf((to - from) / Math.max(2, (width - left) / 110));
  const places = placesFor(step);
  for (let time = Math.max(0, Math.ceil(from / step) * step); time <= to; time += step) {
    context.fillStyle = colour('--line');
    context.fillRect(x(time), kRuler - 6, 1, height);
    context.fillStyle = colour('--faint');
    const text = `${(time / 1e9).toFixed(places)} s`;
    context.textAlign = x(time) + 30 > width ? 'right' : x(time) - 30 < left ? 'left' : 'center';
    context.fillText(text, x(time), 11);
  }
  context.textAlign = 'left';
}

function drawLabel(lane, { context, left, course }, colour) {
  const isBeside = left > 0;
  const room = isBeside ? left - 10 : 400;
  context.save();
  if (isBeside) { context.beginPath(); context.rect(0, lane.top, left - 4, lane.height); context.clip(); }
  const [low, high] = lane.kind === 'curve' ? rangeOf(course.curves[lane.name]) : [0, 0];
  const isRanged = lane.kind === 'curve' && high > -Infinity && lane.height > 36;
  const y = lane.kind === 'curve' ? lane.top + 12 : lane.top + lane.height / 2;
  context.fillStyle = colour('--ink');
  if (!isBeside) {
    context.globalAlpha = 0.85;
    context.fillStyle = colour('--card');
    context.fillRect(0, y - 8, context.measureText(lane.label).width + 8, 16);
    context.globalAlpha = 1;
    context.fillStyle = colour('--ink');
  }
  context.fillText(lane.label, 4, y, room);
  context.fillStyle = colour('--faint');
  if (isRanged && isBeside) context.fillText(low === high ? grouped(low) : `${grouped(low)} to ${grouped(high)}`, 4, lane.top + 28, room);
  context.restore();
}

function drawCurve(lane, { context, course }, curve, colour, x) {
  if (!curve) return;
  let [low, high] = rangeOf(curve);
  if (!(high >= low)) return;
  if (high === low) [low, high] = lane.kind === 'level' ? [0, 1] : [low - 1, high + 1];
  const [top, room] = [lane.top + 5, lane.height - 11];
  const y = (value) => top + room * (1 - (value - low) / (high - low));
  for (const [from, to, name] of lane.bands ?? []) {
    const [begin, end] = [Math.min(y(Math.max(from, low)), top + room + 4), Math.max(y(Math.min(to, high)), top - 4)];
    if (from > high || to < low) continue;
    context.globalAlpha = 0.18;
    context.fillStyle = colour(name);
    context.fillRect(0, end, context.canvas.width, Math.max(2, begin - end));
    context.globalAlpha = 1;
  }
  const [from, to] = course.stretch;
  const count = curve.least.length;
  context.strokeStyle = colour(lane.colour);
  context.lineWidth = 1.5;
  context.beginPath();
  let isDown = false;
  for (let i = 0; i < count; ++i) {
    const [least, greatest] = [curve.least[i], curve.greatest[i]];
    if (Number.isNaN(least)) { isDown = false; continue; }
    const [begin, end] = [x(from + (to - from) * i / count), x(from + (to - from) * (i + 1) / count)];
    if (lane.kind === 'level') {
      context.lineTo(begin, y(least));
      context.lineTo(greatest === least ? end : begin, y(greatest));
    } else {
      // Upwards or downwards, whichever leads to the next dot.
      const isFalling = i + 1 < count && curve.greatest[i + 1] < greatest;
      const middle = (begin + end) / 2;
      (isDown ? context.lineTo : context.moveTo).call(context, middle, y(isFalling ? greatest : least));
      if (greatest !== least) context.lineTo(middle, y(isFalling ? least : greatest));
    }
    isDown = true;
  }
  context.stroke();
}

const fits = (span, find) => find === '' || wordsOf(span).toLowerCase().includes(find.toLowerCase());

function drawSpans(lane, { context, find, width }, colour, x) {
  const fills = { frame: '--accent', wait: '--c2', program: '--c3', fault: '--bad', power: '--stop' };
  lane.spans.forEach((span, i) => {
    const [begin, end] = [x(span.begin_ns), Math.max(x(span.begin_ns) + 1.5, x(span.end_ns))];
    const isBad = span.bad && span.kind !== 'power';
    const name = isBad ? '--bad' : fills[span.kind] ?? '--c5';
    const strength = span.kind === 'program' && span.waits_for ? 0.16 : span.kind === 'program' && i % 2 ? 0.3 : 0.4;
    context.globalAlpha = fits(span, find) ? (isBad || find !== '' ? 0.75 : strength) : 0.1;
    context.fillStyle = colour(name);
    context.fillRect(begin, lane.top + 3, end - begin, lane.height - 7);
    context.globalAlpha = fits(span, find) ? 1 : 0.3;
    context.fillRect(begin, lane.top + 3, Math.min(1.5, end - begin), lane.height - 7);
    const shown = [Math.max(begin, 0), Math.min(end, width)];
    if (shown[1] - shown[0] < 34) return;
    context.save();
    context.beginPath();
    context.rect(shown[0], lane.top, shown[1] - shown[0] - 2, lane.height);
    context.clip();
    context.fillStyle = colour(isBad ? '--card' : '--ink');
    context.fillText(wordsOf(span), Math.max(begin, 0) + 4, lane.top + lane.height / 2);
    context.restore();
  });
  context.globalAlpha = 1;
}

/// Draws each mark, with its words if there is room before the next one.
function drawEvents(lane, { context, find, width }, colour, x) {
  lane.spans.forEach((span, i) => {
    const at = x(span.begin_ns);
    const next = i + 1 < lane.spans.length ? x(lane.spans[i + 1].begin_ns) : width;
    context.globalAlpha = fits(span, find) ? 1 : 0.2;
    context.fillStyle = colour(span.bad ? '--bad' : span.what === 'write' ? '--c2' : '--c5');
    const middle = lane.top + lane.height / 2;
    context.beginPath();
    context.moveTo(at, middle - 6);
    context.lineTo(at + 5, middle);
    context.lineTo(at, middle + 6);
    context.lineTo(at - 5, middle);
    context.fill();
    if (next - at < 40) return;
    context.save();
    context.beginPath();
    context.rect(at, lane.top, next - at - 8, lane.height);
    context.clip();
    context.fillStyle = colour('--ink');
    context.fillText(wordsOf(span), at + 9, middle);
    context.restore();
  });
  context.globalAlpha = 1;
}

/// Returns the span at that place of a lane, or nothing.
export function spanAt(lane, time, slack_ns) {
  let found = null;
  for (const span of lane.spans ?? []) {
    if (span.begin_ns - slack_ns > time || span.end_ns + slack_ns < time) continue;
    const distance = Math.min(Math.abs(span.begin_ns - time), Math.abs(span.end_ns - time));
    if (!found || distance <= found.distance) found = { span, distance };
  }
  return found?.span ?? null;
}

export const matches = (spans, find) => (find.trim() === '' ? [] : spans.filter((span) => fits(span, find)));
