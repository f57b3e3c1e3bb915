// The default places of control sockets: a folder that only the user may open, $XDG_RUNTIME_DIR/understudy
// or else /tmp/understudy-UID. Each socket is named after its process, "1234.control".
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// Returns the folder, and makes it if it does not exist. Throws ControlError if it cannot be made, or if
/// other users could open it.
std::string control_folder();

/// Returns a path in that folder for a daemon of this process. No other daemon uses it. Throws ControlError.
std::string own_control_path();

/// Returns the sockets in that folder at which a daemon listens, in the order of their names. Removes
/// sockets that killed daemons left. Throws ControlError.
std::vector<std::string> live_control_sockets();

}  // namespace understudy::emulator::serve
