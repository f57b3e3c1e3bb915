// What the user has typed, chosen or armed. It survives a change of the panel and, unless it is large, a reload of the
// page: the tab's session storage keeps it until the tab is closed.
import { draw, store } from './store.js';

const kPlace = 'understudy';
const benches = new Map();  // by socket; '' is the page's own
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

/// Values belong to the bench that is shown, or to the page if `of` is ''.
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

/// Like useState, but the value is still there when the panel is shown again.
export const useKept = (name, initial, isLasting = true) => {
  const of = socketShown();
  return [kept(name, initial, of), (value) => keep(name, value, { of, isLasting })];
};
