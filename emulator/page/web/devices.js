// Chooses which of a bench's devices a panel shows: all of them if they are few.
import { html } from './preact.js';
import { store } from './store.js';
import { Choice } from './small.js';
import { useKept } from './kept.js';

/// `panel` is the name of the panel. `weigh` returns the size of a device in it; a total above `most` is too much to
/// watch at once. Returns the devices, and a choice to show above them (nothing if there is only one device).
export function useDevices(panel, weigh, most) {
  const [chosen, choose] = useKept(`devices of ${panel}`, null);
  const all = Object.values(store.devices);
  const fits = all.reduce((sum, device) => sum + weigh(device), 0) <= most;
  const isThere = chosen !== null && (chosen === '' ? fits : all.some((device) => device.name === chosen));
  const name = isThere ? chosen : fits ? '' : all[0]?.name;
  const shown = name === '' ? all : all.filter((device) => device.name === name);
  const options = [...(fits ? [['', 'all devices']] : []), ...all.map((device) => [device.name, device.name])];
  return [shown, all.length > 1 && html`<${Choice} label="device" value=${name} options=${options} takes=${choose} />`];
}
