// Active faults, power, snapshots, and recent events.
import { html, useEffect, useState } from './preact.js';
import { ask, askQuietly, isLocked, store } from './store.js';
import { Button, Field, seconds } from './small.js';
import { EventList } from './events.js';
import { FaultForm } from './fault_form.js';

/// Returns true for a fault that has no hits left.
function isSpent({ fault, hits }) {
  const times = / times=(\d+)/.exec(fault)?.[1] ?? (/ nth=\d+/.test(fault) ? 1 : undefined);
  return times !== undefined && hits >= Number(times);
}

function InForce() {
  const faults = store.status?.faults ?? [];
  if (faults.length === 0) return html`<p>No fault is in force or pending.</p>`;
  return html`<div class="scroll"><table><thead><tr><th>no.</th><th>fault</th><th>seen</th><th>matched</th><th>hits</th><th></th></tr></thead>
    <tbody>${faults.map((it) => html`<tr key=${it.number}><td>${it.number}</td><td>${it.fault}${it.in_force ?? it.seen === undefined ? html` <b class="bad">in force</b>` : isSpent(it) ? html` <small>done</small>` : ''}</td>
      <td>${it.seen ?? ''}</td><td>${it.matched ?? ''}</td><td>${it.hits ?? ''}</td>
      <td><${Button} kind="small" title=${`clear fault ${it.number}`} disabled=${isLocked()}
        does=${() => ask({ do: 'clear', number: it.number })}>clear<//></td></tr>`)}</tbody></table></div>
    ${faults.length > 1 && html`<${Button} title="clear all faults" disabled=${isLocked()} does=${() => ask({ do: 'clear' })}>clear all<//>`}`;
}

function Power() {
  return html`<div class="bar">${(store.status?.devices ?? []).map((device) => html`<span class="joined named" role="group" key=${device.name}
      aria-label=${`power of ${device.name}`}><b>${device.name}</b>
    ${['on', 'off', 'cycle'].map((to) => html`<${Button} kind="small" key=${to} title=${`power of ${device.name}: ${to}`}
      pressed=${to === 'cycle' ? undefined : device.power === to} disabled=${isLocked()} does=${() => ask({ do: 'power', device: device.name, to })}>${to}<//>`)}</span>`)}</div>`;
}

function Snapshots() {
  const [kept, setKept] = useState([]);
  const look = async () => setKept((await askQuietly({ do: 'snapshots' })).snapshots ?? []);
  useEffect(() => { look(); }, [store.bench]);
  const after = async (message) => { const { ok } = await ask(message); look(); return ok; };
  return html`<div class="bar"><${Field} label="save a snapshot under this name" placeholder="save as ..." disabled=${isLocked()}
      takes=${(name) => after({ do: 'snapshot', name })} />
    ${kept.map((it) => html`<span class="joined named" key=${it.name}><b>${it.name}</b> <small>${seconds(it.time_ns)}</small>
      <${Button} kind="small" title=${`restore ${it.name}`} disabled=${isLocked()} does=${() => after({ do: 'restore', name: it.name })}>restore<//>
      <${Button} kind="small" title=${`delete ${it.name}`} disabled=${isLocked()} does=${() => after({ do: 'snapshots', drop: it.name })}>×<//></span>`)}
    ${kept.length === 0 && html`<small>A snapshot saves the current state; restore returns to it.</small>`}</div>`;
}

export function Faults() {
  return html`<h2>Faults</h2><${InForce} />
    ${!isLocked() && html`<${FaultForm} />`}
    <h2>Power</h2><${Power} />
    <h2>Snapshots</h2><${Snapshots} />
    <h2>What has happened</h2>
    <${EventList} most="100" />`;
}
