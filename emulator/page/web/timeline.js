// The timeline: time from left to right, and a lane for everything that has a course. A click goes to a moment of a
// recording; a marked stretch shows its totals.
import { html, useEffect, useRef, useState } from './preact.js';
import { isAltered, isReadOnly, store, unwant, want } from './store.js';
import { Button, exactly, grouped } from './small.js';
import { drawLanes, heightOf, kRuler, lanesOf, matches, namesOf, spanAt, wordsOf } from './lanes.js';
import { keepPast, liveCourse, pastBegin, recordedCourse, spansOf } from './course.js';
import { goTo } from './story.js';
import { useDevices } from './devices.js';
import { useKept } from './kept.js';
import { useHands } from './hands.js';

const kMaxAxes = 8;
const kLive_ns = 30e9;
const kFirst_ns = 2e9;
const kShortest_ns = 1e5;
const kPause_ms = 120;
const kEdge = 8;  // dots to the right of the last moment, so that what happened there is whole
const kBetweenWaits_ms = 500;

/// The whole recording, or all that is kept.
function whole() {
  if (store.timeline) return [store.timeline.begin_ns, Math.max(store.timeline.end_ns, store.timeline.begin_ns + kShortest_ns)];
  const now = store.look?.time_ns ?? 0;
  return [Math.min(pastBegin(), now - kFirst_ns), now];
}

/// For a running bench: the last half minute, or less if there is less.
function present() {
  const now = store.look?.time_ns ?? 0;
  return [Math.max(now - kLive_ns, Math.min(pastBegin(), now - kFirst_ns)), now];
}

function within([from, to]) {
  const [begin, end] = whole();
  const length = Math.min(Math.max(to - from, kShortest_ns), end - begin);
  const first = Math.min(Math.max(from, begin), end - length);
  return [Math.round(first), Math.round(first + length)];
}

/// The data received from a recording; kept while other panels are visible.
const told = { key: '', course: null, ask: 0 };

/// The course of a recording; requested again when the stretch or the width changes.
function useRecorded(names, stretch, dots) {
  const [, again] = useState(0);
  const key = JSON.stringify([store.number, store.epochs[store.number], names, stretch, dots]);
  useEffect(() => {
    if (!store.timeline || dots === 0 || told.key === key) return undefined;
    const ask = ++told.ask;
    const timer = setTimeout(async () => {
      const course = await recordedCourse(names, stretch, dots);
      if (ask !== told.ask) return;
      Object.assign(told, { key, course });
      again(ask);
    }, told.course ? kPause_ms : 0);
    return () => clearTimeout(timer);
  }, [key, store.timeline === null]);
  return told.course ?? { stretch, curves: {}, spans: [] };
}

/// The waits of a running bench's host, as last received.
const waits = { key: '', of: '', spans: [], isAsking: false, last: -kBetweenWaits_ms };

/// The waits in the stretch, requested again from time to time, because the stretch moves on with the bench.
function useWaits(isLive, shown, dots) {
  const [, again] = useState(0);
  const of = JSON.stringify([store.number, store.epochs[store.number]]);
  const stretch = shown.map((time) => Math.max(0, Math.round(time)));
  const key = JSON.stringify([of, stretch, dots]);
  useEffect(() => {
    if (!isLive || dots === 0 || waits.isAsking || waits.key === key) return undefined;
    const timer = setTimeout(async () => {
      waits.isAsking = true;
      const spans = await spansOf(stretch, dots);
      Object.assign(waits, { key, of, spans, isAsking: false, last: performance.now() });
      again(waits.last);
    }, Math.max(0, waits.last + kBetweenWaits_ms - performance.now()));
    return () => clearTimeout(timer);
  }, [isLive, key, waits.isAsking]);
  return isLive && waits.of === of ? waits.spans : [];
}

/// Describes a marked stretch: its length, its frames, and how far each axis moved.
function sumsOf([from, to], { curves, spans, stretch }, devices) {
  const frames = spans.filter((span) => span.kind === 'frame' && span.begin_ns >= from && span.begin_ns <= to);
  const latencies = frames.map((span) => span.latency_ns).filter((it) => it !== undefined).sort((a, b) => a - b);
  const count = frames.reduce((sum, span) => sum + (span.count ?? 1), 0);
  const bad = frames.filter((span) => span.bad).length;
  const ways = devices.flatMap((device) => device.axes.map((axis) => {
    const name = `${device.name}.${axis.name}`;
    const row = curves[`${name}.position`];
    if (!row) return '';
    let [way, last] = [0, null];
    row.least.forEach((least, i) => {
      const time = stretch[0] + (stretch[1] - stretch[0]) * (i + 0.5) / row.least.length;
      if (time < from || time > to || Number.isNaN(least)) return;
      const middle = (least + row.greatest[i]) / 2;
      if (last !== null) way += Math.abs(middle - last);
      last = middle;
    });
    return way > 0 ? `${name} moved ${grouped(Math.round(way))} pulses` : '';
  })).filter(Boolean);
  const median = latencies[Math.floor(latencies.length / 2)];
  return [`${((to - from) / 1e9).toFixed(6)} s`, `${grouped(count)} ${count === 1 ? 'exchange' : 'exchanges'}${bad ? `, ${bad} not in order` : ''}`,
    median !== undefined ? `latency ${(latencies[0] / 1e6).toFixed(2)} to ${(latencies.at(-1) / 1e6).toFixed(2)} ms, half below ${(median / 1e6).toFixed(2)} ms` : '', ...ways].filter(Boolean);
}

function Tip({ tip }) {
  if (!tip) return null;
  return html`<div class="tip" style=${{ left: `${tip.x}px`, top: `${tip.y}px`, transform: tip.isRight ? 'translateX(-100%)' : '' }}>
    <b>${exactly(tip.time)}</b> ${tip.text}</div>`;
}

/// What is under the pointer, in words.
function tipAt(lanes, course, time, x, y, width, slack) {
  const lane = lanes.find((it) => y >= it.top && y < it.top + it.height);
  const [from, to] = course.stretch;
  const curve = lane && course.curves[lane.name];
  let text = lane?.label ?? '';
  if (curve) {
    const dot = Math.floor((time - from) / (to - from) * curve.least.length);
    const [least, greatest] = [curve.least[dot], curve.greatest[dot]];
    if (typeof least === 'number') text += `: ${grouped(least)}${greatest !== least ? ` to ${grouped(greatest)}` : ''} ${lane.unit ?? ''}`;
  } else if (lane) {
    const span = spanAt(lane, time, slack);
    if (span) text += `: ${wordsOf(span)}`;
  }
  return { time, text, x: Math.min(Math.max(x, 0), width), y: (lane ? lane.top + lane.height : kRuler) + 4, isRight: x > width / 2 };
}

export function Timeline() {
  const [devices, choice] = useDevices('timeline', (device) => device.axes.length, kMaxAxes);
  const [chosen, setStretch] = useKept('stretch of the timeline', null);
  const [find, setFind] = useKept('find in the timeline', '');
  const [mark, setMark] = useKept('marked stretch', null);
  const [marks, setMarks] = useKept('drags mark', false);
  const [hover, setHover] = useState(null);
  const [width, setWidth] = useState(0);
  const canvas = useRef(null);
  const left = width < 600 ? 0 : 168;
  const dots = Math.max(0, width - left - kEdge);
  const names = namesOf(devices);
  const isRecording = store.timeline !== null;
  const stretch = chosen ? within(chosen) : isRecording ? whole() : present();
  const recorded = useRecorded(isRecording ? names : [], stretch, dots);
  const waited = useWaits(!isRecording, stretch, dots);
  const course = isRecording ? recorded : liveCourse(names, stretch, Math.max(dots >> 1, 1), waited);
  const lanes = lanesOf(devices, course);
  const canGo = isRecording && !isReadOnly() && !isAltered();

  useEffect(() => {
    const seen = new ResizeObserver(() => { if (canvas.current) setWidth(canvas.current.parentElement.clientWidth); });
    seen.observe(canvas.current.parentElement);
    return () => seen.disconnect();
  }, []);
  useEffect(() => {
    if (isRecording) return undefined;
    want('timeline', names);  // always, so that the past is available later
    keepPast(names);
    return undefined;
  }, [isRecording, names.join(), store.bench]);

  const time = (x) => stretch[0] + Math.max(0, Math.min(dots, x - left)) / Math.max(dots, 1) * (stretch[1] - stretch[0]);
  const zoom = (factor, about = (stretch[0] + stretch[1]) / 2) =>
    setStretch(within([about - (about - stretch[0]) * factor, about + (stretch[1] - about) * factor]));
  const pan = (by) => setStretch(within([stretch[0] + by, stretch[1] + by]));
  const go = (at) => { if (canGo) goTo(Math.round(at)); };
  const found = matches(course.spans, find);
  const next = (way) => {
    const now = isRecording ? store.look.time_ns : (stretch[0] + stretch[1]) / 2;
    const all = way > 0 ? found.filter((it) => it.begin_ns > now) : found.filter((it) => it.begin_ns < now).reverse();
    if (all.length === 0) return;
    const at = all[0].begin_ns;
    if (at < stretch[0] || at > stretch[1]) setStretch(within([at - (stretch[1] - stretch[0]) / 2, at + (stretch[1] - stretch[0]) / 2]));
    go(at);
  };
  const clear = () => setMark(null);
  const keys = { '+': () => zoom(0.5), '=': () => zoom(0.5), w: () => zoom(0.5), '-': () => zoom(2), s: () => zoom(2), 0: () => setStretch(null), Home: () => setStretch(null),
    ArrowLeft: () => pan((stretch[0] - stretch[1]) / 5), a: () => pan((stretch[0] - stretch[1]) / 5), ArrowRight: () => pan((stretch[1] - stretch[0]) / 5),
    d: () => pan((stretch[1] - stretch[0]) / 5), m: () => mark && setStretch(within(mark)), Escape: clear, n: () => next(1), p: () => next(-1) };
  const slack = (stretch[1] - stretch[0]) / Math.max(dots, 1) * 6;
  const hands = useHands(canvas, { time, left, zoom, pan, go, marks, setMark, stretch, dots,
    hover: (x, y) => setHover(x === null ? null : [x, y]) });
  const tip = hover && tipAt(lanes, course, time(hover[0]), ...hover, width, slack);

  useEffect(() => {
    const box = canvas.current;
    if (!box || width === 0) return;
    const dense = devicePixelRatio || 1;
    const height = heightOf(lanes);
    if (box.width !== Math.round(width * dense) || box.height !== Math.round(height * dense)) {
      Object.assign(box, { width: Math.round(width * dense), height: Math.round(height * dense) });
      box.style.height = `${height}px`;
    }
    const context = box.getContext('2d');
    context.setTransform(dense, 0, 0, dense, 0, 0);
    drawLanes(lanes, { context, width, left, dots, stretch, course, find: find.trim(), mark, hover: tip?.time, now: isRecording ? store.look?.time_ns : undefined,
      failed_ns: store.timeline?.story?.time_ns });
  });

  const says = `timeline from ${exactly(stretch[0])} to ${exactly(stretch[1])}, ${lanes.length} lanes`;
  return html`<div class="bar">${choice}
      <span class="joined"><${Button} title="earlier (a)" does=${keys.a}>◀<//><${Button} title="zoom in (w)" does=${keys.w}>+<//>
        <${Button} title="zoom out (s)" does=${keys.s}>−<//><${Button} title="later (d)" does=${keys.d}>▶<//></span>
      <${Button} title=${isRecording ? 'show the whole recording (0)' : 'follow the present (0)'} pressed=${chosen === null} does=${keys[0]}>${isRecording ? 'whole' : 'follow'}<//>
      <${Button} title="dragging marks a stretch and shows its totals; otherwise it moves the view (the shift key swaps the two)" pressed=${marks} does=${() => setMarks(!marks)}>mark<//>
      <input type="search" aria-label="find in the timeline" placeholder="find" size="14" value=${find} onInput=${(event) => setFind(event.target.value)} />
      ${find.trim() !== '' && html`<span class="joined"><${Button} kind="small" title="previous match (p)" does=${() => next(-1)}>‹<//>
        <${Button} kind="small" title="next match (n)" does=${() => next(1)}>›<//></span><small>${grouped(found.length)} found</small>`}
      <small class="hint">${canGo ? 'Click: go there. ' : ''}Wheel or pinch: zoom. Drag: move.</small></div>
    ${mark && html`<p class="sums"><b>marked:</b> ${sumsOf(mark, course, devices).join('; ')}
      <${Button} kind="small" title="zoom to the marked stretch (m)" does=${keys.m}>zoom<//> <${Button} kind="small" title="clear the mark (Escape)" does=${clear}>×<//></p>`}
    <div class="timeline"><canvas ref=${canvas} tabindex="0" role="img" aria-label=${says} ...${hands} onKeyDown=${(event) => {
      if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      keys[event.key]();
    }}></canvas><${Tip} tip=${tip} /></div>`;
}
