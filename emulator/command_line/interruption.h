// Lets commands that run until Ctrl-C end cleanly.
#pragma once

#include "base/simulated_time.h"

namespace understudy::emulator::command_line {

/// From now on SIGINT, SIGTERM, SIGHUP and SIGPIPE only end wait_or_be_interrupted(), not the program. The
/// last two stay ignored if they are.
void watch_for_interruption();
bool is_interrupted();
/// Waits this long by the wall clock, or until it is interrupted.
void wait_or_be_interrupted(SimTime time);

}  // namespace understudy::emulator::command_line
