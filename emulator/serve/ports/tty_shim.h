// Finds the library that lets hosts that insist on parity use a pseudo-terminal (pty/tty_shim.cpp).
#pragma once

#include <stdexcept>
#include <string>

namespace understudy::emulator::serve {

struct NoTtyShim : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns its path: in lib/understudy beside the running program, or beside the program's folder. Throws
/// NoTtyShim.
std::string tty_shim_path();

/// Returns LD_PRELOAD with the library in front of libraries that are preloaded already. Throws NoTtyShim if
/// its path cannot be written there.
std::string preload_with_tty_shim();

}  // namespace understudy::emulator::serve
