// A daemon's control socket.
#pragma once

#include <string>

#include "emulator/serve/daemon/door.h"

namespace understudy::emulator::serve {

/// At `path`: throws ControlError if that cannot be had. Empty: at one of its own (sockets.h); where that
/// cannot be had the daemon is told, and goes on without.
DoorMaker control_door(const std::string& path = "");

}  // namespace understudy::emulator::serve
