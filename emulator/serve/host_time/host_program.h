// Checks whether a command can be started, and whether it can load the library that puts hosts into simulated
// time.
#pragma once

#include <string>

namespace understudy::emulator::serve {

/// Returns the path of a command's program, found as by a shell, or an empty text.
std::string program_file(const std::string& command);

/// Returns true if the command's program exists and seems to be executable.
bool can_be_started(const std::string& command);

/// Returns the reason why the command cannot run in simulated time, or an empty text. For a script, its
/// interpreter is checked. A missing command is reported elsewhere.
std::string why_not_in_host_time(const std::string& command);

}  // namespace understudy::emulator::serve
