// The rail of an axis shows its travel, its switches, its position and target, and where the controller believes it to
// be.
import { html, useRef, useState } from './preact.js';
import { store, valueOf } from './store.js';
import { grouped, isOn, spaced } from './small.js';

export const kSwitches = ['lower_limit', 'near_home', 'home', 'mark', 'upper_limit'];
const kZoneTop = { lower_limit: 42, upper_limit: 42, home: 42, near_home: 55, mark: 55 };

// The range that each rail shows. It only grows, so the picture does not jump.
const stretches = new Map();

function stretchOf(key, machine, places) {
  const marks = [machine.start ?? 0, ...places.filter((place) => typeof place === 'number')];
  for (const name of kSwitches) {
    const at = machine[name];
    if (at) marks.push(...(at.on ?? [at.at]).filter((place) => Math.abs(place) < 1e12));
  }
  if (machine.travel) marks.push(...machine.travel);
  let [low, high] = [Math.min(...marks), Math.max(...marks)];
  if (high - low < 1000) [low, high] = [low - 500, high + 500];
  const room = machine.travel ? 0.03 : 0.1;
  const known = stretches.get(key);
  if (known && known.machine === machine && low >= known.low && high <= known.high) return known;
  const margin = (high - low) * room;
  const made = { low: low - margin, high: high + margin, machine };
  stretches.set(key, made);
  return made;
}

/// Returns where a switch is on in the drawing: a limit is on from its position outwards.
function zoneOf(name, machine, stretch) {
  const it = machine[name];
  if (!it) return null;
  if (it.on) return it.on;
  return name === 'lower_limit' ? [stretch.low, it.at] : [it.at, stretch.high];
}

/// Returns three to five round numbers along the rail.
function marksOf({ low, high }) {
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((it) => it >= rough);
  const all = [];
  for (let at = Math.ceil(low / step) * step; at <= high; at += step) all.push(Math.round(at) + 0);  // avoids -0
  return all;
}

/// Returns where the encoder puts the machine, in pulses, or nothing if there is no encoder on the motor.
function encoderPlace(machine, counts) {
  const { encoder } = machine;
  if (!encoder || encoder.wheel || typeof counts !== 'number') return null;
  const pulses = counts * encoder.pulses_per_revolution / encoder.counts_per_revolution;
  return (machine.start ?? 0) + (encoder.reversed ? -pulses : pulses);
}

/// The carriage. Dragging it pushes the machine by that distance, as when it slips. `perDot` is pulses per pixel for a
/// rail of this width.
function Carriage({ x, slip, perDot }) {
  const [drag, setDrag] = useState(null);  // where it was grabbed, and how far it is from there, in pixels
  const hand = useRef(null);  // the same at once: a fast hand is ahead of the drawing
  const hold = (to) => { hand.current = to; setDrag(to); };
  const rail = (event) => event.currentTarget.closest('.rail');
  const pulsesOf = (it) => (it && it.rail ? Math.round((it.to - it.from) * perDot(it.rail.clientWidth)) : 0);
  const pulses = pulsesOf(drag);
  const take = (event) => {
    if (!slip || event.button !== 0) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    // A small movement does not push: it may be scrolling, or a tremor.
    hold({ rail: rail(event), from: event.clientX, to: event.clientX, slack: event.pointerType === 'mouse' ? 5 : 20 });
  };
  const move = (event) => { if (hand.current) hold({ ...hand.current, to: event.clientX }); };
  const letGo = (event) => {
    move(event);
    const last = hand.current;
    hold(null);
    if (last && Math.abs(last.to - last.from) > last.slack && pulsesOf(last) !== 0) slip(pulsesOf(last));
  };
  return html`<svg x=${x}><path class="hair" d="M0 12 v54" />
    <path class=${`carriage ${slip ? 'pushable' : ''}`} d="M0 31 l-9 -19 h18 z" onPointerDown=${take} onPointerMove=${move}
      onPointerUp=${letGo} onPointerCancel=${() => hold(null)}>${slip && html`<title>drag it to make the carriage slip</title>`}</path>
    ${drag && html`<g transform=${`translate(${drag.to - drag.from} 0)`}><path class="ghost" d="M0 30 l-9 -18 h18 z" />
      <text y="9">${pulses > 0 ? '+' : ''}${grouped(pulses)}</text></g>`}
  </svg>`;
}

/// `press(contact)` is the action of a click on the contact's zone, if there is one. `slip(pulses)` pushes the machine,
/// if that is allowed.
export function Rail({ device, axis, press, slip }) {
  const name = `${device.name}.${axis.name}`;
  const value = (what) => valueOf(`${name}.${what}`);
  const machine = axis.machine;
  const [position, pulses, target] = [value('position'), value('pulses'), value('target')];
  const stretch = stretchOf(`${store.number}/${name}`, machine, [position, pulses, target]);
  const share = (place) => Math.max(0, Math.min(100, 100 * (place - stretch.low) / (stretch.high - stretch.low)));
  const x = (place) => `${share(place).toFixed(3)}%`;
  const wide = (from, to) => `${(share(to) - share(from)).toFixed(3)}%`;
  const zones = kSwitches.map((contact) => [contact, zoneOf(contact, machine, stretch)]).filter(([, zone]) => zone);
  const differs = (place) => typeof place === 'number' && typeof position === 'number' && place !== position;
  const encoder = encoderPlace(machine, value('encoder'));
  const count = machine.encoder ? machine.encoder.pulses_per_revolution / machine.encoder.counts_per_revolution : 0;
  const isOff = encoder !== null && typeof position === 'number' && Math.abs(encoder - position) > Math.max(count, 1);
  const heads = typeof target === 'number' && target !== pulses;
  const says = [`${name} at ${grouped(position)} pulses`, heads ? `on its way to ${grouped(target)}` : '',
                differs(pulses) ? `commanded ${grouped(pulses)}` : '', isOff ? `encoder at ${grouped(Math.round(encoder))}` : '']
    .filter(Boolean).join(', ');
  const marks = marksOf(stretch);
  const anchor = (at) => (share(at) <= 8 ? 'start' : share(at) >= 92 ? 'end' : 'middle');  // at its ends a rail has half the space
  return html`<svg class="rail" role="img" aria-label=${says}>
    <rect class="bed" x="0" y="32" width="100%" height="8" />
    ${marks.map((at) => html`<g key=${at}><rect class="tick" x=${x(at)} y="68" width="1" height="4" />
      ${(marks.length < 5 || anchor(at) === 'middle') && html`<text x=${x(at)} y="84" style=${{ textAnchor: anchor(at) }}>${grouped(at)}</text>`}</g>`)}
    ${machine.travel && html`
      <rect class="stop" x="0" y="20" width=${wide(stretch.low, machine.travel[0])} height="32"><title>hard stop</title></rect>
      <rect class="stop" x=${x(machine.travel[1])} y="20" width=${wide(machine.travel[1], stretch.high)} height="32"><title>hard stop</title></rect>`}
    ${zones.map(([contact, [from, to]]) => html`<rect key=${contact} onClick=${press(contact)}
      class=${`zone ${contact} ${isOn(value(contact)) ? 'lit' : ''} ${press(contact) ? 'pressable' : ''}`} x=${x(from)} y=${kZoneTop[contact]}
      style=${{ width: `max(4px, ${wide(from, to)})` }} height="11"><title>${spaced(contact)}</title></rect>`)}
    ${heads && html`<svg x=${x(target)}><path class="target" d="M0 20 v32 M0 20 h9 l-3 4 l3 4 h-9"><title>target</title></path></svg>`}
    ${differs(pulses) && html`<svg x=${x(pulses)}><path class="ghost" d="M0 30 l-9 -18 h18 z"><title>commanded</title></path></svg>`}
    ${isOff && html`<svg x=${x(encoder)}><path class="ghost encoder" d="M0 30 l-9 -18 h18 z"><title>encoder</title></path></svg>`}
    <${Carriage} x=${x(position ?? 0)} slip=${slip} perDot=${(width) => (stretch.high - stretch.low) / Math.max(width, 1)} />
  </svg>`;
}
