// Where the control sockets of a user's daemons are when nobody says otherwise: side by side in a folder that
// only that user may open, $XDG_RUNTIME_DIR/understudy or else /tmp/understudy-UID. Each is named by its
// process, "1234.control".
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::serve {

/// Made if it is not there. Throws ControlError if it cannot be had, or others could open it.
std::string control_folder();

/// For a daemon of this process: a path in that folder that no other has. Throws ControlError.
std::string own_control_path();

/// Those in that folder at which a daemon listens, in the order of their names. What daemons have left behind
/// that were killed is removed. Throws ControlError.
std::vector<std::string> live_control_sockets();

}  // namespace understudy::emulator::serve
