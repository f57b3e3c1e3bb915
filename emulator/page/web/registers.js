// Registers by the manual's sections, with values, ranges, bits, and who changed them. A write reports the program's
// own range check.
import { html, useEffect, useState } from './preact.js';
import { ask, askQuietly, complain, flashOf, isLocked, store, unwant, valueOf, want } from './store.js';
import { Button, Choice, Field, exactly, grouped, nameOfBench, save, seconds } from './small.js';
import { keep, useKept } from './kept.js';
import { useOf } from './heard.js';

const kPage = 100;
const kMaxHeard = 400;

function bitsOf(row, value) {
  if (!row.bits || typeof value !== 'number') return null;
  return row.bits.map(({ bit, width, name }) => {
    const part = Math.floor(value / 2 ** bit) % 2 ** width;
    return html`<span key=${name} class=${part ? 'bit set' : 'bit'} title=${`bit ${bit}: ${part}`}>${name}${width > 1 ? `=${part}` : ''}</span>`;
  });
}

/// A section that the manual numbers keeps its number.
const titleOf = ({ name, english }) => (!english || english === name ? name : /^\d/.test(name) ? `${name} ${english}` : english);
const rangeOf = (row) => (row.min !== undefined ? `${row.min} to ${row.max}` : '');
const isPlain = (row) => !row.window && row.access !== 'W';

async function write(name, text) {
  const number = Number(text);
  if (!Number.isFinite(number)) { complain(`${text} is not a number; expected one such as 0x10 or -5`); return false; }
  return (await ask({ do: 'set', values: { [name]: number } })).ok;
}

/// Shows who wrote it last, and when. A click lists its writes.
function Writer({ name }) {
  const last = store.writers[name];
  if (!last) return null;
  const list = () => { keep('filter of events', name); keep('panel', 'Events', { of: '' }); };
  return html`<button type="button" class="link" title=${`list what has happened to ${name}`} onClick=${list}><small>${last.by} ${seconds(last.time_ns)}</small></button>`;
}

/// Shows how often hosts use it, and since when.
function Use({ use }) {
  const seconds_used = Math.max((use.last_ns - use.since_ns) / 1e9, 1e-3);
  const rate = (count, what) => count > 0 && `${what} ${count === 1 ? 'once' : count < 4 ? `${count} times` : `${grouped(Math.round(count / seconds_used * 10) / 10)}/s`}`;
  return html`<small class="use">${[rate(use.reads, 'read'), rate(use.writes, 'written')].filter(Boolean).join(', ')}, since ${seconds(use.since_ns)}
    ${use.exceptions > 0 && html` <b class="bad">${grouped(use.exceptions)} ${use.exceptions === 1 ? 'exception' : 'exceptions'}</b>`}</small>`;
}

/// A map of the registers that hosts use, darker with more use. A click finds the register.
function UseMap({ rows, words, find }) {
  const uses = rows.map((row) => [row, useOf(words, row)]).filter(([, use]) => use);
  const most = Math.max(1, ...uses.map(([, use]) => use.reads + use.writes));
  return html`<div class="map" role="group" aria-label="registers that hosts use">${uses.map(([row, use]) => {
    const share = Math.log1p(use.reads + use.writes) / Math.log1p(most);
    return html`<button type="button" key=${row.name} class=${`${use.writes > 0 ? 'written' : ''} ${use.exceptions > 0 ? 'refused' : ''}`} style=${{ '--share': `${Math.round(20 + 80 * share)}%` }}
      title=${`${row.name}: read ${use.reads}, written ${use.writes}, exceptions ${use.exceptions}`} aria-label=${row.name} onClick=${() => find(row.name)}></button>`;
  })}</div>`;
}

function Row({ device, row, explain, section, use }) {
  const name = `${device}.${row.name}`;
  const value = valueOf(name);
  const flash = flashOf(name, device, row.access !== 'R');
  const isOther = row.factory !== undefined && row.access !== 'R' && isPlain(row) && typeof value === 'number' && value !== Number(row.factory);
  const hex = Number.isInteger(value) && row.type !== 'bit' ? `0x${(value < 0 ? value + 2 ** 32 : value).toString(16).toUpperCase()}` : '';
  return html`<tr class=${flash ? `flash ${flash}` : ''}>
    <td class="what"><span class="name">${row.name}</span> <small>${row.number === row.name ? '' : row.number ?? row.address}${row.table && row.table !== 'holding' ? ` ${row.table}` : ''}</small>
      ${row.meaning && html`<small> ${row.meaning}</small>`}${row.heading && html`<small class="heading" lang="zh"> ${row.heading}</small>`}${section && html`<small class="section"> ${section}</small>`}</td>
    <td class="value" title=${hex}>${isPlain(row) ? html`${value ?? '–'} <small>${row.unit ?? ''}</small>` : ''}</td>
    <td class="by">${flash || html`<${Writer} name=${name} />`}</td>
    <td class="write">${row.access !== 'R' && !row.window && html`<${Field} label=${`write ${row.name}`} of=${device} placeholder="write" size="8"
      disabled=${isLocked()} takes=${(text) => write(name, text)} />`}</td>
    <td class="access"><small>${row.access}${row.kept ? html`, <b>kept</b>` : ''}</small></td>
    <td class="range"><small>${rangeOf(row)}</small></td>
    <td class="factory"><small class=${isOther ? 'other' : ''} title=${isOther ? 'the value differs from the factory value' : ''}>${row.factory ?? ''}</small></td>
    <td class="more">${use && html`<${Use} use=${use} />`}${bitsOf(row, value)}${row.not_modelled && html`<small class="bad" title=${row.not_modelled}>not modelled</small> `}
      ${(row.choices ?? []).map((id) => html`<${Button} kind="small" key=${id} title=${`the choice ${id}`}
        does=${() => explain(id)}>${id}<//>`)}</td>
  </tr>`;
}

async function allOf(message, key) {
  const all = [];
  for (let from = 0; from !== undefined;) {
    const reply = await askQuietly({ ...message, from });
    all.push(...(reply[key] ?? []));
    from = reply.next;
  }
  return all;
}

// Requests every row of a device's tables once, for the bench that is shown.
const tables = new Map();
function tableOf(device) {
  if (tables.get(device.name)?.device !== device) {
    tables.set(device.name, { device, rows: allOf({ do: 'registers', device: device.name, count: 200 }, 'registers') });
  }
  return tables.get(device.name).rows;
}

export function Registers() {
  const devices = Object.values(store.devices).filter((device) => device.sections.length > 0);
  const [deviceName, setDevice] = useKept('device of registers', '');
  const [section, setSection] = useKept('section', '0');
  const [find, setFind] = useKept('find a register', '');
  const [from, setFrom] = useKept('first register', 0);
  const [page, setPage] = useState(/** @type {any} */ ({ registers: [], of: 0 }));
  const [onlyHeard, setHeard] = useKept('only what hosts use', false);
  const [choice, setChoice] = useKept('choice that is told', null);
  const device = devices.find((it) => it.name === deviceName) ?? devices[0];
  const words = store.heard.get(device?.name);
  const heardSoFar = onlyHeard ? words?.size ?? 0 : 0;

  useEffect(() => {
    if (!device) return;
    let current = true;
    const load = async () => {
      if (!onlyHeard) {
        const where = find !== '' ? { find } : { section: Number(section) };
        return askQuietly({ do: 'registers', device: device.name, from, count: kPage, ...where });
      }
      const rows = (await tableOf(device)).filter((row) => useOf(words, row) &&
        (find === '' || `${row.name} ${row.address ?? row.number} ${row.meaning ?? ''} ${row.heading ?? ''}`.toLowerCase().includes(find.toLowerCase())));
      return { ok: true, registers: rows.slice(0, kMaxHeard), of: rows.length };
    };
    load().then((reply) => { if (current && reply.ok) setPage(reply); });
    return () => { current = false; };
  }, [device?.name, section, find, from, onlyHeard, heardSoFar, store.bench]);

  useEffect(() => {
    if (device) want('registers', page.registers.filter(isPlain).map((row) => `${device.name}.${row.name}`));
    return () => unwant('registers');
  }, [page, device?.name]);

  if (!device) return html`<p>No device of this bench has registers.</p>`;
  const explain = async (id) => setChoice((await allOf({ do: 'choices', device: device.name }, 'choices')).find((it) => it.id === id));
  const at = device.sections[Number(section)];
  const englishOf = (name) => device.sections.find((it) => it.name === name)?.english ?? name;
  const isMixed = find !== '' || onlyHeard;
  const sectionOf = (row) => isMixed && device.sections[row.section] && titleOf(device.sections[row.section]);
  const keptWrites = store.status?.devices.find((it) => it.name === device.name)?.kept_writes;
  return html`<div class="bar">
      ${devices.length > 1 && html`<${Choice} label="device" value=${device.name} options=${devices.map((it) => it.name)}
        takes=${(name) => { setDevice(name); setSection('0'); setFrom(0); setPage({ registers: [], of: 0 }); }} />`}
      <${Choice} label="section of the manual" value=${section} disabled=${isMixed}
        options=${device.sections.map((it) => [String(it.number), `${titleOf(it)} (${it.rows})`])}
        takes=${(number) => { setSection(number); setFrom(0); }} />
      <input type="search" aria-label="find a register by name, number or meaning" placeholder="find: name, number, meaning" size="26" value=${find}
        onInput=${(event) => { setFind(event.target.value); setFrom(0); }} />
      <label class="check"><input type="checkbox" checked=${onlyHeard} onChange=${(event) => { setHeard(event.target.checked); setFrom(0); }} />
        only what the host uses</label>
      <${Button} title="save what is shown as CSV" does=${() => save(`registers of ${device.name} ${nameOfBench()} ${exactly(store.look?.time_ns ?? 0)}.csv`, ['name,address,value,unit\n',
        page.registers.map((row) => `"${row.name}",${row.address ?? row.number},${valueOf(`${device.name}.${row.name}`) ?? ''},${row.unit ?? ''}`).join('\n'), '\n'], 'text/csv')}>CSV<//>
      ${keptWrites !== undefined && html`<small>non-volatile memory: <output class="figure count" aria-live="off">${grouped(keptWrites)}</output> ${keptWrites === 1 ? 'write' : 'writes'}</small>`}
    </div>
    ${!isMixed && html`<p class="section_name"><span lang="zh">${at?.name}</span> ${at?.english !== at?.name && html`<small>${at?.english}</small>`}</p>`}
    ${choice && html`<aside class="choice"><strong>${choice.id}</strong> (section ${englishOf(choice.section)}): ${choice.question}
      <p>Chosen: <b>${spacedChoice(choice.chosen)}</b> of ${choice.options.map(spacedChoice).join('; ')}. ${choice.why} <small>${choice.confidence}</small></p>
      <${Button} title="close" does=${() => setChoice(null)}>close<//></aside>`}
    ${onlyHeard && html`<${UseMap} rows=${page.registers} words=${words} find=${(name) => { setFind(name); setFrom(0); }} />`}
    <div class="scroll"><table class="registers">
      <thead><tr><th>name</th><th class="value">value</th><th>changed by</th><th>write</th><th>access</th><th>range</th><th>factory</th><th>bits, choices</th></tr></thead>
      <tbody>${page.registers.map((row) => html`<${Row} key=${row.name} device=${device.name} row=${row} explain=${explain} section=${sectionOf(row)} use=${onlyHeard ? useOf(words, row) : undefined} />`)}</tbody>
    </table></div>
    ${onlyHeard && page.of === 0 && html`<p>No host has used a register yet, or none that matches.</p>`}
    <div class="bar"><small>${grouped(from + Math.min(1, page.of))} to ${grouped(from + page.registers.length)} of ${grouped(page.of)}</small>
      ${from > 0 && html`<${Button} title="previous" does=${() => setFrom(Math.max(0, from - kPage))}>previous<//>`}
      ${page.next !== undefined && html`<${Button} title="next" does=${() => setFrom(page.next)}>next<//>`}</div>`;
}

const spacedChoice = (text) => String(text).replaceAll('_', ' ');
