// Axes: for each a rail with what lies along it, where it is, and what can be done to it.
import { html, useEffect, useState } from './preact.js';
import { ask, isReadOnly, store, unwant, valueOf, want } from './store.js';
import { Button, Lamp, grouped, isOn } from './small.js';
import { Plane } from './plane.js';
import { FaultForm } from './fault_form.js';

const kValues = ['position', 'pulses', 'speed', 'lost', 'encoder', 'ready', 'alarm', 'pwm'];
const kSwitches = ['lower_limit', 'near_home', 'home', 'mark', 'upper_limit'];
const kWidth = 1000;  // of the rail's drawing

// The stretch that each rail shows; it only grows, so that nothing jumps.
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
  if (known && low >= known.low && high <= known.high) return known;
  const margin = (high - low) * room;
  const made = { low: low - margin, high: high + margin };
  stretches.set(key, made);
  return made;
}

/// Where a switch is on, as drawn: a limit is on from its place outwards.
function zoneOf(name, machine, stretch) {
  const it = machine[name];
  if (!it) return null;
  if (it.on) return it.on;
  return name === 'lower_limit' ? [stretch.low, it.at] : [it.at, stretch.high];
}

function terminalOf(device, axis, contact) {
  return device.terminals.find((terminal) => (terminal.functions ?? []).includes(`${axis}.${contact}`));
}

async function press(device, terminal, drivers) {
  const isHeld = (drivers ?? '').includes('held');
  await ask({ do: 'input', values: { [`${device}.${terminal}`]: isHeld ? 0 : 1 } });
}

async function stick(device, terminal, level) {
  await ask({ do: 'inject', fault: { stuck: `${device}.${terminal}`, level } });
}

async function loosen(device, terminal) {
  for (const { number, fault } of store.status?.faults ?? []) {
    if (fault.startsWith(`stuck ${device}.${terminal}`)) await ask({ do: 'clear', number });
  }
}

function Switch({ device, axis, contact }) {
  const terminal = terminalOf(device, axis.name, contact);
  const level = valueOf(`${device.name}.${axis.name}.${contact}`);
  if (!terminal) return html`<span class="switch"><${Lamp} on=${level} says=${contact} /> ${contact}</span>`;
  const drivers = valueOf(`${device.name}.${terminal.name}@by`) ?? '';
  const isStuck = drivers.includes('fault');
  const locked = isReadOnly();
  const say = `${contact} of ${axis.name}, ${terminal.name}`;
  return html`<span class="switch">
    <${Button} title=${`${say}: hold or let go`} pressed=${drivers.includes('held')} disabled=${locked}
      does=${() => press(device.name, terminal.name, drivers)}><${Lamp} on=${level} says=${say} /> ${contact}<//>
    ${isStuck
      ? html`<${Button} kind="small" title=${`${say}: mend`} disabled=${locked}
          does=${() => loosen(device.name, terminal.name)}>mend<//>`
      : ['on', 'off'].map((to) => html`<${Button} kind="small" title=${`${say}: stuck ${to}`} disabled=${locked}
          does=${() => stick(device.name, terminal.name, to)}>stuck ${to}<//>`)}
  </span>`;
}

function Rail({ device, axis }) {
  const name = `${device.name}.${axis.name}`;
  const value = (what) => valueOf(`${name}.${what}`);
  const machine = axis.machine;
  const [position, pulses] = [value('position'), value('pulses')];
  const stretch = stretchOf(`${store.number}/${name}`, machine, [position, pulses]);
  const x = (place) => {
    const share = (place - stretch.low) / (stretch.high - stretch.low);
    return Math.max(0, Math.min(1, share)) * kWidth;
  };
  const zones = kSwitches.map((contact) => [contact, zoneOf(contact, machine, stretch)]).filter(([, zone]) => zone);
  const differs = typeof pulses === 'number' && typeof position === 'number' && pulses !== position;
  const says = `${name} at ${grouped(position)} pulses`;
  return html`<svg class="rail" viewBox=${`0 0 ${kWidth} 76`} preserveAspectRatio="none" role="img" aria-label=${says}>
    <rect class="bed" x="0" y="36" width=${kWidth} height="8" />
    ${machine.travel && html`
      <rect class="stop" x="0" y="20" width=${x(machine.travel[0])} height="40" />
      <rect class="stop" x=${x(machine.travel[1])} y="20" width=${kWidth - x(machine.travel[1])} height="40" />`}
    ${zones.map(([contact, [from, to]]) => html`<rect key=${contact}
      class=${`zone ${contact} ${isOn(value(contact)) ? 'lit' : ''}`} x=${x(from)} y=${kZoneTop[contact]}
      width=${Math.max(x(to) - x(from), 3)} height="12"><title>${contact}</title></rect>`)}
    ${differs && html`<path class="ghost" d=${`M${x(pulses)} 30 l-9 -16 h18 z`}><title>commanded</title></path>`}
    <line class="hair" x1=${x(position ?? 0)} x2=${x(position ?? 0)} y1="12" y2="66" />
    <path class="carriage" d=${`M${x(position ?? 0)} 34 l-9 -18 h18 z`} />
  </svg>`;
}
const kZoneTop = { lower_limit: 46, upper_limit: 46, home: 46, near_home: 60, mark: 60 };

function Axis({ device, axis }) {
  const [breaking, setBreaking] = useState(false);
  const name = `${device.name}.${axis.name}`;
  const value = (what) => valueOf(`${name}.${what}`);
  const present = (what) => value(what) !== undefined && value(what) !== null;
  const servo = axis.servo && valueOf(`${device.name}.${axis.servo}`);
  const broken = (store.status?.faults ?? []).filter(({ fault }) => fault.split(/[ ,]/)[1] === name);
  return html`<section class="axis" aria-label=${name}>
    <header>
      <h3>${axis.name}</h3>
      <output class="figure">${grouped(value('position'))}</output> <small>pulses</small>
      <output class="figure">${grouped(value('speed'))}</output> <small>pulses/s</small>
      ${present('encoder') && axis.machine.encoder &&
        html`<output class="figure">${grouped(value('encoder'))}</output> <small>encoder</small>`}
      ${value('lost') ? html`<strong class="bad">${grouped(value('lost'))} lost</strong>` : ''}
      ${axis.servo && html`<span class="lampline"><${Lamp} on=${servo} says="servo" /> servo</span>`}
      ${present('ready') && html`<span class="lampline"><${Lamp} on=${value('ready')} says="ready" /> ready</span>`}
      ${present('alarm') && html`<span class=${`lampline ${isOn(value('alarm')) ? 'bad' : ''}`}>
        <${Lamp} on=${value('alarm')} says="alarm" /> alarm</span>`}
      <${Button} kind="small" title=${`break ${name}`} pressed=${breaking} disabled=${isReadOnly()}
        does=${() => setBreaking(!breaking)}>break...<//>
    </header>
    <${Rail} device=${device} axis=${axis} />
    <div class="switches">
      ${kSwitches.filter((contact) => axis.machine[contact] || terminalOf(device, axis.name, contact))
        .map((contact) => html`<${Switch} key=${contact} device=${device} axis=${axis} contact=${contact} />`)}
      ${broken.map(({ number, fault }) => html`<span class="bad" key=${number}>${fault.split(' ')[0]}
        <${Button} kind="small" title=${`clear fault ${number}`} disabled=${isReadOnly()}
          does=${() => ask({ do: 'clear', number })}>clear<//></span>`)}
    </div>
    ${breaking && html`<${FaultForm} places=${['axis']} place=${name} done=${() => setBreaking(false)} />`}
  </section>`;
}

export function Axes() {
  const devices = Object.values(store.devices);
  useEffect(() => {
    want('axes', devices.flatMap((device) => device.axes.flatMap((axis) => {
      const name = `${device.name}.${axis.name}`;
      const contacts = kSwitches.filter((it) => axis.machine[it] || terminalOf(device, axis.name, it));
      const terminals = contacts.map((it) => terminalOf(device, axis.name, it)).filter(Boolean);
      return [...kValues, ...contacts].map((what) => `${name}.${what}`)
        .concat(terminals.map((terminal) => `${device.name}.${terminal.name}@by`),
                axis.servo ? [`${device.name}.${axis.servo}`] : []);
    })));
    return () => unwant('axes');
  }, [store.bench]);
  return devices.map((device) => html`<section class="device" key=${device.name}>
    <h2>${device.name}</h2>
    <div class="with_plane">
      <div class="rails">${device.axes.map((axis) => html`<${Axis} key=${axis.name} device=${device} axis=${axis} />`)}</div>
      ${device.axes.length > 1 && html`<${Plane} device=${device} />`}
    </div>
  </section>`);
}
