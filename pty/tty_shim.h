// What the parts of the library for preloading share. Nothing but libc.
#pragma once

namespace understudy::shim {

/// The number of the pseudo-terminal whose slave it is; -1 if it is not one. From outside, any of them may be
/// ours.
int pseudo_terminal_number(int descriptor);

}  // namespace understudy::shim
