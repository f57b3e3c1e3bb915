// What somebody has typed, chosen or armed. It outlives the panel where that was done, and, but for what is large, a
// reload of the page; the tab's own storage has it until the tab is closed.
import { draw, store } from './store.js';

const kPlace = 'understudy';
const benches = new Map();  // by socket; '': the page's own
let lasting = {};
try {
  lasting = JSON.parse(sessionStorage.getItem(kPlace)) ?? {};
} catch { /* without it nothing outlives a reload */ }

const socketShown = () => store.hello?.benches[store.number]?.socket ?? '';
function keptOf(socket) {
  if (!benches.has(socket)) benches.set(socket, new Map(Object.entries(lasting[socket] ?? {})));
  return benches.get(socket);
}

let planned = 0;
function storeAway() {
  clearTimeout(planned);
  try {
    sessionStorage.setItem(kPlace, JSON.stringify(lasting));
  } catch { /* too much of it, or not allowed */ }
}
addEventListener('pagehide', storeAway);

/// Of the bench that is shown; `of` '': of the page.
export function kept(name, initial, of = socketShown()) {
  const all = keptOf(of);
  return all.has(name) ? all.get(name) : initial;
}

export function keep(name, value, { of = socketShown(), isLasting = true } = {}) {
  const all = keptOf(of);
  value === undefined ? all.delete(name) : all.set(name, value);
  if (isLasting) {
    lasting[of] = { ...lasting[of], [name]: value };
    clearTimeout(planned);
    planned = setTimeout(storeAway, 200);
  }
  draw();
}

/// Like useState, but it is still there when the panel comes back.
export const useKept = (name, initial, isLasting = true) => {
  const of = socketShown();
  return [kept(name, initial, of), (value) => keep(name, value, { of, isLasting })];
};
