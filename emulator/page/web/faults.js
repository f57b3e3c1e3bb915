// Faults in force, power, snapshots, and what has happened.
import { html, useEffect, useState } from './preact.js';
import { ask, askQuietly, isReadOnly, store } from './store.js';
import { Button, Field, seconds } from './small.js';
import { FaultForm } from './fault_form.js';

function InForce() {
  const faults = store.status?.faults ?? [];
  if (faults.length === 0) return html`<p>No fault is in force, and none waits.</p>`;
  return html`<div class="scroll"><table><thead><tr><th>fault</th><th></th><th>seen</th><th>matched</th><th>hits</th><th></th></tr></thead>
    <tbody>${faults.map((it) => html`<tr key=${it.number}><td class="figure">${it.number}</td><td>${it.fault}</td>
      <td class="figure">${it.seen ?? ''}</td><td class="figure">${it.matched ?? ''}</td><td class="figure">${it.hits ?? ''}</td>
      <td><${Button} kind="small" title=${`clear fault ${it.number}`} disabled=${isReadOnly()}
        does=${() => ask({ do: 'clear', number: it.number })}>clear<//></td></tr>`)}</tbody></table></div>`;
}

function Power() {
  return html`<div class="bar">${(store.status?.devices ?? []).map((device) => html`<span key=${device.name}>${device.name}: ${device.power}
    ${['on', 'off', 'cycle'].map((to) => html`<${Button} kind="small" key=${to} title=${`power of ${device.name}: ${to}`}
      pressed=${device.power === to} disabled=${isReadOnly()} does=${() => ask({ do: 'power', device: device.name, to })}>${to}<//>`)}</span>`)}</div>`;
}

function Snapshots() {
  const [kept, setKept] = useState([]);
  const look = async () => setKept((await askQuietly({ do: 'snapshots' })).snapshots ?? []);
  useEffect(() => { look(); }, [store.bench]);
  const after = async (message) => { const { ok } = await ask(message); look(); return ok; };
  return html`<div class="bar"><${Field} label="name of a snapshot" placeholder="keep as" disabled=${isReadOnly()}
      takes=${(name) => after({ do: 'snapshot', name })} />
    ${kept.map((it) => html`<span key=${it.name}>${it.name} <small>${seconds(it.time_ns)}</small>
      <${Button} kind="small" title=${`go back to ${it.name}`} disabled=${isReadOnly()} does=${() => after({ do: 'restore', name: it.name })}>restore<//>
      <${Button} kind="small" title=${`forget ${it.name}`} disabled=${isReadOnly()} does=${() => after({ do: 'snapshots', drop: it.name })}>×<//></span>`)}</div>`;
}

export function Faults() {
  return html`<h2>Faults</h2><${InForce} />
    ${!isReadOnly() && html`<${FaultForm} />`}
    <h2>Power</h2><${Power} />
    <h2>Snapshots</h2><${Snapshots} />
    <h2>What has happened</h2>
    <div class="scroll"><table><tbody>${store.events.slice(-100).reverse().map((event) => html`<tr key=${event.number}
      class=${event.what === 'exception' || event.what === 'dropped' ? 'bad' : ''}>
      <td class="figure">${seconds(event.time_ns)}</td><td>${event.what}</td><td>${event.by ?? ''}</td>
      <td>${[event.line, event.device, event.name].filter(Boolean).join(' ')}${event.value !== undefined ? ` = ${event.value}` : ''}
        ${event.text ?? ''}</td></tr>`)}</tbody></table></div>`;
}
