// Listens at an address or a name of this machine.
#pragma once

#include <vector>

#include "base/files/descriptor.h"
#include "emulator/world/bench/listening.h"

namespace understudy::emulator::serve {

/// Returns a socket for each address of the host ("localhost" is 127.0.0.1 and ::1), all with the same port.
/// If `address` has no port, chooses a free port and stores it there. Throws pty::PortError.
std::vector<Descriptor> listen_at(world::TcpAddress& address);

}  // namespace understudy::emulator::serve
