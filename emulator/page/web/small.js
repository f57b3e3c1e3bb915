// Small parts that several panels use.
import { html, useRef, useState } from './preact.js';
import { store } from './store.js';
import { useKept } from './kept.js';

/// Truncated, so that no time appears early.
export const seconds = (ns) => `${(Math.floor(ns / 1e6) / 1e3).toFixed(3)} s`;
/// The same to the microsecond, for the current time.
export const exactly = (ns) => `${(Math.floor(ns / 1e3) / 1e6).toFixed(6)} s`;
export const grouped = (number) =>
  typeof number === 'number' ? number.toLocaleString('en', { maximumFractionDigits: 1, minimumFractionDigits: Number.isInteger(number) ? 0 : 1 }) : '–';
/// A changing number always has the same number of decimals.
export const inTenths = (number) =>
  typeof number === 'number' ? number.toLocaleString('en', { minimumFractionDigits: 1, maximumFractionDigits: 1 }) : '–';
export const isOn = (value) => value === 1 || value === true;
export const spaced = (name) => name.replaceAll('_', ' ');

/// Runs one call of `act` at a time. Of the calls that arrive meanwhile only the last one counts, so dragging does not
/// build up a queue.
export function latest(act) {
  let isUnderWay = false;
  let wish = null;
  return async (...given) => {
    wish = given;
    if (isUnderWay) return;
    isUnderWay = true;
    while (wish) {
      const next = wish;
      wish = null;
      await act(...next);
    }
    isUnderWay = false;
  };
}

/// A button that shows only a picture still has a label for screen readers.
export function Button({ does, title, pressed, disabled, kind = '', children }) {
  return html`<button type="button" class=${kind} title=${title} aria-label=${title} aria-pressed=${pressed}
    disabled=${disabled} onClick=${does}>${children}</button>`;
}

/// A text field that passes on its text when Enter is pressed. `of` is its owner, if several fields have the same
/// label.
export function Field({ label, of = '', placeholder, takes, list, size = 12, disabled }) {
  const [text, keepText] = useKept(`field ${of} ${label}`, '');
  const setText = (to) => keepText(to === '' ? undefined : to);
  // Uses the current text, not the text of the last drawing: a fast typist is ahead of the drawing.
  const send = async ({ value }) => {
    if (value.trim() !== '' && await takes(value.trim()) !== false) setText('');
  };
  return html`<input aria-label=${label} title=${label} placeholder=${placeholder ?? label} list=${list} size=${size} value=${text}
    disabled=${disabled} spellcheck=${false} autocomplete="off" autocapitalize="off" enterkeyhint="send"
    onInput=${(event) => setText(event.target.value)}
    onKeyDown=${(event) => { if (event.key === 'Enter') send(event.target); if (event.key === 'Escape') setText(''); }} />`;
}

export function Choice({ label, value, options, takes, disabled }) {
  return html`<select aria-label=${label} title=${label} value=${value} disabled=${disabled}
    onChange=${(event) => takes(event.target.value)}>
    ${options.map((option) => {
      const [given, text] = Array.isArray(option) ? option : [option, option];
      return html`<option value=${given} selected=${given === value}>${text}</option>`;
    })}</select>`;
}

/// While it is dragged, it shows the dragged value, not the last value from the bench.
export function Slider({ label, lowest, highest, value, takes, disabled }) {
  const [dragged, setDragged] = useState(null);
  const kept = useRef(/** @type {any} */ ({}));
  const drag = (event) => {
    const to = Number(event.target.value);
    setDragged(to);
    clearTimeout(kept.current.release);
    kept.current.release = setTimeout(() => setDragged(null), 400);
    kept.current.take ??= latest((number) => kept.current.takes(number));
    kept.current.take(to);
  };
  kept.current.takes = takes;
  return html`<input type="range" min=${lowest} max=${highest} value=${dragged ?? value ?? lowest} aria-label=${label}
    disabled=${disabled} onInput=${drag} />`;
}

export function Lamp({ on, says }) {
  return html`<span class=${`lamp ${on === undefined || on === null ? 'dark' : isOn(on) ? 'on' : 'off'}`}
    role="img" aria-label=${`${says}: ${isOn(on) ? 'on' : 'off'}`}></span>`;
}

/// For the names of files.
export const nameOfBench = () => store.bench?.path?.split('/').at(-1)?.replace(/\.(yaml|jsonl)$/, '') ?? '';

/// Offers the browser a file to save.
export function save(name, parts, type) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob(parts, { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/// A row that stands for missing items of a list.
export function Missed({ count, what, columns }) {
  return html`<tr class="missed"><td colspan=${columns}>${grouped(count)} ${what} not shown</td></tr>`;
}
