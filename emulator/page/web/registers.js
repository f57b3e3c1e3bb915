// Registers by the manual's sections: values, ranges, bits, who changed them; written with the range check's own words.
import { html, useEffect, useState } from './preact.js';
import { ask, askQuietly, flashOf, isReadOnly, store, unwant, valueOf, want } from './store.js';
import { Button, Choice, Field, save } from './small.js';

const kPage = 100;

function bitsOf(row, value) {
  if (!row.bits || typeof value !== 'number') return null;
  return row.bits.map(({ bit, width, name }) => {
    const part = Math.floor(value / 2 ** bit) % 2 ** width;
    return html`<span key=${name} class=${part ? 'bit set' : 'bit'} title=${`bit ${bit}`}>${name}${width > 1 ? `=${part}` : ''}</span>`;
  });
}

const rangeOf = (row) => (row.min !== undefined ? `${row.min} to ${row.max}` : '');
const isPlain = (row) => !row.window && row.access !== 'W';

function Row({ device, row, explain }) {
  const name = `${device}.${row.name}`;
  const value = valueOf(name);
  const flash = flashOf(name);
  const hex = Number.isInteger(value) && row.type !== 'bit' ? `0x${(value < 0 ? value + 2 ** 32 : value).toString(16).toUpperCase()}` : '';
  return html`<tr class=${flash ? `flash ${flash}` : ''}>
    <td><span class="name">${row.name}</span> <small>${row.number ?? row.address}${row.table && row.table !== 'holding' ? ` ${row.table}` : ''}</small>
      ${row.meaning && html`<small> ${row.meaning}</small>`}</td>
    <td class="value" title=${hex}>${isPlain(row) ? value ?? '–' : ''} <small>${row.unit ?? ''}</small></td>
    <td class="by">${flash}</td>
    <td>${row.access !== 'R' && !row.window && html`<${Field} label=${`write ${row.name}`} placeholder="write" size="8"
      disabled=${isReadOnly()} takes=${async (text) => (await ask({ do: 'set', values: { [name]: Number(text) } })).ok} />`}</td>
    <td><small>${row.access}${row.kept ? ', kept' : ''}</small></td>
    <td><small>${rangeOf(row)}${row.factory !== undefined ? ` (${row.factory})` : ''}</small></td>
    <td>${bitsOf(row, value)}${row.not_modelled && html`<small class="bad" title=${row.not_modelled}>not modelled</small>`}
      ${(row.choices ?? []).map((id) => html`<${Button} kind="small" key=${id} title=${`the choice ${id}`}
        does=${() => explain(id)}>${id}<//>`)}</td>
  </tr>`;
}

async function allChoices(device) {
  const all = [];
  for (let from = 0; from !== undefined;) {
    const reply = await askQuietly({ do: 'choices', device, from });
    all.push(...(reply.choices ?? []));
    from = reply.next;
  }
  return all;
}

export function Registers() {
  const devices = Object.values(store.devices).filter((device) => device.sections.length > 0);
  const [deviceName, setDevice] = useState('');
  const [section, setSection] = useState('0');
  const [find, setFind] = useState('');
  const [from, setFrom] = useState(0);
  const [page, setPage] = useState({ registers: [], of: 0 });
  const [onlyHeard, setHeard] = useState(false);
  const [choice, setChoice] = useState(null);
  const device = devices.find((it) => it.name === deviceName) ?? devices[0];

  useEffect(() => {
    if (!device) return;
    let current = true;
    const wish = { do: 'registers', device: device.name, from, count: kPage };
    if (find !== '') wish.find = find;
    else if (!onlyHeard) wish.section = Number(section);
    const load = async () => {
      let reply = await askQuietly(wish);
      if (onlyHeard) {
        const heard = [];
        for (let next = 0; next !== undefined && heard.length < 200;) {
          reply = await askQuietly({ ...wish, from: next, count: 200 });
          heard.push(...(reply.registers ?? []).filter((row) => store.heard.has(`${device.name}.${row.name}`)));
          next = reply.next;
        }
        reply = { ok: true, registers: heard, of: heard.length };
      }
      if (current && reply.ok) setPage(reply);
    };
    load();
    return () => { current = false; };
  }, [device?.name, section, find, from, onlyHeard, onlyHeard && store.heard.size, store.bench]);

  useEffect(() => {
    if (device) want('registers', page.registers.filter(isPlain).map((row) => `${device.name}.${row.name}`));
    return () => unwant('registers');
  }, [page, device?.name]);

  if (!device) return html`<p>No device of this bench has registers.</p>`;
  const explain = async (id) => setChoice((await allChoices(device.name)).find((it) => it.id === id));
  const at = device.sections[Number(section)];
  return html`<div class="bar">
      ${devices.length > 1 && html`<${Choice} label="device" value=${device.name} options=${devices.map((it) => it.name)}
        takes=${(name) => { setDevice(name); setSection('0'); setFrom(0); }} />`}
      <${Choice} label="section of the manual" value=${section} disabled=${find !== '' || onlyHeard}
        options=${device.sections.map((it) => [String(it.number), `${it.english || it.name} (${it.rows})`])}
        takes=${(number) => { setSection(number); setFrom(0); }} />
      <input type="search" aria-label="find a register by name or number" placeholder="find: name or number" value=${find}
        onInput=${(event) => { setFind(event.target.value); setFrom(0); }} />
      <label class="check"><input type="checkbox" checked=${onlyHeard} onChange=${(event) => { setHeard(event.target.checked); setFrom(0); }} />
        only what the host uses</label>
      <${Button} title="save what is shown as CSV" does=${() => save('registers.csv', [page.registers.map((row) =>
        `${row.name},${row.address ?? row.number},${valueOf(`${device.name}.${row.name}`) ?? ''}`).join('\n')], 'text/csv')}>CSV<//>
    </div>
    ${find === '' && !onlyHeard && html`<p class="section_name">${at?.name} <small>${at?.english}</small></p>`}
    ${choice && html`<aside class="choice"><strong>${choice.id}</strong> (${choice.section}): ${choice.question}
      <p>Chosen: <b>${choice.chosen}</b> of ${choice.options.join(', ')}. ${choice.why} <small>${choice.confidence}</small></p>
      <${Button} title="close" does=${() => setChoice(null)}>close<//></aside>`}
    <div class="scroll"><table class="registers">
      <thead><tr><th>name</th><th>value</th><th>changed by</th><th>write</th><th>access</th><th>range (factory)</th><th>bits, choices</th></tr></thead>
      <tbody>${page.registers.map((row) => html`<${Row} key=${row.name} device=${device.name} row=${row} explain=${explain} />`)}</tbody>
    </table></div>
    <div class="bar"><small>${page.of} in all</small>
      ${from > 0 && html`<${Button} title="back" does=${() => setFrom(Math.max(0, from - kPage))}>back<//>`}
      ${page.next !== undefined && html`<${Button} title="further" does=${() => setFrom(page.next)}>further<//>`}</div>`;
}
