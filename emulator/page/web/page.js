// The page: a header with the time, tabs, and the visible panel.
import { html, render, useEffect } from './preact.js';
import { ask, askQuietly, complain, draw, drawBy, hasPower, isAltered, isReadOnly, show, store } from './store.js';
import { Button, Choice, Field, exactly, seconds } from './small.js';
import { Axes } from './axes.js';
import { Story, WhatIf } from './story.js';
import { copyMoment, goThere, noteMoment } from './link.js';
import { isTold } from './told.js';
import { Travel } from './travel.js';
import { keepPaths } from './plane.js';
import { keep, kept, useKept } from './kept.js';

/// The library that draws curves is large.
function withDrawing(panel) {
  if ('uPlot' in globalThis) return panel;
  const look = Object.assign(document.createElement('link'), { rel: 'stylesheet', href: 'uplot.css' });
  const script = Object.assign(document.createElement('script'), { src: 'uplot.js' });
  const isThere = new Promise((done, failed) => { script.onload = done; script.onerror = failed; });
  document.head.append(look, script);
  return isThere.then(() => panel);
}

// Panels that are not needed for the first view are loaded after it.
/** @type {Record<string, () => Promise<any>>} */
const kLater = {
  Axes: async () => ({ Axes }), Signals: () => import('./signals.js'), Plot: () => withDrawing(import('./plot.js')), Timeline: () => import('./timeline.js'),
  Registers: () => import('./registers.js'), Bus: () => import('./bus.js'), Program: () => import('./program.js'),
  Events: () => import('./events.js'), Faults: () => import('./faults.js'),
};
// A recording in one file has no registers or program texts, and cannot be changed.
const kPanels = Object.keys(kLater).filter((name) => !isTold || !['Registers', 'Program', 'Faults'].includes(name));
/** @type {Record<string, any>} */
const panels = { Axes };
/** @type {Record<string, Promise<void>>} */
const loading = {};
/// If a panel cannot be loaded, the next drawing tries again.
function load(name) {
  loading[name] ??= kLater[name]().then((it) => { panels[name] = it[name]; draw(); }, () => { delete loading[name]; });
}
const kSpeeds = ['0.1', '0.2', '0.5', 'real', '2', '5', '10', 'free', 'manual'];
const kMaxNamed = 3;  // devices in the header

// The snapshot from before the last "run until", which may skip a lot of time.
const kBefore = 'before run until';
async function undoRun() {
  if ((await ask({ do: 'restore', name: kBefore })).ok) keep(kBefore, undefined);
}

/// Stops time first if it runs, because run-until requires it.
async function runUntil(condition) {
  const { look } = store;
  if (!(await ask({ do: 'eval', expression: condition })).ok) return false;
  if (!look.paused && look.speed !== 'manual' && !(await ask({ do: 'pause' })).ok) return false;
  const from = store.timeline ? null : store.look.time_ns;
  if (from !== null && (await askQuietly({ do: 'snapshot', name: kBefore })).ok) keep(kBefore, from);
  const reply = await ask({ do: 'run-until', condition, within: '60s' });
  if (reply.ok && !reply.reached && reply.simulated_time_ns - look.time_ns >= 60e9) complain(`this did not become true within 60 s: ${condition}`);
  return reply.ok;
}

function Time() {
  const { look } = store;
  const [isOpen, open] = useKept('more about time', false);
  if (!look) return null;
  const stands = look.paused || look.speed === 'manual';
  const isExact = stands && !look.advancing && look.time_ns % 1e6 !== 0;
  const clock = html`<output class="clock figure" aria-live="off" aria-label="simulated time">${(isExact ? exactly : seconds)(look.time_ns)}</output>`;
  if (store.timeline && !isAltered()) return html`<div class="time" role="group" aria-label="time">${clock}<${WhatIf} /></div>`;
  const undo = kept(kBefore);
  const isRunning = !stands || look.advancing;  // `pause` ends both
  const locked = isReadOnly();
  const speeds = kSpeeds.includes(look.speed) ? kSpeeds : [look.speed, ...kSpeeds];
  const step = (ticks, name) => html`<${Button} kind="small" title=${`advance by ${name}`} disabled=${locked || isRunning}
    does=${() => ask({ do: 'step', ticks })}>+${name}<//>`;
  return html`<div class=${isOpen ? 'time open' : 'time'} role="group" aria-label="time">
    ${clock}${store.timeline && html`<${WhatIf} />`}
    <${Button} kind="pause" title=${isRunning ? 'stop time' : 'resume time'} pressed=${look.paused} disabled=${locked}
      does=${() => ask({ do: isRunning ? 'pause' : 'resume' })}>${isRunning ? '❚❚ pause' : '▶ resume'}<//>
    <${Button} kind="small more" title="more about time" pressed=${isOpen} does=${() => open(!isOpen)}>⋯<//>
    <span class="joined">${step(1, '1 ms')}${step(10, '10 ms')}${step(1000, '1 s')}</span>
    <${Choice} label="speed of time" value=${look.speed} options=${speeds.map((to) => [to, /\d/.test(to) ? `× ${to}` : to])}
      disabled=${locked} takes=${(to) => ask({ do: 'speed', to })} />
    ${look.advancing ? html`<span class="badge">running</span>` : html`<${Field} label="run until a condition is true, at most 60 s; then time pauses"
      placeholder="run until ..." size="16" disabled=${locked} takes=${runUntil} />`}
    ${undo !== undefined && html`<${Button} kind="small" title=${`back to ${seconds(undo)}, before the last run until`} disabled=${locked} does=${undoRun}>↶ ${seconds(undo)}<//>`}
  </div>`;
}

function Said() {
  const isStranger = store.link.includes('token');
  const bench = { gone: 'The daemon has stopped; the page waits for it to return.', silent: 'The daemon does not answer.' }[store.states[store.number]];
  const lost = (isStranger ? 'This address is incomplete, or from an earlier run: open the whole address that was printed, including the part after #.' : store.link) || bench;
  const text = lost || (store.said && performance.now() - store.said.at < 6000 ? store.said.text : '');
  return html`<div class=${`said ${lost ? 'lost' : ''} ${text ? '' : 'nothing'}`} role="status" aria-live="polite">${text}</div>`;
}

function Devices() {
  const devices = store.bench?.devices ?? [];
  const dark = devices.slice(kMaxNamed).map((device) => device.name).filter((name) => !hasPower(name));
  return html`<span class="models">${devices.slice(0, kMaxNamed).map((device) => html`<span class="model" key=${device.name}
      title=${`${device.title}, firmware ${device.firmware}`}><b>${device.name}</b> <small>${device.model} ${device.firmware}</small>${!hasPower(device.name) && html` <span class="badge">no power</span>`}</span>`)}
    ${devices.length > kMaxNamed && html`<small>and ${devices.length - kMaxNamed} more</small>`}
    ${dark.length > 0 && html`<span class="badge">no power: ${dark.join(', ')}</span>`}</span>`;
}

/// Returns the name of its file; if two benches have the same name, the socket is added.
function nameOf({ socket }, number) {
  const name = store.labels[number] ?? socket.split('/').at(-1);
  const others = store.hello.benches.filter((it, i) => i !== number && (store.labels[i] ?? it.socket.split('/').at(-1)) === name);
  return others.length > 0 ? `${name} (${socket})` : name;
}

/// The visible panel; a recording opens with its timeline.
function panelShown() {
  const wanted = kept('panel', store.timeline ? 'Timeline' : 'Axes', '');
  return kPanels.includes(wanted) ? wanted : 'Axes';
}

const kWide = 1150;    // the width in dots from which two panels fit side by side,
const kWidest = 1750;  // and three

/// The panels beside the one in view, as far as there is room.
function besideShown(panel) {
  const room = innerWidth >= kWidest ? 2 : innerWidth >= kWide ? 1 : 0;
  return kept('panels beside', [], '').filter((name) => name !== panel && kPanels.includes(name)).slice(0, room);
}

/// Chooses a panel to see beside the others.
function Beside({ panel, beside }) {
  if (innerWidth < kWide) return null;
  const choose = (i, name) => keep('panels beside', [...beside.slice(0, i), name, ...beside.slice(i + 1)].filter(Boolean), { of: '' });
  const places = innerWidth >= kWidest && beside.length > 0 ? [0, 1] : [0];
  return html`<span class="beside">${places.map((i) => html`<${Choice} key=${i} label=${i === 0 ? 'a panel beside this one' : 'a third panel'} value=${beside[i] ?? ''}
    options=${[['', i === 0 ? 'side by side ...' : 'a third ...'], ...kPanels.filter((name) => name !== panel && (name === beside[i] || !beside.includes(name)))]}
    takes=${(name) => choose(i, name)} />`)}</span>`;
}

const Loading = () => html`<p>Loading...</p>`;

function Page() {
  const panel = panelShown();
  const setPanel = (name) => keep('panel', name, { of: '' });
  const benches = store.hello?.benches ?? [];
  const beside = besideShown(panel);
  const panelOf = (name) => panels[name] ?? Loading;
  if (store.bench) kPanels.forEach(load);
  const move = (event) => {
    const at = kPanels.indexOf(panel);
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: kPanels.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    const next = kPanels[(to + kPanels.length) % kPanels.length];
    setPanel(next);
    document.getElementById(`tab_${next}`)?.focus();
  };
  useEffect(() => { document.getElementById(`tab_${panel}`)?.scrollIntoView({ block: 'nearest', inline: 'center' }); }, [panel]);
  const isLost = store.link !== '' || ['gone', 'silent'].includes(store.states[store.number]);
  return html`<div class="top"><header class="head">
      <h1>Understudy</h1>
      ${benches.length > 1 && html`<${Choice} label="bench" value=${String(store.number)}
        options=${benches.map((bench, i) => [String(i), nameOf(bench, i)])} takes=${(i) => { keep('bench', Number(i), { of: '' }); show(Number(i)); }} />`}
      <${Devices} />
      ${isReadOnly() && html`<span class="badge">read only</span>`}
      <${Time} />
      <${Button} kind="small" title="copy a link to this moment (key: c)" does=${copyMoment}>link<//>
    </header>
    <${Travel} />
    <div class="tabs"><nav role="tablist" aria-label="panels" onKeyDown=${move}>${kPanels.map((name) => html`<button type="button" role="tab"
      key=${name} id=${`tab_${name}`} aria-selected=${name === panel} aria-controls="panel" tabindex=${name === panel ? 0 : -1}
      onClick=${() => setPanel(name)}>${name}</button>`)}</nav><${Beside} panel=${panel} beside=${beside} /></div></div>
    <${Said} /><${Story} />
    <div class=${`panels n${1 + beside.length} ${isLost ? 'stale' : ''}`}><div id="panel" role="tabpanel" aria-labelledby=${`tab_${panel}`}>
      ${store.bench ? html`<${panelOf(panel)} key=${`${store.number}/${panel}`} />` : html`<p>${store.link.includes('too many') ? 'Too many browsers have this page open: close one of them, and this one will load.' : 'Looking for the bench...'}</p>`}</div>
      ${store.bench && beside.map((name) => html`<section key=${`${store.number}/${name}`} aria-label=${name}><h2>${name}</h2><${panelOf(name)} /></section>`)}</div>`;
}

store.number = kept('bench', 0, '');
document.getElementById('page').textContent = '';
drawBy(() => {
  const file = store.bench?.path?.split('/').at(-1);
  document.title = file ? `${file} - Understudy` : 'Understudy';
  goThere();
  keepPaths();
  render(html`<${Page} />`, document.getElementById('page'));
  noteMoment(panelShown());
});
addEventListener('keydown', (event) => {
  const at = /** @type {Element} */ (event.target);
  const isTyped = at.closest?.('input, textarea, select') || event.ctrlKey || event.metaKey || event.altKey;
  if (event.key === 'c' && !isTyped) copyMoment();
});
draw();
setInterval(draw, 1000);  // flashes end even if no message arrives
