// A pty belongs to the user who made it, and no one else may open it. A group such as dialout, which may open
// a machine's serial ports, can be allowed to open ours too.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace understudy::emulator::serve {

/// Finds a group by name or number. Returns nothing if there is none.
std::optional<gid_t> find_group(const std::string& name);

/// Lets the group read and write the pty at `path`. Throws pty::PortError, for example if this user is not a
/// member of the group.
void share_port(const std::string& path, gid_t group);

}  // namespace understudy::emulator::serve
