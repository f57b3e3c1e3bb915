// A daemon's data for observers on the control socket. These data are not part of the world, and cost nothing
// while nobody requests them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/simulated_time.h"
#include "emulator/serve/daemon/kept_waits.h"
#include "emulator/world/coverage/program_coverage.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/look/looked_names.h"
#include "emulator/world/look/scope.h"
#include "emulator/world/recording/recent_course.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/world.h"

namespace understudy::emulator::serve {

struct Observers {
  static constexpr std::size_t kMaxSnapshots = 16;

  Observers(world::World& world, const world::FrameLog& frames)
      : events(world, frames), names(world), debugger(world, events) {}

  world::EventLog events;
  /// The number of restores of the world. Each restore invalidates earlier reports.
  std::uint64_t restores = 0;
  /// The moment of a recording at which `what-if` began; nothing: the recording is unaltered.
  std::optional<SimTime> altered_at;
  world::LookedNames names;
  /// Counts which lines of programs have run since `counted_since`; null: no observer has requested coverage.
  std::unique_ptr<world::ProgramCoverage> coverage;
  SimTime counted_since{0};
  void count_lines(world::World& world) {
    coverage = std::make_unique<world::ProgramCoverage>(world);
    counted_since = world.now();
  }
  std::unique_ptr<world::Scope> scope;  // null: not armed
  world::Debugger debugger;
  /// The events since debugging began, for stepping back; null if nobody is debugging, or if the bench has
  /// been restored.
  std::unique_ptr<world::RecentCourse> course;
  struct Kept {
    SimTime at{0};
    world::WorldState state;
  };
  KeptWaits waits;
  std::map<std::string, Kept> snapshots;  // by name; lost when the daemon ends
};

}  // namespace understudy::emulator::serve
