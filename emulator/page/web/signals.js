// Signals: every terminal, its level, and who drives it. A click holds an input, another lets it go.
import { html, useEffect, useState } from './preact.js';
import { ask, isReadOnly, store, unwant, valueOf, want } from './store.js';
import { Field, Lamp } from './small.js';

const kTitles = {
  digital_in: 'Inputs', digital_out: 'Outputs', analog_in: 'Analog inputs', analog_number: 'Numbers',
  dip_switch: 'DIP switches', counted_in: 'Counted inputs', analog_out: 'Analog outputs', pulse_out: 'Pulse outputs',
};
const kSettable = ['analog_in', 'analog_number', 'dip_switch'];

function Digital({ device, terminal }) {
  const name = `${device}.${terminal.name}`;
  const [level, by] = [valueOf(name), valueOf(`${name}@by`) ?? ''];
  const uses = (terminal.functions ?? []).join(', ');
  const says = `${terminal.name}${uses ? `, ${uses}` : ''}${by ? `, driven by ${by}` : ''}`;
  const cell = html`<${Lamp} on=${level} says=${terminal.name} /><span>${terminal.name}</span>
    <small>${uses}</small><small class="by">${by === 'device' ? '' : by}</small>`;
  if (terminal.kind !== 'digital_in') return html`<span class="signal" title=${says}>${cell}</span>`;
  const isHeld = by.includes('held');
  return html`<button type="button" class="signal" title=${says} aria-pressed=${isHeld} disabled=${isReadOnly()}
    onClick=${() => ask({ do: 'input', values: { [name]: isHeld ? 0 : 1 } })}>${cell}</button>`;
}

function Analog({ device, terminal }) {
  const name = `${device}.${terminal.name}`;
  const value = valueOf(name);
  const isSettable = kSettable.includes(terminal.kind);
  return html`<label class="signal analog"><span>${terminal.name}</span>
    ${isSettable && html`<input type="range" min=${terminal.lowest} max=${terminal.highest} value=${value ?? 0}
      aria-label=${terminal.name} disabled=${isReadOnly()}
      onInput=${(event) => ask({ do: 'input', values: { [name]: Number(event.target.value) } })} />`}
    <output class="figure">${value ?? '–'} ${terminal.unit ?? ''}</output></label>`;
}

function Wheel({ device, terminal }) {
  const name = `${device}.${terminal.name}`;
  const turn = (counts, during) =>
    ask({ do: 'turn', values: { [name]: counts }, ...(during ? { in: during } : {}) });
  return html`<span class="signal analog"><span>${terminal.name}</span>
    ${[-100, -10, -1, 1, 10, 100].map((counts) => html`<button type="button" class="small" key=${counts}
      disabled=${isReadOnly()} onClick=${() => turn(counts)}>${counts > 0 ? `+${counts}` : counts}</button>`)}
    <${Field} label=${`turn ${terminal.name} by, in a second`} placeholder="counts in 1 s" disabled=${isReadOnly()}
      takes=${async (text) => (await turn(Number(text), '1s')).ok} />
    <output class="figure">${valueOf(name) ?? '–'}</output></span>`;
}

function Terminals({ device, kind, terminals }) {
  const One = kind === 'counted_in' ? Wheel : kind.startsWith('digital') ? Digital : Analog;
  return html`<h3>${kTitles[kind] ?? kind}</h3>
    <div class=${One === Digital ? 'signals' : 'analogs'}>${terminals.map((terminal) =>
      html`<${One} key=${terminal.name} device=${device} terminal=${terminal} />`)}</div>`;
}

export function Signals() {
  const [filter, setFilter] = useState('');
  const devices = Object.values(store.devices);
  const fits = (terminal) => [terminal.name, ...(terminal.functions ?? [])]
    .some((text) => text.toLowerCase().includes(filter.toLowerCase()));
  useEffect(() => {
    want('signals', devices.flatMap((device) => device.terminals.filter(fits)
      .flatMap(({ name }) => [`${device.name}.${name}`, `${device.name}.${name}@by`])));
    return () => unwant('signals');
  }, [store.bench, filter]);
  return html`<div class="bar"><input type="search" aria-label="find a signal" placeholder="find a signal" value=${filter}
      onInput=${(event) => setFilter(event.target.value)} />
      <small>A click holds an input on, another lets it go. Stuck levels are faults.</small></div>
    ${devices.map((device) => html`<section class="device" key=${device.name}><h2>${device.name}</h2>
      ${Object.keys(kTitles).map((kind) => [kind, device.terminals.filter((it) => it.kind === kind && fits(it))])
        .filter(([, terminals]) => terminals.length > 0)
        .map(([kind, terminals]) => html`<${Terminals} key=${kind} device=${device.name} kind=${kind}
          terminals=${terminals} />`)}
    </section>`)}
    ${(store.bench?.wires ?? []).length > 0 && html`<h2>Wires</h2><ul>${store.bench.wires.map((wire) =>
      html`<li key=${wire.from + wire.to}>${wire.from} to ${wire.to}</li>`)}</ul>`}`;
}
