// Checks whether a command can be started, and whether it can load the library that puts hosts into simulated
// time.
#pragma once

#include <string>

namespace understudy::emulator::serve {

/// Returns the path of a command's program, as a shell finds it; or an empty text.
std::string program_file(const std::string& command);

/// Returns true if the command's program exists and may be started, as far as can be seen from here.
bool can_be_started(const std::string& command);

/// Returns why the command cannot run in simulated time, or an empty text. For a script its interpreter is
/// checked. A command that does not exist is handled elsewhere.
std::string why_not_in_host_time(const std::string& command);

}  // namespace understudy::emulator::serve
