// Commands that go on until Ctrl-C, and then end well.
#pragma once

#include "base/simulated_time.h"

namespace understudy::emulator::command_line {

/// From now on SIGINT and SIGTERM end no longer the program, but what waits.
void watch_for_interruption();
bool is_interrupted();
/// Waits so long by the clock on the wall, or until it is interrupted.
void wait_or_be_interrupted(SimTime time);

}  // namespace understudy::emulator::command_line
