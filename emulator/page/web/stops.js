// Breakpoints, steps and coverage of the program panel.
import { html, useEffect, useState } from './preact.js';
import { ask, askQuietly, isLocked, isReadOnly, store } from './store.js';
import { Button, Field, grouped } from './small.js';

const kLook_ms = 1000;    // for changes by others: editors and `ctl` set breakpoints as well
const kWithin = '60s';

/// Asks for something at once, then at intervals, and returns the last answer. `marks` are the values whose change
/// makes it ask again.
function useAsked(message, isWanted, marks) {
  const [reply, setReply] = useState(null);
  const [again, setAgain] = useState(0);
  useEffect(() => {
    if (!isWanted) return setReply(null);
    let over = false;
    const look = async () => {
      const answer = await askQuietly(message);
      if (over) return;
      setReply(answer.ok ? answer : null);
      setTimeout(look, kLook_ms);
    };
    look();
    return () => { over = true; };
  }, [isWanted, store.bench, again, ...marks]);
  return [reply, () => setAgain((count) => count + 1)];
}

/// Breakpoints of the bench: { all, at(line), toggle(line), change(point, more), remove(number) }.
export function useStops(device) {
  const [reply, refresh] = useAsked({ do: 'break' }, true, []);
  const all = reply?.breakpoints ?? [];
  const at = (line) => all.find((point) => point.device === device && point.line === line);
  const send = async (message) => {
    const sent = await ask({ do: 'break', ...message });
    refresh();
    return sent.ok;
  };
  const remove = (number) => send({ delete: number });
  const toggle = (line) => { if (!isReadOnly()) { const point = at(line); return point ? remove(point.number) : send({ device, line }); } };
  /// A breakpoint cannot be changed, so another one takes its place.
  const change = async (point, more) => {
    if (await send({ device: point.device, line: point.line, ...(point.when && { when: point.when }), ...(point.log && { log: point.log }), ...more })) await remove(point.number);
    else return false;
  };
  return { all, at, toggle, change, remove, add: send };
}

/// Counts of lines since counting began: (line) => { kind, text, says }, or null if nobody wants them.
export function useCoverage(device, isWanted) {
  const [reply] = useAsked({ do: 'coverage', device }, isWanted, [device]);
  if (!isWanted || !reply) return null;
  const counts = new Map((reply.covered ?? []).flatMap(({ lines }) => lines).map(([line, ...of]) => [line, of]));
  const { lines, lines_run, branches, branches_taken } = reply.totals;
  return {
    says: `${grouped(lines_run)} of ${grouped(lines)} lines, ${grouped(branches_taken)} of ${grouped(branches)} branches since ${(reply.since_ns / 1e9).toFixed(1)} s`,
    at: (line) => {
      const of = counts.get(line);
      if (!of) return null;
      const [runs, yes, no] = of;
      const kind = runs === 0 ? 'never' : yes === 0 || no === 0 ? 'half' : 'both';
      const says = `has run ${grouped(runs)} times` + (yes === undefined ? '' : `: yes ${grouped(yes)}, no ${grouped(no)}`);
      return { kind, text: grouped(runs), says };
    },
  };
}

/// Continues and steps while time is stopped. On a bench that hosts use, the daemon refuses to go back.
export function Steps({ device }) {
  const { look } = store;
  if (!look || isLocked()) return null;
  const stands = (look.paused || look.speed === 'manual') && !look.advancing;
  const step = (what, back) => ask({ do: 'step', what, device, within: kWithin, ...back });
  const back = (what) => ask({ do: 'step', what, device, back: true });
  const go = () => ask(look.speed === 'manual' ? { do: 'continue', within: kWithin } : { do: 'continue' });
  const button = (title, text, does) => html`<${Button} kind="small" title=${title} disabled=${!stands} does=${does}>${text}<//>`;
  return html`<span class="joined" role="group" aria-label="steps">
    ${button('continue to the next breakpoint', '▶ continue', go)}${button('to the next line', '↓ line', () => step('line'))}
    ${button('over a routine that is called', '↷ over', () => step('over'))}${button('out of the routine', '↑ out', () => step('out'))}
    ${button('back to the line before', '↺ line', () => back('line'))}${button('back to the last stop', '◀ back', () => ask({ do: 'continue', back: true }))}</span>`;
}

const kinds = { line: (point) => `${point.device}, line ${point.line ?? '?'}`, instruction: (point) => `${point.device}, instruction ${point.instruction}`,
  when: () => 'anywhere', write: (point) => `${point.write} is written${point.by ? ` by ${point.by}` : ''}`, on: (point) => point.on };

function Stop({ point, stops }) {
  const locked = isReadOnly();
  return html`<li><span class="dot">●</span> ${(kinds[point.kind] ?? (() => point.kind))(point)}
    ${point.when && html` when <code>${point.when}</code>`}${point.nth > 1 && html`, from hit ${point.nth} on`}${point.log && html`, prints <code>${point.log}</code>`}
    ${point.found === false && html` <span class="bad">no such line now</span>`} <small class="count">${grouped(point.hits)} ${point.hits === 1 ? 'hit' : 'hits'}</small>
    ${!locked && html`${point.kind === 'line' && html` <${Field} of=${point.number} label=${`stop at line ${point.line} only when`} placeholder="only when" size="14" takes=${(when) => stops.change(point, { when })} />
        <${Field} of=${point.number} label=${`at line ${point.line} print, and do not stop`} placeholder="print {A.pulses}" size="14" takes=${(log) => stops.change(point, { log })} />`}
      <${Button} kind="small faint" title=${`delete breakpoint ${point.number}`} does=${() => stops.remove(point.number)}>×<//>`}</li>`;
}

/// All breakpoints of the bench, and a field for one on a condition.
export function StopList({ stops }) {
  return html`<ul class="stops">${stops.all.map((point) => html`<${Stop} key=${point.number} point=${point} stops=${stops} />`)}
    ${!isReadOnly() && html`<li><${Field} label="stop when a condition becomes true" placeholder="stop when ..." size="24" takes=${(when) => stops.add({ when })} /></li>`}</ul>`;
}
