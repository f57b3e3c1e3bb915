#pragma once

#include <string>

namespace understudy::emulator::command_line {

/// Prints one line to the daemon's log on standard error.
void log_line(const std::string& text);

}  // namespace understudy::emulator::command_line
