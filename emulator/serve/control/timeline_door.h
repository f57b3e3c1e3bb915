// The control socket of a recording. It accepts messages that read state or move through the recording, and
// after `what-if` all messages (docs/control.md).
#pragma once

#include <string>
#include <vector>

#include "emulator/serve/control/server.h"
#include "emulator/serve/daemon/daemon.h"
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
/// Returns a handler for messages to a daemon whose world has the recording's bench and whose clock is
/// stopped. It replays the recording once, as soon as the daemon runs, and moves to `at_first`. Call and
/// destroy the handler on the daemon's thread, or after that thread has ended.
ControlServer::Handler timeline_handler(Daemon& daemon, TimelineSetup setup);

/// Returns a maker of doors with that handler. `path` is used as by control_door().
DoorMaker timeline_door(const std::string& path, const TimelineSetup& setup);

}  // namespace understudy::emulator::serve
