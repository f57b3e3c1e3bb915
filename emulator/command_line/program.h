// The whole program: does what its words ask for, and says what went wrong in one line.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// With the models that it is to know. Returns the exit code.
int run_program(int argc, char** argv, ModelList models);

}  // namespace understudy::emulator::command_line
