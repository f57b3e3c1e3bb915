// What the page knows of the bench that it shows. Panels read it; nothing but this file writes what the server told.
import { Wire } from './wire.js';
import { hear } from './heard.js';

const kMaxFrames = 1024;
const kMaxEvents = 500;
const kFlash_ms = 1200;

export const store = {
  link: 'connecting to the server',  // '' while all is well
  hello: null,
  number: 0,        // which bench is shown
  states: [],       // of each: there, silent, gone, unknown
  epochs: [],       // of each: another daemon has another
  labels: [],       // of each, where there are several: its bench file
  bench: null,      // the reply to `bench`
  devices: {},      // by name: the reply to `bench` with a device
  kinds: [],        // of faults
  trigger: [],
  values: {},
  frames: [],
  events: [],
  framesLost: 0,
  eventsLost: 0,
  status: null,
  look: null,       // time_ns, paused, speed, advancing
  changes: {},      // by name: when it changed last, and by whom
  writers: {},      // by name: the last event that wrote it
  heard: new Map(), // by device: what its hosts have spoken of (heard.js)
  said: null,       // the last thing that went wrong: { text, at }
  timeline: null,   // of a recording: { begin_ns, end_ns, marks, story }
};

const listeners = new Set();
export const onLook = (listener) => { listeners.add(listener); return () => listeners.delete(listener); };

let asked = false;
let drawn = () => {};
export function drawBy(draw) { drawn = draw; }
export function draw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; drawn(); });
}

// Names that the panels in view want, by panel.
const wanted = new Map();
let watched = new Set();
let lastWatch = '';
export function want(panel, names) {
  wanted.set(panel, names);
  watch();
}
/// The next panel may want the same names: it has a moment to say so.
export function unwant(panel) {
  wanted.delete(panel);
  setTimeout(watch, 100);
}
function watch() {
  const names = [...new Set([...wanted.values()].flat())].slice(0, 2000);
  const wish = JSON.stringify([store.number, names]);
  if (wish === lastWatch) return;
  lastWatch = wish;
  watched = new Set(names);
  // What is not told any more grows old: whoever wants it later must not take it for the present value.
  for (const name of Object.keys(store.values)) if (!watched.has(name)) delete store.values[name];
  wire.watch(store.number, { names, frames: true, events: true, status: true });
}

const wire = new Wire({
  hello: (hello) => {
    store.link = '';
    store.hello = hello;
    store.states = hello.benches.map((bench) => bench.state);
    store.epochs = hello.benches.map((bench) => bench.epoch);
    isKnown = false;  // whatever was told before is told again
    show(Math.min(store.number, hello.benches.length - 1));
    hello.benches.forEach((_, number) => learnLabel(number));
  },
  bench: (bench) => {
    store.states[bench.bench] = bench.state;
    if (store.epochs[bench.bench] !== bench.epoch && bench.bench === store.number) isKnown = false;
    store.epochs[bench.bench] = bench.epoch;
    if (bench.state === 'there') learnLabel(bench.bench);
    if (bench.bench === store.number && bench.state === 'there') learn();
    draw();
  },
  lost: (why) => {
    store.link = why ? `closed: ${why}` : 'the page has lost its server; retrying';
    draw();
  },
  dead: () => {
    store.link = 'the page\'s server does not answer; retrying';
    draw();
  },
  error: (error) => complain(error.error),
  look: take,
});

function take(look) {
  if (look.bench !== store.number) return;
  const now = performance.now();
  // Back to a snapshot: what came after has not happened. Elsewhere in a recording: what led there is told anew.
  const moved = store.look ? look.time_ns - store.look.time_ns : 0;
  const isTravel = store.timeline && look.altered_at_ns === undefined && moved !== 0;
  if (moved < 0 || isTravel) Object.assign(store, { frames: [], events: [], changes: {}, writers: {} });
  store.look = look;
  for (const [name, value] of Object.entries(look.values ?? {})) {
    if (!watched.has(name)) continue;
    if (name in store.values && store.values[name] !== value) {
      const last = store.changes[name];
      if (!last || now - last.at > 300 || !last.by) store.changes[name] = { at: now, by: '' };
    }
    store.values[name] = value;
  }
  for (const event of look.events ?? []) {
    if (event.what !== 'write' || !event.name) continue;
    store.changes[event.name] = { at: now, by: event.by };
    store.writers[event.name] = event;
  }
  // What a host has spoken of is only understood when the bench is known, which takes a few questions.
  unheard.push(...(look.frames ?? []));
  hearAll();
  store.frames = joined(store.frames, look.frames, kMaxFrames);
  store.events = joined(store.events, look.events, kMaxEvents);
  store.framesLost += look.frames_lost ?? 0;
  store.eventsLost += look.events_lost ?? 0;
  if (look.status) store.status = look.status;
  for (const listener of listeners) listener(look);
  draw();
}

let unheard = [];
function hearAll() {
  if (!store.bench) return;
  for (const frame of unheard) hear(store.heard, store.bench, frame);
  unheard = [];
}

/// The last of both, each with how many before it were `missed`.
function joined(list, more, most) {
  const all = [...list];
  for (const one of more ?? []) {
    const expected = all.length > 0 ? all.at(-1).number + 1 : one.number;
    all.push(one.number > expected ? { ...one, missed: one.number - expected } : one);
  }
  return all.slice(-most);
}

/// Those that fit, and `{ missed, key }` where some were missed.
export function withHoles(list, fits = (/** @type {any} */ _one) => true) {
  const shown = [];
  let missed = 0;
  for (const one of list) {
    missed += one.missed ?? 0;
    if (!fits(one)) continue;
    if (missed > 0) shown.push({ missed, key: `missed ${one.number}` });
    missed = 0;
    shown.push(one);
  }
  if (missed > 0) shown.push({ missed, key: 'missed' });
  return shown;
}

/// Another bench, or the same once more.
export function show(number) {
  const isOther = number !== store.number;
  store.number = number;
  if (isOther) isKnown = false;
  lastWatch = '';
  watch();
  if (store.states[number] === 'there') learn();
  draw();
}

let isKnown = false;  // what is told goes on from what was told of this daemon before
function forget() {
  unheard = [];
  Object.assign(store, { bench: null, devices: {}, values: {}, frames: [], events: [], status: null, look: null,
                         changes: {}, writers: {}, framesLost: 0, eventsLost: 0, heard: new Map(), timeline: null });
}

/// Of several benches, what to call each.
async function learnLabel(number) {
  if (store.hello.benches.length < 2) return;
  const { daemon } = await wire.ask(number, { do: 'identify' });
  const name = daemon?.bench?.split('/').at(-1) || daemon?.lines?.map((line) => line.name).join();
  if (name) store.labels[number] = name;
  draw();
}

/// A recording has a timeline; a bench that runs refuses the question.
async function timelineOf(number) {
  /** @type {any} */
  let timeline = null;
  for (let from = 0; from !== undefined;) {
    const reply = await wire.ask(number, { do: 'timeline', from });
    if (!reply.timeline) return null;
    timeline = { ...timeline, ...reply.timeline, marks: [...(timeline?.marks ?? []), ...reply.timeline.marks] };
    from = reply.next;
  }
  return timeline;
}

async function learn() {
  const number = store.number;
  if (!isKnown) forget();
  isKnown = true;
  // All at once, because a question may take long to go round.
  const [{ bench }, kinds, timeline] = await Promise.all([wire.ask(number, { do: 'bench' }), wire.ask(number, { do: 'faults' }), timelineOf(number)]);
  if (number !== store.number || !bench) return;
  store.kinds = kinds.kinds ?? [];
  store.trigger = kinds.trigger ?? [];
  const replies = await Promise.all(bench.devices.map(({ name }) => wire.ask(number, { do: 'bench', device: name })));
  if (number !== store.number) return;
  bench.devices.forEach(({ name }, i) => { if (replies[i].device) store.devices[name] = replies[i].device; });
  store.timeline = timeline;
  store.bench = bench;
  hearAll();
  lastWatch = '';
  watch();
  draw();
}

export function complain(text) {
  store.said = { text, at: performance.now() };
  setTimeout(draw, 6100);
  draw();
}

/// A message to the bench that is shown; what is refused is said in the page's own words line.
export async function ask(message) {
  const reply = await wire.ask(store.number, message);
  if (!reply.ok) complain(reply.error ?? 'refused');
  else store.said = null;
  return reply;
}
/// The same for those who look for themselves whether it worked.
export const askQuietly = (message) => wire.ask(store.number, message);

export const isReadOnly = () => store.hello?.read_only ?? false;
/// Whether nothing may be changed here: a recording shows what happened.
export const isLocked = () => isReadOnly() || (store.timeline !== null && !isAltered());
/// Of a recording: whether somebody tries what would happen if something were otherwise.
export const isAltered = () => store.look?.altered_at_ns !== undefined;
export const valueOf = (name) => store.values[name];
export const hasPower = (device) => store.status?.devices.find((it) => it.name === device)?.power !== 'off';
/// Whether a device runs a program of its own.
export const runsProgram = (device) => store.status?.devices.find((it) => it.name === device)?.runs ?? false;
/// 'host', 'page', 'control', 'program', 'device' for a moment after a change; '' otherwise. What changes without an event
/// was changed by its device: by its program, if one runs and programs may write it.
export function flashOf(name, device, isWritable) {
  const change = store.changes[name];
  if (!change || performance.now() - change.at > kFlash_ms) return '';
  return change.by || (isWritable && runsProgram(device) ? 'program' : 'device');
}
