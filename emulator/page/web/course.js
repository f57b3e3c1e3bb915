// The course of a bench, for the timeline: the minimum and the maximum of each name in each dot, and the spans of
// frames, programs, faults and events. Requested for a recording; for a running bench, the page keeps the last
// minute.
import { askQuietly, onLook, store, valueOf } from './store.js';

const kMaxPoints = 200_000;
const kPast_s = 60;
const kMaxDots = 2000;

/// Requests all names at once, with as many dots as they may have.
async function curvesOf(names, [from_ns, to_ns], dots) {
  if (names.length === 0) return {};
  const reply = await askQuietly({ do: 'curves', names, from_ns, to_ns, dots: Math.min(dots, kMaxDots, Math.floor(kMaxPoints / names.length)) });
  if (!reply.ok) return {};
  return Object.fromEntries(names.map((name, i) => [name, reply.curves[i]]));
}

export async function spansOf([from_ns, to_ns], dots) {
  const spans = [];
  for (let from = 0; from !== undefined;) {
    const reply = await askQuietly({ do: 'spans', from_ns, to_ns, dots: Math.min(dots, kMaxDots), from });
    spans.push(...(reply.spans ?? []));
    from = reply.next;
  }
  return spans;
}

/// The course of a recording.
export async function recordedCourse(names, stretch, dots) {
  const [curves, spans] = await Promise.all([curvesOf(names, stretch, dots), spansOf(stretch, dots)]);
  return { stretch, curves, spans };
}

// The course of a running bench: what the page has received since the timeline was first opened.
const past = { times: [], rows: new Map() };
onLook((look) => {
  if (past.rows.size === 0 || store.timeline) return;
  const { times, rows } = past;
  if (times.length > 0 && look.time_ns < times.at(-1)) { times.length = 0; for (const row of rows.values()) row.length = 0; }
  if (times.at(-1) === look.time_ns) return;
  times.push(look.time_ns);
  for (const [name, row] of rows) row.push(Number(valueOf(name) ?? NaN));
  let old = 0;
  while (times[old] < look.time_ns - kPast_s * 1e9) ++old;
  if (old < 200) return;
  times.splice(0, old);
  for (const row of rows.values()) row.splice(0, old);
});
export function keepPast(names) {
  for (const name of past.rows.keys()) if (!names.includes(name)) past.rows.delete(name);
  for (const name of names) if (!past.rows.has(name)) past.rows.set(name, new Array(past.times.length).fill(NaN));
}
export const pastBegin = () => past.times[0] ?? store.look?.time_ns ?? 0;

function thinned(row, [from, to], dots) {
  const [least, greatest] = [new Array(dots).fill(NaN), new Array(dots).fill(NaN)];
  let last = NaN;
  let dot = 0;
  past.times.forEach((time, i) => {
    if (time < from) { last = row[i]; return; }
    if (time > to) return;
    const at = Math.min(dots - 1, Math.floor((time - from) / (to - from) * dots));
    for (; dot < at; ++dot) {
      least[dot] = Number.isNaN(least[dot]) ? last : least[dot];
      greatest[dot] = Number.isNaN(greatest[dot]) ? last : greatest[dot];
    }
    const value = row[i];
    const [low, high] = Number.isNaN(least[at]) ? [last, last] : [least[at], greatest[at]];
    least[at] = Number.isNaN(low) ? value : Math.min(low, value);
    greatest[at] = Number.isNaN(high) ? value : Math.max(high, value);
    last = value;
  });
  return { least, greatest };
}

/// How long a frame takes on its line.
function duration_ns(frame) {
  const [, baud, bits, parity, stop] = /^(\d+) (\d)([A-Z])(\d)/.exec(store.status?.lines?.find((it) => it.name === frame.line)?.settings ?? '') ?? [];
  return baud ? (frame.bytes?.length ?? 0) / 2 * (1 + Number(bits) + (parity === 'N' ? 0 : 1) + Number(stop)) / Number(baud) * 1e9 : 0;
}

/// Requests joined to their replies.
function exchanges(frames) {
  const spans = [];
  const last = new Map();  // by line
  const asked = new Map();  // by the number of the request
  for (const frame of frames) {
    const end_ns = frame.time_ns + duration_ns(frame);
    const isBad = Boolean(frame.exception || frame.ignored || frame.remark);
    const request = frame.way !== 'out' ? undefined : frame.request !== undefined ? asked.get(frame.request)
      : frame.bytes ? undefined : last.get(frame.line);
    if (request && !(request.reply && frame.text)) {
      Object.assign(request, { end_ns: Math.max(request.end_ns, end_ns), bad: request.bad || isBad, reply: frame.text || request.reply,
        remark: frame.remark ?? request.remark, latency_ns: frame.latency_ns });
      continue;
    }
    const span = { lane: frame.line, kind: 'frame', begin_ns: frame.time_ns, end_ns, bad: isBad, remark: frame.remark,
      [frame.way === 'in' ? 'text' : 'reply']: frame.text };
    spans.push(span);
    if (frame.way !== 'in') continue;
    last.set(frame.line, span);
    asked.set(frame.number, span);
  }
  return spans;
}

const eventSpan = (event) => ({ ...event, lane: event.by ? `events of ${event.by}` : 'events', kind: 'event', begin_ns: event.time_ns, end_ns: event.time_ns,
  bad: ['exception', 'ignored', 'dropped'].includes(event.what) });

/// `waits` are those of a host in simulated time.
export function liveCourse(names, stretch, dots, waits) {
  const curves = Object.fromEntries(names.filter((name) => past.rows.has(name)).map((name) => [name, thinned(past.rows.get(name), stretch, dots)]));
  const spans = [...exchanges(store.frames), ...store.events.map(eventSpan), ...waits]
    .filter((span) => span.end_ns >= stretch[0] && span.begin_ns <= stretch[1]);
  return { stretch, curves, spans };
}
