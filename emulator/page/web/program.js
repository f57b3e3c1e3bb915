// The program: its listing with the line that runs, what it waits for, values beside it.
import { html, useEffect, useState } from './preact.js';
import { ask, askQuietly, isReadOnly, store, unwant, valueOf, want } from './store.js';
import { Button, Choice, grouped } from './small.js';

const kLook_ms = 150;
const kMostLines = 4000;  // of a listing; more would make the page slow

// Since when each program waits for the same thing at the same line, in simulated time.
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
  return html`<li><b>${program.program}</b> ${program.state}
    ${program.line ? html` at line <output class="figure">${program.line}</output>` : ''}
    ${program.text && html` <code>${program.text}</code>`}
    ${program.waits_for && html` waits for ${program.waits_for}`}
    ${waited > 0 ? html` since <output class="figure">${(waited / 1e9).toFixed(2)} s</output>` : ''}
    ${left_ns !== null && left_ns > 0 ? html`, at most another <output class="figure">${(left_ns / 1e9).toFixed(2)} s</output>` : ''}
    ${program.why && html` <span class="bad">${program.why}</span>`}</li>`;
}

export function Program() {
  const devices = Object.values(store.devices).filter((device) => device.program);
  const [deviceName, setDevice] = useState('');
  const [text, setText] = useState('');
  const [edited, setEdited] = useState(null);
  const [programs, setPrograms] = useState([]);
  const [mistakes, setMistakes] = useState([]);
  const device = devices.find((it) => it.name === deviceName) ?? devices[0];

  const read = async () => {
    const reply = await askQuietly({ do: 'program', device: device.name });
    setText(reply.ok ? reply.text ?? '' : `(${reply.error})`);
  };
  useEffect(() => {
    if (!device) return;
    read();
    let over = false;
    const look = async () => {
      const reply = await askQuietly({ do: 'where', device: device.name });
      if (over) return;
      setPrograms(reply.programs ?? []);
      setTimeout(look, kLook_ms);
    };
    look();
    want('program', device.state_registers.map((name) => `${device.name}.${name}`));
    return () => { over = true; unwant('program'); };
  }, [device?.name, store.bench]);

  if (!device) return html`<p>No device of this bench has a program.</p>`;
  const load = async () => {
    const reply = await askQuietly({ do: 'program', device: device.name, text: edited });
    setMistakes(reply.ok ? [] : reply.mistakes ?? [{ line: 0, column: 0, what: reply.error }]);
    if (reply.ok) { setEdited(null); read(); }
  };
  const lines = text.split('\n');
  const shown = lines.slice(0, kMostLines);
  const running = new Set(programs.filter((it) => it.line).map((it) => it.line));
  return html`<div class="bar">
      ${devices.length > 1 && html`<${Choice} label="device" value=${device.name} options=${devices.map((it) => it.name)}
        takes=${(name) => { setDevice(name); setEdited(null); }} />`}
      <small>${device.program.language}</small>
      ${edited === null
        ? html`<${Button} title="change the program" disabled=${isReadOnly()} does=${() => setEdited(text)}>edit<//>
            <${Button} title="read it again" does=${read}>read<//>`
        : html`<${Button} title="load this text" does=${load}>load<//>
            <${Button} title="give up" does=${() => { setEdited(null); setMistakes([]); }}>give up<//>`}
    </div>
    <ul class="programs">${programs.map((program) => html`<${Waits} key=${program.program} device=${device.name} program=${program} />`)}</ul>
    ${mistakes.map((it) => html`<p class="bad" role="alert">${it.line ? `line ${it.line}, column ${it.column}: ` : ''}${it.what}</p>`)}
    ${lines.length > kMostLines && html`<p>The first ${grouped(kMostLines)} of ${grouped(lines.length)} lines; edit shows all.</p>`}
    <div class="with_values">
      ${edited === null
        ? html`<ol class="listing">${shown.map((line, i) => html`<li key=${i}
            class=${running.has(i + 1) ? 'running' : ''}><code>${line || ' '}</code></li>`)}</ol>`
        : html`<textarea aria-label="program text" rows="24" spellcheck="false" value=${edited}
            onInput=${(event) => setEdited(event.target.value)}></textarea>`}
      <table class="values"><tbody>${device.state_registers.map((name) => html`<tr key=${name}><td>${name}</td>
        <td class="figure">${grouped(valueOf(`${device.name}.${name}`))}</td></tr>`)}</tbody></table>
    </div>`;
}
