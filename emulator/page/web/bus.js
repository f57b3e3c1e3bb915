// The bus: describes the frames on the lines, sends frames by hand, drops the next frame of a kind, and saves a
// capture.
import { html } from './preact.js';
import { ask, isLocked, store, withHoles } from './store.js';
import { Button, Choice, Field, Missed, grouped, save, seconds } from './small.js';
import { keep, kept, useKept } from './kept.js';
import { pcapng } from './pcapng.js';
import { kBounds_ms } from './heard.js';

const kShown = 200;

/// Which of the next frames like a row the row's button drops.
const kNth = 'which of the next to drop';
const nthDropped = () => kept(kNth, 1);
const kOrdinals = ['', '', '2nd ', '3rd ', '4th ', '5th ', '6th ', '7th ', '8th ', '9th '];

const lineNamed = (name) => store.bench?.lines.find((line) => line.name === name);

/// A dropped request does not reach the device. A dropped reply does not reach the host, but its request is executed.
function dropNext(frame) {
  const fault = { drop: frame.line, of: frame.way === 'in' ? 'request' : 'reply', nth: nthDropped(), times: 1 };
  if (!lineNamed(frame.line)?.text && frame.bytes?.length >= 4) {
    fault.function = parseInt(frame.bytes.slice(2, 4), 16) & 0x7f;
    fault.station = parseInt(frame.bytes.slice(0, 2), 16);
    if (fault.station === 0) delete fault.station;
  }
  return ask({ do: 'inject', fault });
}

function Frame({ frame }) {
  const kind = frame.exception || /drop|not received|not sent|cut|corrupt/.test(frame.remark ?? '') ? 'bad' : frame.ignored ? 'ignored' : frame.remark ? 'odd' : '';
  const latency = frame.latency_ns !== undefined ? `${(frame.latency_ns / 1e6).toFixed(2)} ms` : '';
  const isRequest = frame.way === 'in';
  return html`<tr class=${`${frame.way} ${kind}`} title=${frame.bytes}>
    <td class="figure">${seconds(frame.time_ns)}</td><td class="line">${frame.line}</td>
    <td class="way" aria-label=${isRequest ? 'from the host' : 'to the host'}>${isRequest ? '→' : '←'}</td>
    <td class="words">${frame.text || (frame.bytes ? '' : html`<b>no frame</b>`)} ${frame.remark && html`<em>${frame.remark}</em>`}</td>
    <td class="figure">${latency}</td>
    <td>${frame.bytes && html`<${Button} kind="small faint" title=${`drop the ${kOrdinals[nthDropped()]}next ${isRequest ? 'request' : 'reply'} like this`} disabled=${isLocked()}
      does=${() => dropNext(frame)}>drop ${kOrdinals[nthDropped()]}next<//>`}</td></tr>`;
}

function ByHand() {
  const lines = store.bench?.lines ?? [];
  const [line, setLine] = useKept('line to send on', '');
  const chosen = lines.find((it) => it.name === line) ?? lines[0];
  if (!chosen) return null;
  const send = async (text) => (await ask(chosen.text
    ? { do: 'send', line: chosen.name, text }
    : { do: 'send', line: chosen.name, bytes: text, checksum: true })).ok;
  const stations = chosen.stations.map((it) => `${it.device}${it.address !== undefined ? ` ${it.address}` : ''}`);
  const some = stations.length > 6 ? [...stations.slice(0, 6), `${stations.length - 6} more`] : stations;
  return html`<div class="bar"><span>Send by hand:</span>
    <${Choice} label="line" value=${chosen.name} options=${lines.map((it) => it.name)} takes=${setLine} />
    <${Field} label=${chosen.text ? 'a line of text' : 'bytes of a request, without its checksum'} size="28"
      placeholder=${chosen.text ? 'text' : '01 03 00 00 00 01'} disabled=${isLocked()} takes=${send} />
    <small>only while no host has the line open; stations: ${some.join(', ')}</small></div>`;
}

/// Drops that wait for a request, with their results.
function Drops() {
  const drops = (store.status?.faults ?? []).filter(({ fault }) => fault.startsWith('drop '));
  if (drops.length === 0) return null;
  return html`<div class="bar">${drops.map(({ number, fault, hits }) => html`<span class="bad bar" key=${number}>${fault}${hits ? `: ${hits} dropped` : ''}
    <${Button} kind="small" title=${`clear fault ${number}`} disabled=${isLocked()} does=${() => ask({ do: 'clear', number })}>clear<//></span>`)}</div>`;
}

/// An mbpoll command that reads a station's first register, for a line of Modbus.
function exampleFor(line, status) {
  const station = line.stations.find((it) => it.address !== undefined);
  const [, baud, , parity, stop] = /^(\d+) (\d)([A-Z])(\d)/.exec(status.settings) ?? [];
  if (line.text || !station || !baud || !status.link || status.link.includes(':')) return '';
  const word = { E: 'even', O: 'odd' }[parity] ?? 'none';
  return `mbpoll -m rtu -a ${station.address} -b ${baud} -P ${word} -s ${stop} -0 -r 0 -c 1 -1 ${status.link}`;
}

/// Where a host connects, and whether one has; open until there is traffic.
function Connections({ isFirst }) {
  const lines = store.status?.lines ?? [];
  if (lines.length === 0) return null;
  return html`<details class="connections" open=${isFirst}><summary>where to connect</summary><ul>${lines.map((status) => {
    const line = lineNamed(status.name);
    const example = line ? exampleFor(line, status) : '';
    return html`<li key=${status.name}><b>${status.name}</b> <code>${status.link || status.pty}</code>${(status.tcp ?? []).map((place) => html`, <code>${place}</code>`)}, ${status.settings};
      ${' '}${status.host === 'open' ? `a host has it open${status.host_settings ? ` (${status.host_settings})` : ''}` : 'no host has it open'}
      ${example && html`<br /><code class="example">${example}</code>`}</li>`;
  })}</ul></details>`;
}

/// A histogram of durations: a bar for each pair of bounds.
function Bars({ title, counts, least, greatest }) {
  const most = Math.max(1, ...counts);
  const sum = counts.reduce((all, one) => all + one, 0);
  if (sum === 0) return null;
  const ms = (ns) => `${(ns / 1e6).toFixed(2)} ms`;
  const label = (i) => (i < kBounds_ms.length ? `below ${kBounds_ms[i]} ms` : `${kBounds_ms.at(-1)} ms and more`);
  return html`<figure class="bars"><figcaption>${title}: ${ms(least)} to ${ms(greatest)}</figcaption>
    <div role="img" aria-label=${`${title}: ${counts.map((count, i) => count > 0 && `${count} ${label(i)}`).filter(Boolean).join(', ')}`}>${counts.map((count, i) =>
      html`<i key=${i} title=${`${grouped(count)} ${label(i)}`} style=${{ height: `${count === 0 ? 0 : 6 + 94 * count / most}%` }}></i>`)}</div>
    <small>${counts.map((_, i) => html`<span key=${i}>${i < kBounds_ms.length ? kBounds_ms[i] : ''}</span>`)}</small></figure>`;
}

/// The counters of each line, and how long answers and the host's pauses take.
function Traffic() {
  if (store.heard.lines.size === 0) return null;
  return html`<details class="traffic"><summary>counters and durations</summary>${[...store.heard.lines].map(([name, line]) => html`<section key=${name}>
    <p><b>${name}</b> ${grouped(line.requests)} requests, ${grouped(line.replies)} replies, ${grouped(line.exceptions)} with an exception, ${grouped(line.dropped)} dropped or with a remark</p>
    <${Bars} title="latency" counts=${line.latency} least=${line.least.latency} greatest=${line.greatest.latency} />
    <${Bars} title="from a reply to the next request" counts=${line.gaps} least=${line.least.gaps} greatest=${line.greatest.gaps} /></section>`)}
    <small>since the page was opened, and in the traffic that the daemon still had then</small></details>`;
}

export function Bus() {
  const [filter, setFilter] = useKept('filter of frames', '');
  const [what, setWhat] = useKept('which frames', 'all');
  const [held, hold] = useKept('held frames', null, false);
  const frames = held ?? store.frames;
  const fits = (frame) => (filter === '' || `${frame.line} ${frame.text} ${frame.remark ?? ''}`.toLowerCase().includes(filter.toLowerCase())) &&
    (what === 'all' || (what === 'exceptions' ? frame.exception || frame.ignored : what === 'dropped' ? frame.remark : frame.way === what));
  const shown = withHoles(frames, fits);
  const count = shown.filter((it) => !it.key).length;
  return html`<div class="bar">
      <input type="search" aria-label="find in frames" placeholder="find" value=${filter} onInput=${(event) => setFilter(event.target.value)} />
      <${Choice} label="which frames" value=${what} takes=${setWhat} options=${[['all', 'all frames'], ['in', 'requests'], ['out', 'replies'],
        ['exceptions', 'exceptions or without effect'], ['dropped', 'dropped or with a remark']]} />
      <${Button} title="pause the list" pressed=${held !== null} does=${() => hold(held ? null : [...store.frames])}>pause<//>
      <${Button} title="save these frames as a capture" does=${() => save('bus.pcapng', [pcapng(shown, store.bench?.lines ?? [])],
        'application/x-pcapng')}>pcapng<//>
      ${!isLocked() && html`<${Choice} label="which of the next frames a row's button drops" value=${String(nthDropped())}
        options=${kOrdinals.map((word, n) => [String(n), `drop the ${word || 'very '}next`]).slice(1)} takes=${(n) => keep(kNth, Number(n))} />`}
      <small class="figure count">${grouped(count)} of ${grouped(frames.length)}${store.framesLost ? `, ${grouped(store.framesLost)} not shown` : ''}</small>
    </div>
    ${!store.timeline && html`<${ByHand} />`}<${Drops} />
    ${frames.length === 0 && html`<p>No traffic on the lines yet.</p>`}
    ${!store.timeline && html`<${Connections} isFirst=${frames.length === 0} />`}
    <${Traffic} />
    ${frames.length > 0 && html`<div class="scroll"><table class="frames"><thead><tr><th>time</th><th>line</th><th></th><th>what</th><th>latency</th><th></th></tr></thead>
      <tbody>${shown.slice(-kShown).reverse().map((frame) => (frame.key
        ? html`<${Missed} key=${frame.key} count=${frame.missed} what="frames" columns="6" />` : html`<${Frame} key=${frame.number} frame=${frame} />`))}</tbody></table></div>`}
    ${shown.length > kShown && html`<small>only the last ${kShown} are shown; pcapng has all</small>`}`;
}
