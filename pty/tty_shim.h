// Functions shared by the parts of the preloaded library. They use only libc.
#pragma once

namespace understudy::shim {

/// Returns the number of the pseudo-terminal that has `descriptor` as its slave, or -1 if there is none. The
/// number does not show whether the emulator owns the terminal.
int pseudo_terminal_number(int descriptor);

}  // namespace understudy::shim
