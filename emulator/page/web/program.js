// The program: its listing with the running line, what it waits for, and values next to it; starts, stops and loads it.
import { html, useEffect, useRef, useState } from './preact.js';
import { ask, askQuietly, isLocked, store, unwant, valueOf, want } from './store.js';
import { Button, Choice, Field, grouped } from './small.js';
import { useKept } from './kept.js';
import { Ladder } from './ladder.js';
import { hasLadder } from './rungs.js';
import { Steps, StopList, useCoverage, useStops } from './stops.js';

const kLook_ms = 150;
const kLookAtStack_ms = 450;  // costs more
const kMaxLines = 4000;  // in a listing; more would make the page slow

// The simulated time since which each program has been waiting for the same thing at the same line.
const waits = new Map();
function waited_ns(key, program) {
  const what = `${program.line} ${program.waits_for}`;
  const known = waits.get(key);
  const now = store.look?.time_ns ?? 0;
  if (!program.waits_for) return waits.delete(key) && null;
  if (known?.what === what && known.since <= now) return now - known.since;
  waits.set(key, { what, since: now });
  return 0;
}

function Waits({ device, program }) {
  const left_ns = program.until_ns !== undefined && store.look ? program.until_ns - store.look.time_ns : null;
  const waited = waited_ns(`${device}.${program.program}`, program);
  return html`<li><b>${program.program}</b> <span class=${`state ${program.state}`}>${program.state}</span>
    ${program.line ? html` at line <output aria-live="off" class="figure count">${program.line}</output>` : ''}
    ${program.text && html` <code>${program.text}</code>`}
    ${program.waits_for && html` waits for ${program.waits_for}`}
    ${waited > 0 ? html` since <output aria-live="off" class="figure count">${(waited / 1e9).toFixed(2)} s</output>` : ''}
    ${left_ns !== null && left_ns > 0 ? html`, at most another <output aria-live="off" class="figure count">${(left_ns / 1e9).toFixed(2)} s</output>` : ''}
    ${program.why && html` <span class=${program.state === 'failed' ? 'bad' : ''}>${program.why}</span>`}</li>`;
}

/// Does what a host would do: writes registers one after another, executes a command, or sends a line of text. None of
/// these uses the line, which a host may have open.
async function act(device, control, number) {
  const fill = (text) => text.replace('{}', number);
  const text = control.command ?? control.text;
  if (text) return ask({ do: 'command', device: device.name, text: fill(text) });
  for (const pair of fill(control.set).split(' ')) {
    const [name, value] = pair.split('=');
    if (!(await ask({ do: 'set', values: { [`${device.name}.${name}`]: Number(value) } })).ok) return;
  }
}

function Control({ device, control }) {
  const [number, setNumber] = useKept(`which of ${device.name} ${control.word}`, String(control.lowest ?? 0));
  const word = control.word.replace(' {}', '');
  const does = (which = number) => act(device, control, which);
  if (control.highest === undefined) return html`<${Button} title=${`${word}: ${control.set ?? control.command ?? control.text}`} disabled=${isLocked()} does=${() => does()}>${word}<//>`;
  return html`<span class="joined"><${Button} title=${`${word} ${number}`} disabled=${isLocked()} does=${() => does()}>${word}<//>
    <input type="number" aria-label=${`${word}: which`} min=${control.lowest} max=${control.highest} value=${number} disabled=${isLocked()}
      onInput=${(event) => setNumber(event.target.value)} onKeyDown=${(event) => { if (event.key === 'Enter') does(event.target.value); }} /></span>`;
}

const kMaxOperands = 300;
const kAround = 60;  // lines around the running one, or from the first on

/// The words of a line that may name a register, a contact or a variable.
const operandsOf = (line) => [...new Set(line.replace(/[;#].*/, '').match(/\b[A-Za-z_][A-Za-z_]*\d+\b/g) ?? [])];

/// The current values of a line's operands. Words that are not names have no value.
function Operands({ device, line }) {
  const told = operandsOf(line).map((word) => [word, valueOf(`${device}.${word}`)]).filter(([, value]) => typeof value === 'number');
  return told.length > 0 && html`<small class="operands figure">${told.map(([word, value]) => `${word} = ${grouped(value)}`).join(', ')}</small>`;
}

/// A line: its breakpoint, how often it has run, and its text.
function Line({ device, number, text, isRunning, isCaller, point }) {
  const { has, count, toggle } = point(number);
  const title = `${has ? 'delete the breakpoint' : 'stop'} at line ${number}`;
  return html`<li class=${`${isRunning ? 'running' : isCaller ? 'caller' : ''} ${count ? count.kind : ''}`} aria-current=${isRunning ? 'step' : undefined}>
    <button type="button" class="stop" title=${title} aria-label=${title} aria-pressed=${has} tabindex=${has ? 0 : -1} onClick=${toggle}>●</button>
    ${count && html`<small class="runs figure" title=${count.says}>${count.text}</small>`}<code>${text || ' '}</code><${Operands} device=${device} line=${text} /></li>`;
}

function Listing({ device, lines, running, callers, point, counts }) {
  const list = useRef(null);
  const first = Math.min(...running);
  const from = Number.isFinite(first) ? Math.max(0, first - kAround) : 0;
  const operands = [...new Set(lines.slice(from, from + 2 * kAround).flatMap(operandsOf))].slice(0, kMaxOperands);
  useEffect(() => {
    want('listing', operands.map((word) => `${device}.${word}`));
    return () => unwant('listing');
  }, [device, operands.join()]);
  useEffect(() => {
    const box = list.current;
    const line = box?.children[first - 1];
    if (!line) return;
    const isOut = line.offsetTop < box.scrollTop || line.offsetTop + line.offsetHeight > box.scrollTop + box.clientHeight;
    if (isOut) box.scrollTop = line.offsetTop - box.clientHeight / 3;  // scrolls only the box, never the page
  }, [first]);
  return html`<ol class=${counts ? 'listing counted' : 'listing'} ref=${list} tabindex="0" aria-label="listing">${lines.map((line, i) => html`<${Line} key=${i}
    device=${device} number=${i + 1} text=${line} isRunning=${running.has(i + 1)} isCaller=${callers.has(i + 1)} point=${point} />`)}</ol>`;
}

// The meanings of registers, as far as they have been requested.
const meanings = new Map();
async function learnMeaning(device, name) {
  const key = `${device}.${name}`;
  if (meanings.has(key)) return;
  meanings.set(key, '');
  const { registers } = await askQuietly({ do: 'registers', device, find: name, count: 20 });
  meanings.set(key, registers?.find((row) => row.name === name)?.meaning ?? '');
}

function Values({ device }) {
  const [names, setNames] = useKept(`values beside ${device.name}`, []);
  const whole = (name) => (name.startsWith(`${device.name}.`) ? name : `${device.name}.${name}`);
  useEffect(() => {
    want('program', [...device.state_registers.map(whole), ...names]);
    for (const name of [...device.state_registers, ...names]) if (device.sections.length > 0) learnMeaning(device.name, name.replace(`${device.name}.`, ''));
    return () => unwant('program');
  }, [device.name, store.bench, names.join()]);
  const add = async (text) => {
    const name = whole(text);
    if (!(await ask({ do: 'get', names: [name] })).ok) return false;
    if (!names.includes(name)) setNames([...names, name]);
  };
  const row = (name, label, extra) => html`<tr key=${name}><th scope="row">${label}</th>
    <td class="figure">${grouped(valueOf(name))}</td><td>${extra}<small>${meanings.get(name)}</small></td></tr>`;
  return html`<div class="values"><table><tbody>
      ${names.map((name) => row(name, name.slice(device.name.length + 1), html`<${Button} kind="small faint" title=${`remove ${name}`}
        does=${() => setNames(names.filter((it) => it !== name))}>×<//>`))}
      ${device.state_registers.map((name) => row(whole(name), name))}</tbody></table>
    <${Field} label="another value to show here" placeholder="another value" takes=${add} /></div>`;
}

/// Puts the editor's cursor at that place.
function goToLine(line, column) {
  const area = document.querySelector('textarea');
  if (!area) return;
  const lines = area.value.split('\n');
  const from = lines.slice(0, line - 1).reduce((sum, it) => sum + it.length + 1, 0);
  area.focus();
  area.setSelectionRange(from + Math.max(0, column - 1), from + (lines[line - 1] ?? '').length);
  area.scrollTop = Math.max(0, (line - 5) * area.scrollHeight / Math.max(lines.length, 1));
}

export function Program() {
  const devices = Object.values(store.devices).filter((device) => device.program);
  const [deviceName, setDevice] = useKept('device of programs', '');
  const [text, setText] = useState('');
  const [programs, setPrograms] = useState([]);
  const [unread, setUnread] = useState('');  // why it could not be read
  const [stacks, setStacks] = useState(null);
  const [isCounted, count] = useKept('lines are counted', false);
  const device = devices.find((it) => it.name === deviceName) ?? devices[0];
  const [edited, setEdited] = useKept(`program text of ${device?.name}`, null);
  const [mistakes, setMistakes] = useKept(`mistakes of ${device?.name}`, []);
  const [isDrawn, drawLadder] = useKept(`ladder of ${device?.name}`, true);

  // The text in whose lines breakpoints, stacks and counts are: the bench's file, or the listing that the device has.
  const read = async () => {
    const reply = await askQuietly({ do: 'source', device: device.name });
    setText(reply.ok ? (reply.text ?? '').replace(/\n$/, '') : '');
    setUnread(reply.ok ? '' : reply.error);
  };
  // Reads the program again after anyone has loaded another one.
  const loaded = store.events.filter((it) => it.what === 'program' || it.what === 'power').at(-1)?.number ?? 0;
  useEffect(() => { if (device) read(); }, [device?.name, store.bench, loaded]);
  useEffect(() => {
    if (!device) return;
    let over = false;
    const look = async () => {
      const reply = await askQuietly({ do: 'where', device: device.name });
      if (over) return;
      setPrograms(reply.programs ?? []);
      setTimeout(look, kLook_ms);
    };
    const lookAtStack = async () => {
      const reply = await askQuietly({ do: 'stack', device: device.name });
      if (over) return;
      setStacks(reply.ok ? reply : null);
      setTimeout(lookAtStack, kLookAtStack_ms);
    };
    look();
    lookAtStack();
    return () => { over = true; };
  }, [device?.name, store.bench]);
  const stops = useStops(device?.name);
  const coverage = useCoverage(device?.name, isCounted && device !== undefined);

  if (!device) return html`<p>No device of this bench has a program.</p>`;
  const load = async (given) => {
    const reply = await askQuietly({ do: 'program', device: device.name, text: given });
    setMistakes(reply.ok ? [] : reply.mistakes ?? [{ line: 0, column: 0, what: reply.error }]);
    if (reply.ok) { setEdited(null); read(); } else { setEdited(given); }
  };
  const loadFile = async (event) => {
    const [file] = event.target.files;
    if (file) await load(await file.text());
    event.target.value = '';
  };
  const lines = text.split('\n');
  const shown = (edited ?? text) === '' ? 0 : (edited ?? text).split('\n').length;
  const frames = (stacks?.stacks ?? []).filter((it) => it.frames.length > 0).map((it) => it.frames);
  // The listing that is shown may be the bench's file, while `where` counts lines in the device's listing.
  const lineOf = (program) => stacks?.stacks.find((it) => it.program === program.program)?.frames[0]?.line ?? program.line;
  const running = new Set(frames.map(([first]) => first.line));
  const callers = new Set(frames.flatMap(([, ...others]) => others).map((frame) => frame.line));
  const point = (line) => ({ has: stops.at(line) !== undefined, count: coverage?.at(line) ?? null, toggle: () => stops.toggle(line) });
  const stop = stacks?.stop && (store.look?.paused || store.look?.speed === 'manual') ? stacks.stop.text : '';
  const ladder = hasLadder(lines);
  return html`<div class="bar">
      ${devices.length > 1 && html`<${Choice} label="device" value=${device.name} options=${devices.map((it) => it.name)}
        takes=${(name) => { setDevice(name); setPrograms([]); }} />`}
      ${(device.program.controls ?? []).map((control) => html`<${Control} key=${control.word} device=${device} control=${control} />`)}
    </div>
    <div class="bar">
      ${edited === null
        ? html`<${Button} title="change the program" disabled=${isLocked()} does=${() => setEdited(text)}>edit<//>
            <${Button} title="read it again" does=${read}>read<//>
            ${!isLocked() && html`<label class="file">load a file<input type="file" accept=${`${device.program.file_ending},text/plain`} onChange=${loadFile} /></label>`}`
        : html`<${Button} kind="main" title="load this text" does=${() => load(edited)}>load<//>
            <${Button} title="discard the changes" does=${() => { setEdited(null); setMistakes([]); }}>cancel<//>`}
      ${ladder && edited === null && html`<${Button} title="draw the PLC as a ladder" pressed=${isDrawn} does=${() => drawLadder(!isDrawn)}>ladder<//>`}
      ${text !== '' && edited === null && html`<${Button} title="count the lines that run" pressed=${isCounted} does=${() => count(!isCounted)}>coverage<//>
        <${Steps} device=${device.name} />`}
      <small>${coverage ? coverage.says : `${device.program.language}, ${grouped(shown)} ${shown === 1 ? 'line' : 'lines'}`}</small>
    </div>
    ${stop && html`<p class="stopped" role="status">stopped: ${stop}</p>`}
    <ul class="programs">${programs.map((program) => html`<${Waits} key=${program.program} device=${device.name} program=${{ ...program, line: lineOf(program) }} />`)}
      ${programs.length === 0 && html`<li>no program runs</li>`}</ul>
    ${mistakes.map((it, i) => html`<p class="bad" role="alert" key=${i}>${it.line > 0 && html`<button type="button" class="link" title=${`go to line ${it.line}`}
      onClick=${() => goToLine(it.line, it.column)}>line ${it.line}, column ${it.column}</button>: `}${it.what}</p>`)}
    ${lines.length > kMaxLines && html`<p>The first ${grouped(kMaxLines)} of ${grouped(lines.length)} lines; edit shows all.</p>`}
    <div class="with_values">
      ${edited !== null
        ? html`<textarea aria-label="program text" rows="24" spellcheck=${false} value=${edited}
            onInput=${(event) => setEdited(event.target.value)}></textarea>`
        : text === '' ? html`<p class="listing_none">${unread || 'There is no program yet: edit, or load a file.'}</p>`
        : html`<div class="program">${ladder && isDrawn && html`<${Ladder} device=${device.name} lines=${lines} point=${point} />`}
            <${Listing} device=${device.name} lines=${lines.slice(0, kMaxLines)} running=${running} callers=${callers} point=${point} counts=${coverage !== null} />
            <${StopList} stops=${stops} /></div>`}
      <${Values} key=${device.name} device=${device} />
    </div>`;
}
