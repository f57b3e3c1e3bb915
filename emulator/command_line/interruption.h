// Allows commands that run until Ctrl-C to end cleanly.
#pragma once

#include "base/simulated_time.h"

namespace understudy::emulator::command_line {

/// From now on, SIGINT, SIGTERM, SIGHUP and SIGPIPE only end wait_or_be_interrupted(), not the program.
/// SIGHUP and SIGPIPE stay ignored if they are ignored.
void watch_for_interruption();
/// The same for a program that moves a machine. SIGQUIT interrupts it, too. SIGTSTP (Ctrl-Z) is refused with
/// a message, because a program that sleeps cannot stop the machine.
void watch_for_interruption_of_machine();
bool is_interrupted();
/// Waits this long by the wall clock, or until a signal arrives.
void wait_or_be_interrupted(SimTime time);

}  // namespace understudy::emulator::command_line
