// Chooses the running daemon to which `ctl` connects.
#pragma once

#include <string>

#include "emulator/command_line/commands.h"

namespace understudy::emulator::command_line {

/// Returns the daemon's control socket: the given one, that of the given bench or port, the one in
/// UNDERSTUDY_CONTROL, or that of the only daemon. If there are several daemons, throws UsageError with a
/// list of them. Throws ControlError if there is none.
std::string choose_daemon(const WhichDaemon& which);

/// Prints a line for each running daemon of this user: its socket, bench and ports. With `as_json`, prints a
/// single object.
int list_daemons(bool as_json);

}  // namespace understudy::emulator::command_line
