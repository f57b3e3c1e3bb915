// Returns a running bench to an earlier stop of its debugger, while no host is connected.
#pragma once

#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/daemon/daemon.h"

namespace understudy::emulator::serve {

/// Keeps the course of the bench from now on, unless it is already kept or a host is connected. The first
/// message of a debugger calls this function.
void keep_course(Daemon& daemon);

/// {"do":"continue","back":true}: goes back to the previous stop, or to the beginning of the course.
Json continue_back(Daemon& daemon, const Json& message);
/// {"do":"step","what":"line","back":true}. From there, the bench takes another course: later input from
/// outside is forgotten. Both functions throw MessageError while time runs or a host is connected.
Json step_back(Daemon& daemon, const Json& message);

}  // namespace understudy::emulator::serve
