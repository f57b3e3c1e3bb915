// Determines whether a device uses a terminal, from the register that assigns its function, if there is one.
import { valueOf } from './store.js';

/// Returns the names to watch for this.
export const usesOf = (device, terminals) =>
  terminals.filter((it) => it.used_by && it.functions).map((it) => `${device}.${it.used_by}`);

/// Returns why a wired terminal has no effect when it is pressed, or '' if the device uses it.
export function whyUnused(device, terminal) {
  if (!terminal.used_by || !terminal.functions) return '';
  return valueOf(`${device}.${terminal.used_by}`) === 0 ? `wired, not used: ${terminal.used_by} = 0` : '';
}
