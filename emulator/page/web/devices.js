// Chooses which of a bench's devices a panel shows: all of them if they are few.
import { html } from './preact.js';
import { store } from './store.js';
import { Choice } from './small.js';
import { useKept } from './kept.js';

/// `weigh` returns how much of a panel a device fills; if all fill more than `most`, only one is shown at a time.
/// Returns the devices, and a choice to put above them (nothing if there is only one device).
/** @type {(panel: string, weigh: (device: any) => number, most: number) => [any[], unknown]} */
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
