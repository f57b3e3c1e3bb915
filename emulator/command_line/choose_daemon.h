// Chooses the running daemon that `ctl` talks to.
#pragma once

#include <string>

#include "emulator/command_line/commands.h"

namespace understudy::emulator::command_line {

/// Returns the control socket of the daemon: the given one, that of the bench or port, the one in
/// UNDERSTUDY_CONTROL, or the only one. If there are several, throws UsageError, which names them all,
/// instead of guessing. Throws ControlError if there is none.
std::string choose_daemon(const WhichDaemon& which);

/// Prints a line for each running daemon of this user: its socket, bench and ports. With `as_json`, prints
/// one object.
int list_daemons(bool as_json);

}  // namespace understudy::emulator::command_line
