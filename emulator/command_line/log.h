#pragma once

#include <string>

namespace understudy::emulator::command_line {

/// Prints one line of the daemon's log to standard error.
void log_line(const std::string& text);

}  // namespace understudy::emulator::command_line
