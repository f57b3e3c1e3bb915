// The control socket of a recording: all messages, and two more that go to and fro in it (docs/control.md).
#pragma once

#include <string>
#include <vector>

#include "emulator/serve/daemon/door.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/snapshot.h"

namespace understudy::emulator::serve {

/// The door of a daemon whose world is of the recording's bench and stands. It plays the recording once, as
/// soon as the daemon runs, and goes to `at_first`. `path` as of control_door().
DoorMaker timeline_door(const std::string& path, const world::WorldState& begin,
                        const std::vector<world::RecordedEvent>& events, SimTime end, SimTime at_first);

}  // namespace understudy::emulator::serve
