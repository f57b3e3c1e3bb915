// Whether a command can load the library that puts hosts into simulated time.
#pragma once

#include <string>

namespace understudy::emulator::serve {

/// Returns why the command cannot live in simulated time, or an empty text. For a script its interpreter is
/// looked at. A command that does not exist is no matter of this.
std::string why_not_in_host_time(const std::string& command);

}  // namespace understudy::emulator::serve
