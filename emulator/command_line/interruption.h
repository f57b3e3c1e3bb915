// Commands that go on until Ctrl-C, and then end well.
#pragma once

#include "base/simulated_time.h"

namespace understudy::emulator::command_line {

/// From now on SIGINT and SIGTERM no longer end the program, only its waiting.
void watch_for_interruption();
bool is_interrupted();
/// Waits this long by the wall clock, or until it is interrupted.
void wait_or_be_interrupted(SimTime time);

}  // namespace understudy::emulator::command_line
