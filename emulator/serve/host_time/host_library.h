// Checks that the library that puts hosts into simulated time exists and is ours.
#pragma once

#include <string>

namespace understudy::emulator::serve {

/// Throws NoTtyShim if hosts could not load the library, or if it belongs to a different version. With a
/// wrong library a host would run in real time, and nobody would notice until it ended.
void require_host_library(const std::string& path);

}  // namespace understudy::emulator::serve
