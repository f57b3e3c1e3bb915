// The words after `understudy`, and what they ask for.
#pragma once

#include <functional>

namespace understudy::emulator::command_line {

/// Nothing is done yet: a call of what comes back does it, and returns the exit code. What is wrong with the
/// words is told on standard error.
std::function<int()> parse_command_line(int argc, char** argv);

}  // namespace understudy::emulator::command_line
