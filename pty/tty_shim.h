// Functions shared by the parts of the preloaded library. They use only libc.
#pragma once

namespace understudy::shim {

/// Returns the number of the pseudo-terminal whose slave `descriptor` is, or -1 if it is not one. The number
/// does not say whether the emulator owns it.
int pseudo_terminal_number(int descriptor);

}  // namespace understudy::shim
