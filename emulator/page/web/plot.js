// A plot of any names over time, and an oscilloscope with every tick around a moment.
import { html, useEffect, useRef, useState } from './preact.js';
import { ask, askQuietly, isReadOnly, onLook, store, unwant, valueOf, want } from './store.js';
import { Button, Choice, Field, save } from './small.js';

const kMost_s = 60;
const kColours = ['#2f7de1', '#d9480f', '#2b8a3e', '#9c36b5', '#c2255c', '#0b7285', '#e8a200', '#5f3dc4'];

// Kept while other panels are in view.
const names = [];
const times = [];
const rows = new Map();  // by name: values beside `times`

onLook((look) => {
  if (names.length === 0) return;
  const now = look.time_ns / 1e9;
  if (times.length > 0 && now < times.at(-1)) forget();  // restored, or another bench
  if (times.at(-1) === now) return;
  times.push(now);
  for (const name of names) rows.get(name).push(numberOf(valueOf(name)));
  let old = 0;
  while (times[old] < now - kMost_s) ++old;
  if (old > 500) {
    times.splice(0, old);
    for (const row of rows.values()) row.splice(0, old);
  }
});

const numberOf = (value) => (typeof value === 'number' ? value : value === true ? 1 : value === false ? 0 : null);
function forget() {
  times.length = 0;
  for (const row of rows.values()) row.length = 0;
}
function add(name) {
  if (names.includes(name) || names.length >= kColours.length) return;
  names.push(name);
  rows.set(name, new Array(times.length).fill(null));
  want('plot', [...names]);
}
function drop(name) {
  names.splice(names.indexOf(name), 1);
  rows.delete(name);
  names.length > 0 ? want('plot', [...names]) : unwant('plot');
}

/// Names to offer: of axes, terminals and the registers that tell a device's state.
function suggestions() {
  return Object.values(store.devices).flatMap((device) => [
    ...device.axes.flatMap((axis) => ['position', 'speed', 'pulses', 'home'].map((it) => `${device.name}.${axis.name}.${it}`)),
    ...device.state_registers.map((name) => `${device.name}.${name}`),
    ...device.terminals.map((terminal) => `${device.name}.${terminal.name}`),
  ]);
}

/// A drawing by uPlot of columns that change; it owns the window once somebody has zoomed.
function Drawing({ columns, labels, window_s, frozen, mark }) {
  const place = useRef(null);
  const plot = useRef(null);
  const zoomed = useRef(false);
  const key = labels.join('\n');
  useEffect(() => {
    const width = () => Math.max(place.current.clientWidth, 200);
    const ink = getComputedStyle(place.current).getPropertyValue('--ink');
    const line = getComputedStyle(place.current).getPropertyValue('--line');
    const axis = { stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 } };
    plot.current = new uPlot({
      width: width(), height: 340, scales: { x: { time: false } },
      axes: [{ ...axis, label: 'simulated time, s' }, axis],
      series: [{ label: 's', value: (_, at) => (at === null ? '–' : at.toFixed(3)) },
               ...labels.map((label, i) => ({ label, stroke: kColours[i], width: 1.5, spanGaps: false }))],
      hooks: { setSelect: [() => { zoomed.current = true; }] },
    }, columns, place.current);
    place.current.ondblclick = () => { zoomed.current = false; };
    const resized = () => plot.current.setSize({ width: width(), height: 340 });
    addEventListener('resize', resized);
    return () => { removeEventListener('resize', resized); plot.current.destroy(); };
  }, [key, mark]);
  useEffect(() => {
    if (frozen) return;
    const last = columns[0].at(-1) ?? 0;
    plot.current.setData(columns, false);
    if (zoomed.current) return plot.current.redraw();
    const from = window_s ? last - window_s : columns[0][0] ?? 0;
    plot.current.setScale('x', { min: from, max: Math.max(last, from + 1e-3) });
  });
  return html`<div class="drawing" ref=${place}></div>`;
}

function asCsv(labels, columns) {
  const lines = columns[0].map((time, i) => [time.toFixed(6), ...columns.slice(1).map((row) => row[i] ?? '')].join(','));
  return [['time_s', ...labels].join(','), ...lines, ''].join('\n');
}

function savePicture() {
  document.querySelector('.drawing canvas')?.toBlob((picture) => save('plot.png', [picture], 'image/png'));
}

function Scope({ shown, show }) {
  const [condition, setCondition] = useState('');
  const [state, setState] = useState('');
  const arm = async () => {
    const wish = { do: 'scope', names: [...names], before: '1s', after: '1s' };
    if (condition.trim() !== '') wish.condition = condition.trim();
    if (!(await ask(wish)).ok) return;
    setState('armed');
    const poll = async () => {
      const { scope } = await askQuietly({ do: 'scope' });
      if (!scope) return setState('');
      setState(scope.error ?? scope.state);
      if (scope.state !== 'done') return void setTimeout(poll, 200);
      const columns = [[], ...scope.names.map(() => [])];
      for (let from = 0; from !== undefined && from < scope.count;) {
        const reply = await askQuietly({ do: 'scope', from });
        const samples = scope.names.map((name, i) => (Array.isArray(reply.samples) ? reply.samples[i] : reply.samples[name]));
        samples[0].forEach((_, i) => columns[0].push((scope.from_ns + (from + i) * scope.step_ns - scope.trigger_ns) / 1e9));
        samples.forEach((row, i) => columns[i + 1].push(...row.map(numberOf)));
        from = reply.next;
      }
      show({ labels: scope.names, columns, at: scope.trigger_ns });
    };
    setTimeout(poll, 200);
  };
  return html`<div class="bar"><span>Every tick around a moment:</span>
    <input aria-label="condition of the trigger" placeholder="condition, such as device.A.home == 1" size="34"
      value=${condition} onInput=${(event) => setCondition(event.target.value)} spellcheck="false" />
    <${Button} title="arm the trigger" does=${arm} disabled=${names.length === 0 || isReadOnly()}>arm<//>
    <output>${state}</output>
    ${shown && html`<${Button} title="back to the running plot" does=${() => show(null)}>back<//>`}</div>`;
}

export function Plot() {
  const [window_s, setWindow] = useState(10);
  const [frozen, freeze] = useState(false);
  const [shot, show] = useState(null);
  if (names.length === 0 && store.bench) {
    const first = suggestions()[0];
    if (first) add(first);
  }
  const labels = shot?.labels ?? names;
  const columns = shot?.columns ?? [times, ...names.map((name) => rows.get(name))];
  return html`<div class="bar">
      <${Field} label="a name to plot" list="names" size="28" takes=${(name) => { add(name); show(null); }} />
      <datalist id="names">${suggestions().slice(0, 600).map((name) => html`<option value=${name}></option>`)}</datalist>
      <${Choice} label="seconds shown" value=${String(window_s)} options=${['1', '2', '5', '10', '30', '60'].map((s) => [s, `${s} s`])}
        takes=${(s) => setWindow(Number(s))} />
      <${Button} title="freeze the plot" pressed=${frozen} does=${() => freeze(!frozen)}>freeze<//>
      <${Button} title="save as CSV" does=${() => save('plot.csv', [asCsv(labels, columns)], 'text/csv')}>CSV<//>
      <${Button} title="save as a picture" does=${savePicture}>picture<//>
      <small>Drag to zoom, double click to go back.</small>
    </div>
    <div class="bar">${names.map((name) => html`<${Button} kind="small" key=${name} title=${`take ${name} away`}
      does=${() => drop(name)}>${name} ×<//>`)}</div>
    ${labels.length > 0 && html`<${Drawing} columns=${columns} labels=${labels} window_s=${shot ? 0 : window_s}
      frozen=${frozen && !shot} mark=${shot?.at} />`}
    <${Scope} shown=${shot} show=${show} />`;
}
