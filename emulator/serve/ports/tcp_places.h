// Listening at an address or a name of this machine.
#pragma once

#include <vector>

#include "base/files/descriptor.h"
#include "emulator/world/bench/listening.h"

namespace understudy::emulator::serve {

/// A socket for each address that its host stands for ("localhost" is 127.0.0.1 and ::1), all at one port: a
/// free one, which `address` has afterwards, where it has none. Throws pty::PortError.
std::vector<Descriptor> listen_at(world::TcpAddress& address);

}  // namespace understudy::emulator::serve
