// Implements systemd's readiness protocol (sd_notify(3)) without its library.
#pragma once

namespace understudy::emulator::serve {

/// Sends a state such as "READY=1" as a datagram to the socket in NOTIFY_SOCKET: a path, or an abstract
/// socket if it begins with '@'. Does nothing if the variable is not set, or if nobody listens, because a
/// daemon does not depend on its parent.
void notify_service_manager(const char* state);

}  // namespace understudy::emulator::serve
