// Finds the libraries that are preloaded into hosts: one allows hosts that require parity to use a
// pseudo-terminal (pty/tty_shim.cpp), the other one also puts hosts into simulated time (pty/host_time/).
#pragma once

#include <stdexcept>
#include <string>

namespace understudy::emulator::serve {

struct NoTtyShim : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr const char* kTtyShimLibrary = "tty_shim.so";
inline constexpr const char* kHostTimeLibrary = "host_time.so";

/// Returns a library's path: in lib/understudy next to the running program, or next to the program's folder.
/// Throws NoTtyShim.
std::string library_path(const std::string& name);

/// Returns LD_PRELOAD with the library before any libraries that are already preloaded. Throws NoTtyShim if
/// the variable cannot contain its path.
std::string preload_with(const std::string& name);

}  // namespace understudy::emulator::serve
