// What has happened: by whom, to what, and when.
import { html } from './preact.js';
import { isAltered, isReadOnly, store, withHoles } from './store.js';
import { Missed, grouped, seconds } from './small.js';
import { goTo } from './story.js';
import { useKept } from './kept.js';

const kShown = 300;

const placeOf = (event) => [event.line, event.name ?? event.device].filter(Boolean).join(' ');
const wordsOf = (event) => (event.what === 'power' ? `${event.device} ${event.value === 0 ? 'off' : 'on'}` : `${placeOf(event)}${event.value !== undefined && !event.text ? ` = ${event.value}` : ''} ${event.text ?? ''}`);

function Time({ ns }) {
  const canGo = store.timeline && !isAltered() && !isReadOnly();
  return canGo ? html`<button type="button" class="link" title=${`go to ${seconds(ns)}`} onClick=${() => goTo(ns)}>${seconds(ns)}</button>` : seconds(ns);
}

export function EventList({ fits = () => true, most = kShown }) {
  const shown = withHoles(store.events, fits);
  return html`${store.events.length === 0 ? html`<p>Nothing yet.</p>` : shown.length === 0 ? html`<p>Nothing matches.</p>` : ''}
    <div class="scroll"><table class="events"><tbody>${shown.slice(-most).reverse().map((event) => event.missed && event.key ? html`<${Missed}
      key=${event.key} count=${event.missed} what="events" columns="4" />` : html`<tr key=${event.number}
      class=${event.what === 'exception' || event.what === 'dropped' ? 'bad' : event.what === 'ignored' ? 'ignored' : ''}>
      <td class="figure"><${Time} ns=${event.time_ns} /></td><td>${event.what}</td><td>${event.by ?? ''}</td><td>${wordsOf(event)}</td></tr>`)}</tbody></table></div>`;
}

export function Events() {
  const [filter, setFilter] = useKept('filter of events', '');
  const wanted = filter.toLowerCase();
  const fits = (event) => `${event.what} ${event.by ?? ''} ${wordsOf(event)}`.toLowerCase().includes(wanted);
  const count = store.events.filter(fits).length;
  return html`<div class="bar"><input type="search" aria-label="find in events" placeholder="find: a name, host, write, fault ..." size="28" value=${filter}
      onInput=${(event) => setFilter(event.target.value)} />
      <small class="figure count">${grouped(count)} of ${grouped(store.events.length)}${store.eventsLost ? `, ${grouped(store.eventsLost)} not shown` : ''}</small></div>
    <${EventList} fits=${fits} />`;
}
