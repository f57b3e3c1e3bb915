// The control socket of a recording: all messages, and two more that move in its time (docs/control.md).
#pragma once

#include <string>
#include <vector>

#include "emulator/serve/daemon/door.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

struct TimelineSetup {
  world::Bench bench;
  world::WorldOptions options;
  world::WorldState begin;
  std::vector<world::RecordedEvent> events;
  SimTime end{0};
  SimTime at_first{0};
};
/// Makes the door of a daemon whose world is of the recording's bench and whose clock is stopped. It plays
/// the recording once, as soon as the daemon runs, and moves to `at_first`. `path` is as for control_door().
DoorMaker timeline_door(const std::string& path, TimelineSetup setup);

}  // namespace understudy::emulator::serve
