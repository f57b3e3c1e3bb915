// Whether a device listens to a terminal: by the register that gives it its function, where the device has one.
import { valueOf } from './store.js';

/// Names to watch for that.
export const usesOf = (device, terminals) =>
  terminals.filter((it) => it.used_by && it.functions).map((it) => `${device}.${it.used_by}`);

/// Of a terminal that the machine is wired to: why pressing it does nothing; '' where the device uses it.
export function whyUnused(device, terminal) {
  if (!terminal.used_by || !terminal.functions) return '';
  return valueOf(`${device}.${terminal.used_by}`) === 0 ? `wired, not used: ${terminal.used_by} = 0` : '';
}
