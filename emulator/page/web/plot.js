// Plots any names over time, and shows an oscilloscope with every tick around a trigger.
import { html, useEffect, useRef, useState } from './preact.js';
import { ask, askQuietly, complain, isLocked, onLook, store, unwant, valueOf, want } from './store.js';
import { Button, Choice, Field, grouped, nameOfBench, save } from './small.js';
import { keep, kept, useKept } from './kept.js';
import { useRecordedPlot } from './recorded_plot.js';

const kMax_s = 60;
const kMaxNames = 8;
const kHeight = 340;

// These values are kept while other panels are visible.
const names = [];
const times = [];
const rows = new Map();  // by name: values at `times`
let of = null;           // the bench that they belong to

onLook((look) => {
  if (names.length === 0) return;
  const now = look.time_ns / 1e9;
  if (times.length > 0 && now < times.at(-1)) forget();  // after a restore, or from another daemon
  if (times.at(-1) === now) return;
  times.push(now);
  for (const name of names) rows.get(name).push(numberOf(valueOf(name)));
  let old = 0;
  while (times[old] < now - kMax_s) ++old;
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
  if (names.includes(name)) return;
  names.push(name);
  rows.set(name, new Array(times.length).fill(null));
  want('plot', [...names]);
  keep('plotted', [...names]);
}
function drop(name) {
  names.splice(names.indexOf(name), 1);
  rows.delete(name);
  names.length > 0 ? want('plot', [...names]) : unwant('plot');
  keep('plotted', [...names]);
}
/// The names that were plotted before, or that another panel wants plotted; at first, those of an axis.
function beginWith(bench) {
  const wanted = kept('plotted', suggestions().slice(0, 1));
  if (of === bench && wanted.join() === names.join()) return;
  names.length = 0;
  rows.clear();
  forget();
  of = bench;
  for (const name of wanted) add(name);
}

/// Returns the names to offer: of axes, terminals and the registers that show a device's state.
function suggestions() {
  return Object.values(store.devices).flatMap((device) => [
    ...device.axes.flatMap((axis) => ['position', 'speed', 'pulses', 'target', 'home'].map((it) => `${device.name}.${axis.name}.${it}`)),
    ...device.state_registers.map((name) => `${device.name}.${name}`),
    ...device.terminals.map((terminal) => `${device.name}.${terminal.name}`),
  ]);
}

const dark = matchMedia('(prefers-color-scheme: dark)');
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const kTwoLevels = ['digital_in', 'digital_out', 'dip_switch', 'pulse_out'];
const kContacts = ['home', 'near_home', 'mark', 'lower_limit', 'upper_limit', 'index', 'servo', 'ready', 'alarm'];

/// Returns whether the curve is on or off: the bench's tables say so, or it has had both values and no other.
function isLevel(label, row) {
  const [name, ...rest] = label.split('.');
  const device = store.devices[name];
  const [first, second] = rest;
  if (device?.terminals.some((it) => it.name === first && kTwoLevels.includes(it.kind))) return true;
  if (device?.axes.some((it) => it.name === first) && kContacts.includes(second)) return true;
  const seen = new Set();
  for (const value of row) if (value !== null && seen.add(value).size > 2) return false;
  return seen.size === 2 && seen.has(0) && seen.has(1);
}

/// A lane at the bottom of the plot; the step from off to on is a twentieth of the plot's height.
const lane = (number) => ({ range: () => [-(0.4 + 1.4 * number), 20 - (0.4 + 1.4 * number)] });

/// Draws columns that change. On/off curves have their own lanes; with `isApart`, the others have their own scales.
/// `moment` is the place of a vertical line, in seconds. After the user has zoomed, uPlot owns the window, and `sees`
/// receives the visible seconds.
function Drawing({ columns, labels, window_s, isShot, isApart, moment, sees }) {
  const place = useRef(null);
  const plot = useRef(null);
  const zoomed = useRef(false);
  const present = useRef(null);
  present.current = moment;
  const [scheme, setScheme] = useState(dark.matches);
  const levels = labels.map((label, i) => isLevel(label, columns[i + 1]));
  const scales = labels.map((_, i) => (levels[i] ? `lane${i}` : isApart ? `y${i}` : 'y'));
  const looks = [...scales, isShot, scheme].join('\n');
  useEffect(() => {
    const changed = () => setScheme(dark.matches);
    dark.addEventListener('change', changed);
    return () => dark.removeEventListener('change', changed);
  }, []);
  useEffect(() => {
    const width = () => Math.max(place.current.clientWidth, 200);
    const [ink, line] = [colour('--ink'), colour('--line')];
    const axis = { stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 } };
    const size = (_, shown) => 16 + 8 * Math.max(3, ...(shown ?? []).map((text) => String(text).length));
    const lanes = scales.filter((_, i) => levels[i]);
    const fits = Math.max(1, Math.floor(width() / 350));  // more would leave no space for the curves
    const upright = [...new Set(scales.filter((_, i) => !levels[i]))].slice(0, fits).map((scale, number) => ({ ...axis, scale, size,
      stroke: isApart ? colour(`--c${scale.slice(1)}`) : ink, grid: { ...axis.grid, show: number === 0 } }));
    zoomed.current = false;
    plot.current = new uPlot({
      width: width(), height: kHeight,
      scales: { x: { time: false }, ...Object.fromEntries(lanes.map((scale, number) => [scale, lane(number)])) },
      axes: [{ ...axis, label: isShot ? 's from the trigger' : 'simulated time, s' }, ...upright],
      pxAlign: 0,
      series: [{ label: 's', value: (_, at) => (at === null ? '–' : at.toFixed(3)) },
               ...labels.map((label, i) => ({ label, scale: scales[i], stroke: colour(`--c${i}`), width: 1.5, spanGaps: false,
                 ...(levels[i] ? { paths: uPlot.paths.stepped({ align: 1 }) } : {}), value: (_, at) => (at === null ? '–' : grouped(at)) }))],
      hooks: {
        setSelect: [(self) => {
          if (self.select.width <= 0) return;
          zoomed.current = true;
          sees?.([self.posToVal(self.select.left, 'x'), self.posToVal(self.select.left + self.select.width, 'x')]);
        }],
        draw: [(self) => drawMoment(self, present.current)],
      },
    }, columns, place.current);
    place.current.ondblclick = () => { zoomed.current = false; sees?.(null); };
    const resized = () => plot.current.setSize({ width: width(), height: kHeight });
    addEventListener('resize', resized);
    return () => { removeEventListener('resize', resized); plot.current.destroy(); };
  }, [labels.join('\n'), looks]);
  useEffect(() => {
    plot.current.setData(columns, false);
    if (zoomed.current) return plot.current.redraw();
    const [first, last] = [columns[0][0] ?? 0, columns[0].at(-1) ?? 0];
    const isWhole = isShot || sees !== undefined;
    const from = isWhole ? first : Math.max(0, last - window_s);
    plot.current.setScale('x', { min: from, max: Math.max(last, from + (isWhole ? 1e-3 : window_s)) });
  }, [columns, columns[0].length, columns[0].at(-1), window_s, looks]);
  useEffect(() => { plot.current.redraw(false); }, [moment]);
  return html`<div class="drawing" ref=${place}></div>`;
}

/// Draws a line at a moment.
function drawMoment(self, moment) {
  if (moment === undefined) return;
  const x = Math.round(self.valToPos(moment, 'x', true));
  const { left, top, width, height } = self.bbox;
  if (x < left || x > left + width) return;
  self.ctx.fillStyle = colour('--accent');
  self.ctx.fillRect(x - 1, top, 2, height);
}

function asCsv(labels, columns) {
  const lines = columns[0].map((time, i) => [time.toFixed(6), ...columns.slice(1).map((row) => row[i] ?? '')].join(','));
  return [['time_s', ...labels].join(','), ...lines, ''].join('\n');
}

/// Saves the drawing on its background, with the names of the curves.
function savePicture(labels) {
  /** @type {HTMLCanvasElement | null} */
  const drawn = document.querySelector('.drawing canvas');
  if (!drawn) return;
  const scale = drawn.width / drawn.clientWidth;
  const [picture, row] = [document.createElement('canvas'), 22 * scale];
  picture.width = drawn.width;
  picture.height = drawn.height + row * labels.length + row / 2;
  const context = picture.getContext('2d');
  context.fillStyle = colour('--card');
  context.fillRect(0, 0, picture.width, picture.height);
  context.drawImage(drawn, 0, 0);
  context.font = `${14 * scale}px sans-serif`;
  labels.forEach((label, i) => {
    const y = drawn.height + row * i;
    context.fillStyle = colour(`--c${i}`);
    context.fillRect(row, y + row / 4, row, row / 2);
    context.fillStyle = colour('--ink');
    context.fillText(label, row * 2.5, y + row * 0.72);
  });
  picture.toBlob((bytes) => save('plot.png', [bytes], 'image/png'));
}

/// Returns all samples of a shot as columns: seconds from its trigger, then each name.
async function samplesOf(scope) {
  const columns = [[], ...scope.names.map(() => [])];
  for (let from = 0; from !== undefined && from < scope.count;) {
    const reply = await askQuietly({ do: 'scope', from });
    if (!reply.ok) return null;
    const samples = scope.names.map((name, i) => (Array.isArray(reply.samples) ? reply.samples[i] : reply.samples[name]));
    samples[0].forEach((_, i) => columns[0].push((scope.from_ns + (from + i) * scope.step_ns - scope.trigger_ns) / 1e9));
    samples.forEach((row, i) => columns[i + 1].push(...row.map(numberOf)));
    from = reply.next;
  }
  return columns;
}

// The daemon's state of the scope. It stays armed whichever panel is visible, and whoever armed it.
let isWatched = false;
const sayScope = (state) => keep('state of the scope', state, { isLasting: false });
async function watchScope(isWanted) {
  if (isWatched) return;
  isWatched = true;
  const number = store.number;
  for (let wanted = isWanted; number === store.number;) {
    const { scope } = await askQuietly({ do: 'scope' });
    if (number !== store.number) break;
    sayScope(scope ? scope.error ?? scope.state : '');
    if (!scope || scope.error) break;
    if (scope.state === 'done') {
      if (wanted) await showShot(scope);
      break;
    }
    wanted = true;
    if (kept('condition of the scope', '') === '' && scope.condition) keep('condition of the scope', scope.condition);
    await new Promise((resolve) => { setTimeout(resolve, 200); });
  }
  isWatched = false;
}
async function showShot(scope) {
  const columns = await samplesOf(scope);
  if (columns) keep('shot', { labels: scope.names, columns }, { isLasting: false });
}

function Scope({ shot, show }) {
  const [condition, setCondition] = useKept('condition of the scope', '');
  const [side, setSide] = useKept('side of the scope', '1s');
  const state = kept('state of the scope', '');
  useEffect(() => { watchScope(false); }, [store.bench]);
  const arm = async (when = condition) => {
    const wish = { do: 'scope', names: [...names], before: side, after: side };
    if (when.trim() !== '') wish.condition = when.trim();
    if (!(await ask(wish)).ok) return;
    sayScope('armed');
    watchScope(true);
  };
  const disarm = async () => { await ask({ do: 'scope', off: true }); sayScope(''); };
  const waits = state === 'armed' || state === 'triggered';
  return html`<div class="bar"><span>Every tick around a moment:</span>
    <input aria-label="condition of the trigger" placeholder="when, such as device.A.home == 1; now" size="36"
      disabled=${isLocked()} value=${condition} onInput=${(event) => setCondition(event.target.value)} spellcheck=${false} autocapitalize="off"
      onKeyDown=${(event) => { if (event.key === 'Enter') arm(event.target.value); }} />
    <${Choice} label="time before and after the trigger" value=${side} options=${['100ms', '500ms', '1s', '2s', '5s'].map((it) => [it, `± ${it}`])} takes=${setSide} />
    ${waits ? html`<${Button} title="disarm the trigger" does=${disarm}>disarm<//>`
            : html`<${Button} title="arm the trigger" does=${() => arm()} disabled=${names.length === 0 || isLocked()}>arm<//>`}
    <output>${state}${state === 'armed' && store.look?.paused ? ': time is stopped' : ''}</output>
    ${state === 'done' && !shot && html`<${Button} title="show what the scope has recorded" does=${async () => {
      const { scope } = await askQuietly({ do: 'scope' });
      if (scope) await showShot(scope);
    }}>show<//>`}
    ${shot && html`<${Button} title="back to the running plot" does=${() => show(null)}>back<//>`}</div>`;
}

export function Plot() {
  const [window_s, setWindow] = useKept('seconds of the plot', 10);
  const [frozen, freeze] = useKept('frozen plot', null, false);
  const [shot, show] = useKept('shot', null, false);
  const [isApart, setApart] = useKept('own scales', false);
  if (store.bench) beginWith(store.number);
  const running = () => ({ labels: [...names], columns: [times, ...names.map((name) => rows.get(name))] });
  const isRecording = store.timeline !== null;
  const [recorded, sees] = useRecordedPlot(isRecording ? names : []);
  const { labels, columns } = shot ?? frozen ?? (isRecording ? { labels: [...names], columns: recorded } : running());
  const moment = shot ? 0 : isRecording ? store.look?.time_ns / 1e9 : undefined;
  const take = async (name) => {
    if (names.length >= kMaxNames) { complain(`${kMaxNames} curves at most; remove one first`); return false; }
    if (!(await ask({ do: 'get', names: [name] })).ok) return false;
    show(null);
    freeze(null);
    add(name);
  };
  const hold = () => freeze(frozen ? null : { labels: [...names], columns: running().columns.map((column) => [...column]) });
  return html`<div class="bar">
      <${Field} label="a name to plot" list="names" size="28" takes=${take} />
      <datalist id="names">${suggestions().slice(0, 600).map((name) => html`<option value=${name}></option>`)}</datalist>
      ${!isRecording && html`<${Choice} label="seconds shown" value=${String(window_s)} options=${['1', '2', '5', '10', '30', '60'].map((s) => [s, `${s} s`])}
        takes=${(s) => setWindow(Number(s))} />
      <${Button} title="freeze the plot" pressed=${frozen !== null} disabled=${shot !== null} does=${hold}>freeze<//>`}
      <${Button} title="save as CSV" does=${() => save(`plot ${nameOfBench()}.csv`, [asCsv(labels, columns)], 'text/csv')}>CSV<//>
      <${Button} title="save as a picture" does=${() => savePicture(labels)}>picture<//>
      <${Button} title="give each curve its own scale" pressed=${isApart} does=${() => setApart(!isApart)}>own scales<//>
      <small>Drag to zoom${isRecording ? ', down to every tick' : ''}; double click to go back.</small>
    </div>
    <div class="bar">${names.map((name, i) => html`<span class="joined curve" key=${name}><b class=${`c${i}`}>${name}</b>
      <output class="figure" aria-live="off">${grouped(numberOf(valueOf(name)))}</output>
      <${Button} kind="small" title=${`remove ${name}`} does=${() => { freeze(null); drop(name); }}>×<//></span>`)}</div>
    ${labels.length > 0 && html`<${Drawing} columns=${columns} labels=${labels} window_s=${window_s} isShot=${shot !== null} isApart=${isApart}
      moment=${moment} sees=${isRecording ? sees : undefined} />`}
    ${!isRecording && html`<${Scope} shot=${shot} show=${show} />`}`;
}
