#pragma once

#include <string>

namespace understudy::emulator::command_line {

/// One line of the daemon's log, on standard error.
void log_line(const std::string& text);

}  // namespace understudy::emulator::command_line
