// What a daemon has for those who look on, by the control socket: none of it is part of the world, and it
// costs nothing while nobody asks.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "emulator/world/events/event_log.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/look/looked_names.h"
#include "emulator/world/look/scope.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

struct Onlookers {
  static constexpr std::size_t kMostSnapshots = 16;

  Onlookers(world::World& world, const world::FrameLog& frames) : events(world, frames), names(world) {}

  world::EventLog events;
  std::uint64_t restores = 0;  // how often the world was put into another state: what was told before is over
  world::LookedNames names;
  std::unique_ptr<world::Scope> scope;  // null: nobody has armed one
  struct Kept {
    SimTime at{0};
    world::WorldState state;
  };
  std::map<std::string, Kept> snapshots;  // by name; gone with the daemon
};

}  // namespace understudy::emulator::serve
