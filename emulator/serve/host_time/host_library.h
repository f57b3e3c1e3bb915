// Checks that the library that puts hosts into simulated time exists and has the right version.
#pragma once

#include <string>

namespace understudy::emulator::serve {

/// Throws NoTtyShim if hosts could not load the library, or if it belongs to a different version. With a
/// wrong library, a host would run in real time, which would be noticed only when it ended.
void require_host_library(const std::string& path);

}  // namespace understudy::emulator::serve
