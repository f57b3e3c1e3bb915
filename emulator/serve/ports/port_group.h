// Shares pseudo-terminals with a group. A pseudo-terminal belongs to its creator, and nobody else may open
// it. A group such as dialout, which may open a machine's serial ports, can be allowed to open these ports
// too.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace understudy::emulator::serve {

/// Finds a group by name or number. Returns nothing if it does not exist.
std::optional<gid_t> find_group(const std::string& name);

/// Allows the group to read and write the pseudo-terminal at `path`. Throws pty::PortError, for example if
/// this user is not a member of the group.
void share_port(const std::string& path, gid_t group);

}  // namespace understudy::emulator::serve
