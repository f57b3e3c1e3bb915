// Links to a moment: the panel, the time of a recording, the plotted names and the filters are in the address, after
// the token. The browser's back button returns to the previous panel and moment.
import { ask, complain, draw, store } from './store.js';
import { keep, kept } from './kept.js';
import { isTold } from './told.js';

// The state of a bench that is in the address: the word used there, and the name under which it is kept.
const kKept = [['names', 'plotted'], ['lanes', 'find in the timeline'], ['stretch', 'stretch of the timeline'], ['signals', 'filter of signals'],
               ['section', 'section'], ['register', 'find a register'], ['frame', 'filter of frames'], ['frames', 'which frames'],
               ['event', 'filter of events']];
const kLists = ['names', 'stretch'];
const kPause_ms = 400;  // browsers limit changes of the address

const textOf = (word, value) => (kLists.includes(word) ? value?.join(',') : value) ?? '';
const listOf = (word, text) => (word === 'stretch' ? text.split(',').map(Number) : text.split(',').filter(Boolean));

let given = new URLSearchParams(location.hash.slice(1).split('&').slice(1).join('&'));
let lastPanel = given.get('panel');
let planned = 0;

let panel = '';  // the one in view

/// The current place of the page.
function address() {
  const words = new URLSearchParams();
  words.set('panel', panel);
  if (store.timeline && store.look) words.set('t', String(store.look.time_ns / 1e9));
  for (const [word, name] of kKept) {
    const text = textOf(word, kept(name, undefined));
    if (text !== '' && !(word === 'frames' && text === 'all') && !(word === 'section' && text === '0')) words.set(word, text);
  }
  const token = location.hash.slice(1).split('&')[0];
  return `#${token}&${words}`.replaceAll('%2C', ',').replace(/&$/, '');
}

/// The current place replaces the previous one in the address; a different panel is a new step, to go back from.
function put() {
  planned = 0;
  if (!store.bench || panel === '') return;
  const to = address();
  if (to === location.hash) return;
  history[lastPanel !== null && lastPanel !== panel ? 'pushState' : 'replaceState'](null, '', to);
  lastPanel = panel;
}
/// Called whenever the page has been drawn.
export function noteMoment(shown) {
  panel = shown;
  planned ||= setTimeout(put, kPause_ms);
}

/// Goes to the place in the address once the bench is known.
export function goThere() {
  if (!given || !store.bench) return;
  const words = given;
  given = null;
  if (words.get('panel')) keep('panel', words.get('panel'), { of: '' });
  for (const [word, name] of kKept) {
    const text = words.get(word);
    if (text !== null) keep(name, kLists.includes(word) ? listOf(word, text) : text);
  }
  const time = Number(words.get('t'));
  if (words.has('t') && store.timeline && Number.isFinite(time)) ask({ do: 'seek', to_ns: Math.round(time * 1e9) });
}
addEventListener('popstate', () => {
  given = new URLSearchParams(location.hash.slice(1).split('&').slice(1).join('&'));
  lastPanel = given.get('panel');
  draw();
});

/// Adds a step to go back to, before the moment changes a lot.
export function leaveMoment() {
  put();
  history.pushState(null, '', location.hash);
}

export async function copyMoment() {
  put();
  try {
    await navigator.clipboard.writeText(location.href);
    complain(`The link to this moment is copied${isTold ? '' : '; it works while this page runs'}.`);
  } catch {
    complain(`Copy this address: ${location.href}`);
  }
}
