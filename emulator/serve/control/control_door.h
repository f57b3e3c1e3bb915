// A daemon's control socket.
#pragma once

#include <string>

#include "emulator/serve/daemon/door.h"

namespace understudy::emulator::serve {

/// At `path`: throws ControlError if it cannot be opened there. Empty: at a path that no other daemon has
/// (sockets.h); if it cannot be opened there, the log says so and the daemon goes on without a socket.
DoorMaker control_door(const std::string& path = "");

}  // namespace understudy::emulator::serve
