// Small things that several panels are made of.
import { html, useState } from './preact.js';

export const seconds = (ns) => `${(ns / 1e9).toFixed(3)} s`;
export const grouped = (number) =>
  typeof number === 'number' ? (Number.isInteger(number) ? number.toLocaleString('en') : number.toFixed(1)) : '–';
export const isOn = (value) => value === 1 || value === true;

/// A button that is only a picture to sighted people says to others what it does.
export function Button({ does, title, pressed, disabled, kind = '', children }) {
  return html`<button type="button" class=${kind} title=${title} aria-label=${title} aria-pressed=${pressed}
    disabled=${disabled} onClick=${does}>${children}</button>`;
}

/// A text field that hands over what was typed at Enter.
export function Field({ label, placeholder, takes, list, size = 12, disabled, initial = '' }) {
  const [text, setText] = useState(initial);
  const send = async () => {
    if (text.trim() !== '' && await takes(text.trim()) !== false) setText('');
  };
  return html`<input aria-label=${label} placeholder=${placeholder ?? label} list=${list} size=${size} value=${text}
    disabled=${disabled} spellcheck="false" autocomplete="off"
    onInput=${(event) => setText(event.target.value)}
    onKeyDown=${(event) => { if (event.key === 'Enter') send(); if (event.key === 'Escape') setText(''); }} />`;
}

export function Choice({ label, value, options, takes, disabled }) {
  return html`<select aria-label=${label} title=${label} value=${value} disabled=${disabled}
    onChange=${(event) => takes(event.target.value)}>
    ${options.map((option) => {
      const [given, text] = Array.isArray(option) ? option : [option, option];
      return html`<option value=${given} selected=${given === value}>${text}</option>`;
    })}</select>`;
}

export function Lamp({ on, says }) {
  return html`<span class=${`lamp ${on === undefined || on === null ? 'dark' : isOn(on) ? 'on' : 'off'}`}
    role="img" aria-label=${`${says}: ${isOn(on) ? 'on' : 'off'}`}></span>`;
}

/// Gives the browser a file to keep.
export function save(name, parts, type) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob(parts, { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
