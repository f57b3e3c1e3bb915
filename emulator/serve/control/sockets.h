// Where a user's daemons have their control sockets by default: side by side in a folder that only that user
// may open, $XDG_RUNTIME_DIR/understudy or else /tmp/understudy-UID. Each is named after its process,
// "1234.control".
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// Made if it does not exist. Throws ControlError if it cannot be made, or if others could open it.
std::string control_folder();

/// For a daemon of this process: a path in that folder that no other daemon has. Throws ControlError.
std::string own_control_path();

/// Those in that folder at which a daemon listens, in the order of their names. Sockets that killed daemons
/// left behind are removed. Throws ControlError.
std::vector<std::string> live_control_sockets();

}  // namespace understudy::emulator::serve
