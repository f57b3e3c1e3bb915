// Manages the default folder for control sockets, which only the user may open: $XDG_RUNTIME_DIR/understudy,
// or else /tmp/understudy-UID. Each socket is named after its process, such as "1234.control".
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// Returns the folder, and creates it if it does not exist. Throws ControlError if it cannot be created, or
/// if other users could open it.
std::string control_folder();

/// Returns an unused path in that folder for a daemon of this process. Throws ControlError.
std::string own_control_path();

/// Returns the sockets in that folder at which daemons listen, sorted by name. Removes sockets of killed
/// daemons. Throws ControlError.
std::vector<std::string> live_control_sockets();

}  // namespace understudy::emulator::serve
