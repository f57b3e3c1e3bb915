// systemd's readiness protocol (sd_notify(3)), without its library.
#pragma once

namespace understudy::emulator::serve {

/// Sends a state such as "READY=1" as a datagram to the socket that NOTIFY_SOCKET names: a path, or an
/// abstract socket where it begins with '@'. Does nothing if there is none, or nobody listens: a daemon does
/// not depend on who started it.
void notify_service_manager(const char* state);

}  // namespace understudy::emulator::serve
