// Where the library is that lets parity-minded hosts use a pseudo-terminal (pty/tty_shim.cpp).
#pragma once

#include <stdexcept>
#include <string>

namespace understudy::emulator::serve {

struct NoTtyShim : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Its path: in lib/understudy beside the running program or beside its folder. Throws NoTtyShim.
std::string tty_shim_path();

/// LD_PRELOAD with it in front of what is preloaded already. Throws NoTtyShim where its path cannot be
/// written there.
std::string preload_with_tty_shim();

}  // namespace understudy::emulator::serve
