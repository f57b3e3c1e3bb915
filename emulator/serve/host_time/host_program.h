// Whether a command can load the library that puts hosts into simulated time.
#pragma once

#include <string>

namespace understudy::emulator::serve {

/// Returns why the command cannot run in simulated time, or an empty text. For a script its interpreter is
/// checked. A command that does not exist is handled elsewhere.
std::string why_not_in_host_time(const std::string& command);

}  // namespace understudy::emulator::serve
