// The page's knowledge of the bench that it shows. Panels read it; only this file writes what the server sends.
import { Wire } from './wire.js';
import { Told, isTold } from './told.js';
import { Heard } from './heard.js';

const kMaxFrames = 1024;
const kMaxEvents = 500;
const kFlash_ms = 1200;

export const store = {
  link: 'connecting to the server',  // '' if all is well
  hello: null,
  number: 0,        // the bench that is shown
  states: [],       // of each bench: there, silent, gone, unknown
  epochs: [],       // of each bench; a new daemon has a new one
  labels: [],       // of each bench, if there are several: its file
  bench: null,      // the reply to `bench`
  devices: {},      // by name: the reply to `bench` with a device
  kinds: [],        // kinds of faults
  trigger: [],
  values: {},
  frames: [],
  events: [],
  framesLost: 0,
  eventsLost: 0,
  status: null,
  look: null,       // time_ns, paused, speed, advancing
  changes: {},      // by name: time and author of the last change
  writers: {},      // by name: the last event that wrote it
  heard: new Heard(),  // what hosts use
  said: null,       // the last error: { text, at }
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

// The names that the visible panels want, by panel.
const wanted = new Map();
let watched = new Set();
let lastWatch = '';
export function want(panel, names) {
  wanted.set(panel, names);
  watch();
}
/// Waits a moment, because the next panel may want the same names.
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
  // Values that are no longer sent become outdated. Delete them, so that no panel takes them for current values.
  for (const name of Object.keys(store.values)) if (!watched.has(name)) delete store.values[name];
  wire.watch(store.number, { names, frames: true, events: true, status: true });
}

const wire = new (isTold ? Told : Wire)({
  hello: (hello) => {
    store.link = '';
    store.hello = hello;
    store.states = hello.benches.map((bench) => bench.state);
    store.epochs = hello.benches.map((bench) => bench.epoch);
    isKnown = false;  // the server sends everything again
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
    store.link = why ? `closed: ${why}` : 'the page has lost the connection to its server; retrying';
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
  // Time went back to a snapshot, so what came after it has not happened; or a recording went to a moment, perhaps the
  // same one, and the server sends its past again.
  const isRestored = store.look && (look.restores !== store.look.restores || look.time_ns < store.look.time_ns);
  if (isRestored) Object.assign(store, { frames: [], events: [], changes: {}, writers: {}, heard: new Heard() });
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
  // Frames can only be interpreted when the bench is known, which takes some requests.
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
  for (const frame of unheard) store.heard.take(store.bench, frame);
  unheard = [];
}

/// Returns the last items of both lists. An item has the number of `missed` ones before it.
function joined(list, more, most) {
  const all = [...list];
  for (const one of more ?? []) {
    const expected = all.length > 0 ? all.at(-1).number + 1 : one.number;
    all.push(one.number > expected ? { ...one, missed: one.number - expected } : one);
  }
  return all.slice(-most);
}

/// Returns the items that fit, with `{ missed, key }` where some were missed.
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

/// Shows another bench, or the same one again.
export function show(number) {
  const isOther = number !== store.number;
  store.number = number;
  if (isOther) isKnown = false;
  lastWatch = '';
  watch();
  if (store.states[number] === 'there') learn();
  draw();
}

let isKnown = false;  // whether messages continue the previous ones of this daemon
function forget() {
  unheard = [];
  Object.assign(store, { bench: null, devices: {}, values: {}, frames: [], events: [], status: null, look: null,
                         changes: {}, writers: {}, framesLost: 0, eventsLost: 0, heard: new Heard(), timeline: null });
}

/// Finds a label for each of several benches.
async function learnLabel(number) {
  if (store.hello.benches.length < 2) return;
  const { daemon } = await wire.ask(number, { do: 'identify' });
  const name = daemon?.bench?.split('/').at(-1) || daemon?.lines?.map((line) => line.name).join();
  if (name) store.labels[number] = name;
  draw();
}

/// A recording has a timeline; a running bench refuses the request.
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

/// The first view does without them.
async function learnKinds(number) {
  const { kinds, trigger } = await wire.ask(number, { do: 'faults' });
  if (number !== store.number) return;
  Object.assign(store, { kinds: kinds ?? [], trigger: trigger ?? [] });
  draw();
}

async function learn() {
  const number = store.number;
  if (!isKnown) forget();
  isKnown = true;
  // All at once, because a request may take long.
  const [{ bench }, { devices }, timeline] = await Promise.all([wire.ask(number, { do: 'bench' }),
    wire.ask(number, { do: 'bench', device: '*' }), timelineOf(number)]);
  if (number !== store.number || !bench || !devices) return;
  learnKinds(number);
  for (const device of devices) store.devices[device.name] = device;
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

/// Sends a message to the bench that is shown. A refusal is displayed in the page's status line.
export async function ask(message) {
  const reply = await wire.ask(store.number, message);
  if (!reply.ok) complain(reply.error ?? 'refused');
  else store.said = null;
  return reply;
}
/// Like ask(), for callers that check the result themselves.
export const askQuietly = (message) => wire.ask(store.number, message);

export const isReadOnly = () => store.hello?.read_only ?? false;
/// Returns whether changes are disabled: a recording only shows what happened.
export const isLocked = () => isReadOnly() || (store.timeline !== null && !isAltered());
/// Returns whether the user is trying a change to a recording.
export const isAltered = () => store.look?.altered_at_ns !== undefined;
export const valueOf = (name) => store.values[name];
export const hasPower = (device) => store.status?.devices.find((it) => it.name === device)?.power !== 'off';
/// Returns whether a program runs in the device.
export const runsProgram = (device) => store.status?.devices.find((it) => it.name === device)?.runs ?? false;
/// Returns 'host', 'page', 'control', 'program' or 'device' for a moment after a change, otherwise ''. A change without
/// an event comes from the device, or from its program if one is running and programs may write the register.
export function flashOf(name, device, isWritable) {
  const change = store.changes[name];
  if (!change || performance.now() - change.at > kFlash_ms) return '';
  return change.by || (isWritable && runsProgram(device) ? 'program' : 'device');
}
