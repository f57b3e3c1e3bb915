// The words after `understudy`, and what they ask for.
#pragma once

#include <functional>

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// Does nothing yet: calling what it returns does it, and returns the exit code. What is wrong with the words
/// goes to standard error.
std::function<int()> parse_command_line(int argc, char** argv, ModelList models);

}  // namespace understudy::emulator::command_line
