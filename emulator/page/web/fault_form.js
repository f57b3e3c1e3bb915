// The form for a fault, built from the program's own description of faults.
import { html } from './preact.js';
import { ask, complain, store } from './store.js';
import { Button, Choice, grouped, spaced } from './small.js';
import { useKept } from './kept.js';

/// Returns the names of the places that a kind of fault can have.
function placesFor(place) {
  const lines = (store.bench?.lines ?? []).map((line) => line.name);
  return Object.values(store.devices).flatMap((device) => {
    switch (place) {
      case 'axis': return device.axes.map((axis) => `${device.name}.${axis.name}`);
      case 'wheel':
        return device.axes.filter((axis) => axis.machine.encoder?.wheel).map((axis) => `${device.name}.${axis.name}`)
          .concat(device.terminals.filter((it) => it.kind === 'counted_in').map((it) => `${device.name}.${it.name}`));
      case 'input':
        return device.terminals.filter((it) => it.kind === 'digital_in').map((it) => `${device.name}.${it.name}`);
      case 'line': return [];
      default: return [device.name];
    }
  }).concat(place === 'device_or_line' || place === 'line' ? lines : []);
}

function Line({ field, values, setValues }) {
  const set = (event) => setValues({ ...values, [field.name]: event.target.value });
  const isBounded = field.lowest !== undefined && field.highest < 1e9;  // a higher limit is no limit in practice
  const range = isBounded ? ` ${grouped(field.lowest)} to ${grouped(field.highest)}.` : field.lowest > 0 ? ` From ${grouped(field.lowest)}.` : '';
  const label = `${spaced(field.name)}${field.required ? ' *' : ''}`;
  const doc = html`<small>${field.doc}${range}</small>`;
  // The first of several words is the default.
  if (field.words) {
    return html`<label><span>${label}</span>
      <${Choice} label=${field.name} value=${values[field.name] ?? field.words[0]} options=${field.words} takes=${(word) => setValues({ ...values, [field.name]: word })} />${doc}</label>`;
  }
  const hint = { duration: 'such as 250ms', bytes: 'such as FF 00', number: 'a number' }[field.form] ?? '';
  return html`<label><span>${label}</span>
    <input type=${field.form === 'number' ? 'number' : 'text'} min=${field.lowest} max=${field.highest}
      value=${values[field.name] ?? ''} placeholder=${hint} onInput=${set} required=${field.required}
      spellcheck=${false} autocomplete="off" />${doc}</label>`;
}

/// `places` are the kinds of places to offer; without it, all of them. `place` is set if the place is already chosen.
export function FaultForm({ places, place, done }) {
  const kinds = store.kinds.filter((kind) => !places || places.includes(kind.place));
  const [kindName, setKind] = useKept(`fault at ${place}`, kinds[0]?.name);
  const [where, setWhere] = useKept(`place of the fault at ${place}`, '');
  const [values, setValues] = useKept(`fields of the fault at ${place}`, {});
  const [withTrigger, setTrigger] = useKept(`trigger of the fault at ${place}`, false);
  const kind = kinds.find((it) => it.name === kindName) ?? kinds[0];
  if (!kind) return null;
  const options = placesFor(kind.place);
  const at = place ?? (options.includes(where) ? where : options[0]);
  const fields = withTrigger ? [...kind.fields, ...store.trigger] : kind.fields;
  const fault = { [kind.name]: at };
  for (const { name, required, words } of fields) {
    const text = (values[name] ?? (required && words ? words[0] : '')).trim();
    if (text !== '') fault[name] = /^-?\d+(\.\d+)?$/.test(text) ? Number(text) : text;
  }
  const words = Object.entries(fault).map(([name, value], i) => (i === 0 ? `${name} ${value}` : `${name}=${value}`)).join(' ');
  const inject = async () => {
    if (!(await ask({ do: 'inject', fault })).ok) return;
    complain(`Injected: ${words}`);
    if (done) { setValues({}); done(); }
  };
  return html`<form class="fault_form" onSubmit=${(event) => { event.preventDefault(); inject(); }}>
    <div class="bar"><${Choice} label="kind of fault" value=${kind.name} options=${kinds.map((it) => [it.name, spaced(it.name)])} takes=${setKind} />
    ${!place && html`<${Choice} label="where" value=${at} options=${options} takes=${setWhere} />`}
    <small>${kind.doc.replace(/`(\w+)`/g, (_, word) => spaced(word))}</small></div>
    <div class="fields">${fields.map((field) => html`<${Line} key=${field.name} field=${field} values=${values}
      setValues=${setValues} />`)}</div>
    <div class="bar"><label class="check"><input type="checkbox" checked=${withTrigger}
      onChange=${(event) => setTrigger(event.target.checked)} /> at a moment, a frame or a condition</label>
    <button type="submit" class="main" disabled=${!at}>inject</button>${at && html`<code class="will">${words}</code>`}
    ${!at && html`<small>This bench has no place for this fault.</small>`}
    ${done && html`<${Button} title="close" does=${done}>close<//>`}</div>
  </form>`;
}
