// Runs the program's command line, and reports errors as single lines.
#pragma once

#include "emulator/device/model.h"

namespace understudy::emulator::command_line {

/// Runs the command line with all models in `models`. Returns the exit code.
int run_program(int argc, char** argv, ModelList models);

}  // namespace understudy::emulator::command_line
