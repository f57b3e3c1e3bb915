// Parses the command line of `understudy`.
#pragma once

#include <functional>

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// Returns a function that runs the command and returns the exit code. Prints errors in the command line to
/// standard error.
std::function<int()> parse_command_line(int argc, char** argv, ModelList models);

}  // namespace understudy::emulator::command_line
