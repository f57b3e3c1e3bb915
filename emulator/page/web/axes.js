// Axes: a rail for each axis, with its switches and positions, and controls for its machine.
import { html, useEffect } from './preact.js';
import { ask, isLocked, store, unwant, valueOf, want } from './store.js';
import { Button, Lamp, grouped, inTenths, isOn, spaced } from './small.js';
import { Plane } from './plane.js';
import { Rail, kSwitches } from './rail.js';
import { usesOf, whyUnused } from './uses.js';
import { useDevices } from './devices.js';
import { FaultForm } from './fault_form.js';
import { useKept } from './kept.js';

const kValues = ['position', 'pulses', 'target', 'speed', 'servo', 'lost', 'encoder', 'ready', 'alarm', 'pwm'];
const kMaxAxes = 64;

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
  // Do not use the last status: it may be older than the fault.
  for (const { number, fault } of (await ask({ do: 'list' })).faults ?? []) {
    if (`${fault} `.startsWith(`stuck ${device}.${terminal} `)) await ask({ do: 'clear', number });
  }
}

function Switch({ device, axis, contact }) {
  const terminal = terminalOf(device, axis.name, contact);
  const level = valueOf(`${device.name}.${axis.name}.${contact}`);
  const swatch = axis.machine[contact] && html`<i class=${`swatch ${contact}`} aria-hidden="true"></i>`;
  if (!terminal) return html`<span class="switch alone">${swatch}<${Lamp} on=${level} says=${contact} /> ${spaced(contact)}</span>`;
  const input = valueOf(`${device.name}.${terminal.name}`);
  const drivers = valueOf(`${device.name}.${terminal.name}@by`) ?? '';
  const isStuck = drivers.includes('fault');
  const locked = isLocked();
  const unused = whyUnused(device.name, terminal);
  const say = `${contact} of ${axis.name}, ${terminal.name}`;
  return html`<span class="switch joined" role="group" aria-label=${say}>
    <${Button} kind="small" title=${`${say}: hold or release`} pressed=${drivers.includes('held')} disabled=${locked}
      does=${() => press(device.name, terminal.name, drivers)}>${swatch}<${Lamp} on=${input ?? level} says=${say} /> ${spaced(contact)}<//>
    ${isStuck
      ? html`<${Button} kind="small bad" title=${`${say}: clear the fault`} disabled=${locked}
          does=${() => loosen(device.name, terminal.name)}>stuck, clear<//>`
      : ['on', 'off'].map((to) => html`<${Button} kind="small faint" title=${`${say}: stuck ${to}`} disabled=${locked}
          does=${() => stick(device.name, terminal.name, to)}>stuck ${to}<//>`)}
    ${unused && html`<small class="unused">${unused}</small>`}
  </span>`;
}

function Figure({ value, unit, wide, as = grouped }) {
  return html`<span class=${wide ? 'reading wide' : 'reading'}><output class="figure" aria-live="off">${as(value)}</output> <small>${unit}</small></span>`;
}

function Axis({ device, axis }) {
  const name = `${device.name}.${axis.name}`;
  const [breaking, setBreaking] = useKept(`breaking ${name}`, false);
  const value = (what) => valueOf(`${name}.${what}`);
  const present = (what) => value(what) !== undefined && value(what) !== null;
  const broken = (store.status?.faults ?? []).filter(({ fault }) => fault.split(/[ ,]/)[1] === name);
  const heads = present('target') && value('target') !== value('pulses');
  return html`<section class="axis" aria-label=${name}>
    <header>
      <h3>${axis.name}</h3>
      <${Figure} value=${value('position')} unit="pulses" wide />
      <${Figure} value=${value('speed')} unit="pulses/s" as=${inTenths} />
      <${Figure} value=${heads ? value('target') : undefined} unit="target" />
      ${axis.machine.encoder && html`<${Figure} value=${value('encoder')} unit="encoder" />`}
      ${present('pwm') && value('pwm') !== 0 && html`<${Figure} value=${value('pwm')} unit="% duty" />`}
      <span class="lamps">
        ${value('lost') ? html`<strong class="bad">${grouped(value('lost'))} lost</strong>` : ''}
        ${present('servo') && html`<span class="lampline"><${Lamp} on=${value('servo')} says="servo" /> servo</span>`}
        ${present('ready') && axis.machine.drive && html`<span class="lampline"><${Lamp} on=${value('ready')} says="ready" /> ready</span>`}
        ${present('alarm') && (axis.machine.drive || isOn(value('alarm'))) && html`<span class=${`lampline ${isOn(value('alarm')) ? 'bad' : ''}`}>
          <${Lamp} on=${value('alarm')} says="alarm" /> alarm</span>`}
        <${Button} kind="small faint" title=${`break ${name}`} pressed=${breaking} disabled=${isLocked()}
          does=${() => setBreaking(!breaking)}>break ...<//>
      </span>
    </header>
    <${Rail} device=${device} axis=${axis} press=${(contact) => {
      const terminal = terminalOf(device, axis.name, contact);
      return terminal && !isLocked() ? () => press(device.name, terminal.name, valueOf(`${device.name}.${terminal.name}@by`)) : undefined;
    }} slip=${isLocked() ? undefined : (by) => ask({ do: 'inject', fault: { slip: name, pulses: by } })} />
    <div class="switches">
      ${kSwitches.filter((contact) => axis.machine[contact] || terminalOf(device, axis.name, contact))
        .map((contact) => html`<${Switch} key=${contact} device=${device} axis=${axis} contact=${contact} />`)}
      ${broken.map(({ number, fault }) => html`<span class="bad bar" key=${number}>${spaced(fault.split(' ')[0])}
        <${Button} kind="small" title=${`clear fault ${number}`} disabled=${isLocked()}
          does=${() => ask({ do: 'clear', number })}>clear<//></span>`)}
    </div>
    ${breaking && html`<${FaultForm} places=${['axis']} place=${name} done=${() => setBreaking(false)} />`}
  </section>`;
}

/// Makes the model's first move step by step, for users without a host.
function FirstMove({ device }) {
  const isNew = store.frames.length === 0 && !store.timeline;
  if (!device.first_move || !isNew) return null;
  const wordsOf = ({ set, command, program }) => (program ? 'a program' : null) ?? command ?? Object.entries(set).map(([name, value]) => `${name} = ${value}`).join(', ');
  const move = async () => {
    for (const { set, command, program } of device.first_move) {
      const message = program !== undefined ? { do: 'program', device: device.name, text: program }
        : command !== undefined ? { do: 'command', device: device.name, text: command }
        : { do: 'set', values: Object.fromEntries(Object.entries(set).map(([name, value]) => [`${device.name}.${name}`, value])) };
      if (!(await ask(message)).ok) return;
    }
  };
  return html`<div class="bar"><${Button} kind="small" title=${`a first move without a host: ${device.first_move.map(wordsOf).join('; ')}`} disabled=${isLocked()} does=${move}>try a first move<//></div>`;
}

export function Axes() {
  const [devices, choice] = useDevices('axes', (device) => device.axes.length, kMaxAxes);
  const shown = devices.map((device) => device.name).join();
  useEffect(() => {
    want('axes', devices.flatMap((device) => device.axes.flatMap((axis) => {
      const name = `${device.name}.${axis.name}`;
      const contacts = kSwitches.filter((it) => axis.machine[it] || terminalOf(device, axis.name, it));
      const found = contacts.map((it) => terminalOf(device, axis.name, it)).filter(Boolean);
      const terminals = found.map((it) => `${device.name}.${it.name}`);
      return [...kValues, ...contacts].map((what) => `${name}.${what}`)
        .concat(terminals, terminals.map((terminal) => `${terminal}@by`), usesOf(device.name, found));
    })));
    return () => unwant('axes');
  }, [store.bench, shown]);
  return html`${choice && html`<div class="bar">${choice}</div>`}
    ${devices.map((device) => html`<section class="device" key=${device.name}>
    <h2>${device.name}</h2><${FirstMove} device=${device} />
    ${device.axes.length === 0 && html`<p>This device has no axes.</p>`}
    <div class="with_plane">
      <div class="rails">${device.axes.map((axis) => html`<${Axis} key=${axis.name} device=${device} axis=${axis} />`)}</div>
      ${device.axes.length > 1 && html`<${Plane} device=${device} />`}
    </div>
  </section>`)}`;
}
