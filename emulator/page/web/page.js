// The page: a head with time, tabs, and the panel in view.
import { html, render, useState } from './preact.js';
import { ask, draw, drawBy, isReadOnly, show, store } from './store.js';
import { Button, Choice, Field, seconds } from './small.js';
import { Axes } from './axes.js';
import { Signals } from './signals.js';
import { Plot } from './plot.js';
import { Registers } from './registers.js';
import { Bus } from './bus.js';
import { Program } from './program.js';
import { Faults } from './faults.js';
import { Travel } from './travel.js';

const kPanels = [['Axes', Axes], ['Signals', Signals], ['Plot', Plot], ['Registers', Registers], ['Bus', Bus],
                 ['Program', Program], ['Faults', Faults]];
const kSpeeds = ['0.1', '0.2', '0.5', 'real', '2', '5', '10', 'free', 'manual'];

function Time() {
  const { look } = store;
  if (!look) return null;
  if (store.timeline) {
    return html`<div class="time" role="group" aria-label="time">
      <output class="clock figure" aria-label="simulated time">${seconds(look.time_ns)}</output>
      <span class="badge">recording</span></div>`;
  }
  const stands = look.paused || look.speed === 'manual';
  const locked = isReadOnly();
  const speeds = kSpeeds.includes(look.speed) ? kSpeeds : [look.speed, ...kSpeeds];
  const step = (ticks, name) => html`<${Button} kind="small" title=${`on by ${name}`} disabled=${locked || !stands}
    does=${() => ask({ do: 'step', ticks })}>+${name}<//>`;
  return html`<div class="time" role="group" aria-label="time">
    <output class="clock figure" aria-label="simulated time">${seconds(look.time_ns)}</output>
    <${Button} title=${look.paused ? 'let time go on' : 'stop time'} pressed=${look.paused} disabled=${locked}
      does=${() => ask({ do: look.paused ? 'resume' : 'pause' })}>${look.paused ? '▶' : '❚❚'}<//>
    ${step(1, '1 ms')}${step(10, '10 ms')}${step(1000, '1 s')}
    <${Choice} label="speed of time" value=${look.speed} options=${speeds.map((to) => [to, /\d/.test(to) ? `× ${to}` : to])}
      disabled=${locked} takes=${(to) => ask({ do: 'speed', to })} />
    <${Field} label="run until a condition is true, while time stands" placeholder="run until" size="18"
      disabled=${locked || !stands} takes=${async (condition) => {
        const reply = await ask({ do: 'run-until', condition, within: '60s' });
        return reply.ok;
      }} />
  </div>`;
}

function Said() {
  const state = store.states[store.number];
  const bench = { gone: 'The daemon is gone; the page waits for it.', silent: 'The daemon does not answer.' }[state];
  const text = store.link || bench || (store.said && performance.now() - store.said.at < 6000 ? store.said.text : '');
  return html`<div class=${text ? 'said' : 'said nothing'} role="status" aria-live="polite">${text}</div>`;
}

function Page() {
  const [panel, setPanel] = useState('Axes');
  const benches = store.hello?.benches ?? [];
  const Shown = kPanels.find(([name]) => name === panel)[1];
  const move = (event) => {
    const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!way) return;
    const next = kPanels[(kPanels.findIndex(([name]) => name === panel) + way + kPanels.length) % kPanels.length][0];
    setPanel(next);
    document.getElementById(`tab_${next}`)?.focus();
  };
  return html`<header class="head">
      <h1>Understudy</h1>
      ${benches.length > 1 && html`<${Choice} label="bench" value=${String(store.number)}
        options=${benches.map((bench, i) => [String(i), bench.socket.split('/').at(-1)])} takes=${(i) => show(Number(i))} />`}
      ${(store.bench?.devices ?? []).map((device) => html`<span class="model" key=${device.name}>${device.name}
        <small>${device.title} ${device.firmware}</small></span>`)}
      ${isReadOnly() && html`<span class="badge">read only</span>`}
      <${Time} />
    </header>
    <${Said} />
    <${Travel} />
    <nav role="tablist" aria-label="panels" onKeyDown=${move}>${kPanels.map(([name]) => html`<button type="button" role="tab"
      key=${name} id=${`tab_${name}`} aria-selected=${name === panel} aria-controls="panel" tabindex=${name === panel ? 0 : -1}
      onClick=${() => setPanel(name)}>${name}</button>`)}</nav>
    <div id="panel" role="tabpanel" aria-labelledby=${`tab_${panel}`}>
      ${store.bench ? html`<${Shown} key=${`${store.number}/${panel}`} />` : html`<p>Looking for the bench...</p>`}</div>`;
}

document.getElementById('page').textContent = '';
drawBy(() => render(html`<${Page} />`, document.getElementById('page')));
draw();
setInterval(draw, 1000);  // flashes end though nothing comes
