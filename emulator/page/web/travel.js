// The timeline of a recording, which moves to any moment: by dragging, by steps, or to its marks.
import { html, useRef, useState } from './preact.js';
import { ask, draw, isAltered, isReadOnly, store } from './store.js';
import { Button, Choice, seconds } from './small.js';

const kTick_ns = 1_000_000;
const kSteps = [['event', -1, '−event'], ['frame', -1, '−frame'], ['tick', -1, '−1 ms'], ['tick', 1, '+1 ms'],
                ['frame', 1, '+frame'], ['event', 1, '+event']];

const kKeys = { ',': ['tick', -1], '.': ['tick', 1], '[': ['frame', -1], ']': ['frame', 1], '{': ['event', -1], '}': ['event', 1] };

const sayMark = (mark) => [seconds(mark.time_ns), mark.what, mark.device ?? mark.line ?? '', mark.text ?? ''].filter(Boolean).join(' ');

// Sends one request at a time. Meanwhile only the latest request is kept, so dragging does not build up a queue.
let isUnderWay = false;
let wish = null;
async function seek(message) {
  // Steps that arrive meanwhile are added up.
  const isMore = wish?.by && wish.by === message.by;
  wish = isMore ? { by: wish.by, steps: wish.steps + message.steps } : message;
  if (isUnderWay) return;
  isUnderWay = true;
  while (wish) {
    const next = wish;
    wish = null;
    await ask({ do: 'seek', ...next });
  }
  isUnderWay = false;
  draw();
}

export function Travel() {
  const { timeline, look } = store;
  const [dragged, setDragged] = useState(null);
  const release = useRef(0);
  if (!timeline || !look) return null;
  const { begin_ns, end_ns, marks } = timeline;
  const length = Math.max(end_ns - begin_ns, 1);
  const locked = isReadOnly() || isAltered();
  const at = dragged ?? look.time_ns;
  const drag = (event) => {
    const to_ns = Math.min(end_ns, begin_ns + Number(event.target.value) * kTick_ns);
    setDragged(to_ns);
    clearTimeout(release.current);
    release.current = setTimeout(() => setDragged(null), 500);
    seek({ to_ns });
  };
  const press = (event) => {
    const [by, steps] = kKeys[event.key] ?? [];
    if (!by || locked) return;
    event.preventDefault();
    seek({ by, steps });
  };
  return html`<section class="travel" aria-label="the recording" onKeyDown=${press}>
    <div class="marks" aria-hidden="true">${marks.map((mark, i) => html`<i key=${i} class=${mark.what} title=${sayMark(mark)}
      style=${{ left: `${100 * (mark.time_ns - begin_ns) / length}%` }} onClick=${() => locked || seek({ to_ns: mark.time_ns })}></i>`)}</div>
    <input type="range" min="0" max=${Math.ceil(length / kTick_ns)} step="1" value=${Math.round((at - begin_ns) / kTick_ns)}
      disabled=${locked} aria-label="moment of the recording" aria-valuetext=${seconds(at)} onInput=${drag} />
    <div class="bar">
      ${kSteps.map(([by, steps, sign]) => html`<${Button} kind="small" key=${sign} disabled=${locked}
        title=${`${steps < 0 ? 'back' : 'forward'} by one ${by}`} does=${() => seek({ by, steps })}>${sign}<//>`)}
      <small>${seconds(begin_ns)} to ${seconds(end_ns)}</small>
      ${marks.length > 0 && html`<${Choice} label="jump to an event" value="" disabled=${locked}
        options=${[['', marks.length === 1 ? '1 mark' : `${marks.length} marks`], ...marks.map((mark, i) => [String(i), sayMark(mark)])]}
        takes=${(i) => i !== '' && seek({ to_ns: marks[Number(i)].time_ns })} />`}
      ${timeline.marks_left_out > 0 && html`<small>and ${timeline.marks_left_out} more that are not shown</small>`}
    </div>
  </section>`;
}
