// Allows commands that run until Ctrl-C to end cleanly.
#pragma once

#include "base/simulated_time.h"

namespace understudy::emulator::command_line {

/// From now on, SIGINT, SIGTERM, SIGHUP and SIGPIPE only end wait_or_be_interrupted(), not the program.
/// SIGHUP and SIGPIPE stay ignored if they are ignored.
void watch_for_interruption();
bool is_interrupted();
/// Waits this long by the wall clock, or until a signal arrives.
void wait_or_be_interrupted(SimTime time);

}  // namespace understudy::emulator::command_line
