// Creates a daemon's control socket.
#pragma once

#include <string>

#include "emulator/serve/daemon/door.h"

namespace understudy::emulator::serve {

/// Creates a socket at `path`. Throws ControlError if it cannot be opened there. If `path` is empty, uses a
/// path that no other daemon uses (sockets.h); if that fails, logs the reason, and the daemon runs without a
/// socket.
DoorMaker control_door(const std::string& path = "");

}  // namespace understudy::emulator::serve
