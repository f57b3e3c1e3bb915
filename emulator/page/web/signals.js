// Signals: every terminal, its level, and what drives it. A click holds an input, another click releases it.
import { html, useEffect } from './preact.js';
import { ask, complain, isLocked, store, unwant, valueOf, want } from './store.js';
import { Button, Choice, Field, Lamp, Slider, isOn } from './small.js';
import { useDevices } from './devices.js';
import { useKept } from './kept.js';
import { usesOf, whyUnused } from './uses.js';

const kTitles = {
  digital_in: 'Inputs', digital_out: 'Outputs', analog_in: 'Analog inputs', analog_number: 'Numbers',
  dip_switch: 'DIP switches, read at power-up', counted_in: 'Counted inputs', analog_out: 'Analog outputs',
  pulse_out: 'Pulse outputs',
};
const kMaxTerminals = 900;  // two names each; a page may watch 2,000

function numberFrom(text) {
  const number = Number(text);
  if (text.trim() === '' || !Number.isFinite(number)) complain(`${text} is not a number`);
  return Number.isFinite(number) ? number : null;
}

/// Inputs are buttons; outputs are only displayed.
function Digital({ device, terminal }) {
  const name = `${device}.${terminal.name}`;
  const [level, by] = [valueOf(name), valueOf(`${name}@by`) ?? ''];
  const uses = (terminal.functions ?? []).join(', ');
  const unused = whyUnused(device, terminal);
  const says = `${terminal.name}${uses ? `, ${uses}` : ''}${by ? `, driven by ${by}` : ''}${unused ? `, ${unused}` : ''}`;
  const lit = isOn(level) ? 'lit' : '';
  const cell = html`<${Lamp} on=${level} says=${terminal.name} /><span>${terminal.name}</span>
    <small>${uses}</small>${unused && html`<small class="unused">${unused}</small>`}<small class=${`by ${by.includes('fault') ? 'bad' : ''}`}>${by === 'device' ? '' : by}</small>`;
  if (terminal.kind === 'digital_out' || terminal.kind === 'pulse_out') return html`<span class=${`signal shown ${lit}`} title=${says}>${cell}</span>`;
  const isDip = terminal.kind === 'dip_switch';
  const isDown = isDip ? isOn(level) : by.includes('held');
  return html`<button type="button" class=${`signal ${lit}`} title=${says} aria-pressed=${isDown} disabled=${isLocked()}
    onClick=${() => ask({ do: 'input', values: { [name]: isDown ? 0 : 1 } })}>${cell}</button>`;
}

function Analog({ device, terminal }) {
  const name = `${device}.${terminal.name}`;
  const value = valueOf(name);
  const unit = terminal.unit ?? '';
  const hold = (level) => ask({ do: 'input', values: { [name]: level } });
  return html`<div class="signal analog shown" role="group" aria-label=${terminal.name}><span>${terminal.name}</span>
    ${terminal.kind !== 'analog_out' && html`<${Slider} label=${terminal.name} lowest=${terminal.lowest} highest=${terminal.highest}
        value=${value} disabled=${isLocked()} takes=${hold} />
      <${Field} label=${`set ${terminal.name}, ${terminal.lowest} to ${terminal.highest} ${unit}`} of=${device} placeholder=${unit || 'set'} size="6"
        disabled=${isLocked()} takes=${async (text) => { const to = numberFrom(text); return to !== null && (await hold(to)).ok; }} />`}
    <output class="figure" aria-live="off">${value ?? '–'} ${unit}</output></div>`;
}

function Wheel({ device, terminal }) {
  const name = `${device}.${terminal.name}`;
  const turn = (counts, during) =>
    ask({ do: 'turn', values: { [name]: counts }, ...(during ? { in: during } : {}) });
  return html`<div class="signal analog shown" role="group" aria-label=${terminal.name}><span>${terminal.name}</span>
    <span class="joined">${[-100, -10, -1, 1, 10, 100].map((counts) => html`<${Button} kind="small" key=${counts} title=${`turn ${terminal.name} by ${counts}`}
      disabled=${isLocked()} does=${() => turn(counts)}>${counts > 0 ? `+${counts}` : counts}<//>`)}</span>
    <${Field} label=${`turn ${terminal.name} by, in a second`} of=${device} placeholder="counts in 1 s" disabled=${isLocked()}
      takes=${async (text) => { const by = numberFrom(text); return by !== null && (await turn(by, '1s')).ok; }} />
    <output class="figure" aria-live="off">${valueOf(name) ?? '–'}</output></div>`;
}

const kTwoLevels = ['digital_in', 'digital_out', 'dip_switch', 'pulse_out'];

const kMany = 40;      // more terminals of a kind are in groups,
const kInAGroup = 16;  // of this size, if the device has no groups for them;
const kFew = 4;        // fewer share a group

/// A long list falls into the groups that the device names, or that its numbers make. Returns [title, terminals] of each.
function groupsOf(device, terminals) {
  if (terminals.length <= kMany) return [['', terminals]];
  const all = store.devices[device].terminals;
  const groups = new Map();
  for (const terminal of terminals) {
    const at = all.indexOf(terminal);
    const named = (store.devices[device].groups ?? []).find(({ first, count }) => {
      const begin = all.findIndex(({ name }) => name === first);
      return at >= begin && at < begin + count;
    });
    const title = named?.name ?? `${(terminal.name.match(/^[^\d]*/)?.[0] || 'others').replace(/[_. ]+$/, '')}`;
    groups.set(title, [...(groups.get(title) ?? []), terminal]);
  }
  const few = [...groups].filter(([, some]) => some.length < kFew);
  for (const [title] of few) groups.delete(title);
  if (few.length > 0) groups.set('others', few.flatMap(([, some]) => some));
  return [...groups].flatMap(([title, some]) => (some.length <= kMany ? [[title, some]]
    : Array.from({ length: Math.ceil(some.length / kInAGroup) }, (_, i) => {
      const part = some.slice(i * kInAGroup, (i + 1) * kInAGroup);
      return [`${part[0].name} to ${part.at(-1).name}`, part];
    })));
}

/// How many of a group are on, and whether one has changed; also shown while the group is closed.
function Group({ device, title, children, terminals, isFirst }) {
  const wired = terminals.filter((it) => isWired(device, it)).length;
  const [isOpen, open] = useKept(`group ${title} of ${device}`, isFirst || wired > 0);
  const lit = terminals.filter((it) => isOn(valueOf(`${device}.${it.name}`))).length;
  const changed = changedSince();
  const news = terminals.filter((it) => changed.has(`${device}.${it.name}`)).length;
  const facts = [`${terminals.length}`, lit > 0 && `${lit} on`, wired > 0 && `${wired} wired`, news > 0 && `${news} changed`].filter(Boolean).join(', ');
  return html`<details class="group" open=${isOpen} onToggle=${(event) => open(event.currentTarget.open)}><summary>${title} <small>${facts}</small></summary>${isOpen && children}</details>`;
}

function Terminals({ device, kind, terminals, isNarrowed }) {
  const One = kind === 'counted_in' ? Wheel : kTwoLevels.includes(kind) ? Digital : Analog;
  const list = (some) => html`<div class=${One === Digital ? 'signals' : 'analogs'}>${some.map((terminal) =>
      html`<${One} key=${terminal.name} device=${device} terminal=${terminal} />`)}</div>`;
  const groups = isNarrowed ? [['', terminals]] : groupsOf(device, terminals);
  return html`<h3>${kTitles[kind] ?? kind}</h3>
    ${groups.map(([title, some], i) => (title === '' ? list(some)
      : html`<${Group} key=${title} device=${device} title=${title} terminals=${some} isFirst=${i === 0}>${list(some)}<//>`))}`;
}

/// Returns true for a terminal that has been seen with another level before.
const changedSince = () => new Set(Object.keys(store.changes));

/// Returns true if the machine, a wire or a function of the device uses it.
function isWired(device, terminal) {
  const name = `${device}.${terminal.name}`;
  return (terminal.functions ?? []).length > 0 || (store.bench?.wires ?? []).some(({ from, to }) => from === name || to === name);
}

export function Signals() {
  const [filter, setFilter] = useKept('filter of signals', '');
  const [devices, choice] = useDevices('signals', (device) => device.terminals.length, kMaxTerminals);
  const [which, setWhich] = useKept('which signals', 'all');
  const changed = changedSince();
  const fits = (terminal, device) => [terminal.name, ...(terminal.functions ?? [])].some((text) => text.toLowerCase().includes(filter.toLowerCase())) &&
    (which === 'all' || (which === 'wired' ? isWired(device, terminal) : changed.has(`${device}.${terminal.name}`)));
  const shown = devices.map((device) => device.name).join();
  useEffect(() => {
    want('signals', devices.flatMap((device) => device.terminals.filter((it) => which === 'changed' || fits(it, device.name))
      .flatMap(({ name }) => [`${device.name}.${name}`, `${device.name}.${name}@by`])
      .concat(usesOf(device.name, device.terminals))));
    return () => unwant('signals');
  }, [store.bench, filter, which, shown]);
  return html`<div class="bar">${choice}<input type="search" aria-label="find a signal" placeholder="find a signal" value=${filter}
      onInput=${(event) => setFilter(event.target.value)} />
      <${Choice} label="which signals" value=${which} takes=${setWhich} options=${[['all', 'all signals'], ['wired', 'wired or used'], ['changed', 'changed since the page was opened']]} />
      <small>Click an input to hold it on; click again to release it. Stuck levels are faults.</small></div>
    ${devices.map((device) => html`<section class="device" key=${device.name}><h2>${device.name}</h2>
      ${Object.keys(kTitles).map((kind) => [kind, device.terminals.filter((it) => it.kind === kind && fits(it, device.name))])
        .filter(([, terminals]) => terminals.length > 0)
        .map(([kind, terminals]) => html`<${Terminals} key=${kind} device=${device.name} kind=${kind}
          terminals=${terminals} isNarrowed=${filter !== '' || which !== 'all'} />`)}
    </section>`)}
    ${devices.map((device) => device.terminals.length === 0 && html`<p key=${device.name}>${device.name} has no terminals: it has only registers.</p>`)}
    ${(store.bench?.wires ?? []).length > 0 && html`<h2>Wires</h2><ul class="wires">${store.bench.wires.map((wire) =>
      html`<li key=${wire.from + wire.to}>${wire.from} → ${wire.to}</li>`)}</ul>`}`;
}
