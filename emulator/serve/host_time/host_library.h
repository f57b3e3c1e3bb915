// Whether the library that puts hosts into simulated time is there, and is ours.
#pragma once

#include <string>

namespace understudy::emulator::serve {

/// Throws NoTtyShim if hosts could not load the library, or if it is not that of this version. A host would
/// run in real time with it, and nobody would notice before its end.
void require_host_library(const std::string& path);

}  // namespace understudy::emulator::serve
