// The whole program: runs its command, and reports errors in one line.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// `models` are all models it knows. Returns the exit code.
int run_program(int argc, char** argv, ModelList models);

}  // namespace understudy::emulator::command_line
