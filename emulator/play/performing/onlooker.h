// Who looks on while a scenario is played, for something that is said afterwards: a report, the host's
// manners. The play is the same with or without it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "emulator/play/results/result.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

/// All its functions are called on the thread that runs the world, between two ticks.
class Onlooker {
 public:
  virtual ~Onlooker() = default;
  /// The world was put into another state, after this many steps: time may have gone back, and the lines are
  /// hearing something else.
  virtual void world_restored(std::size_t steps) = 0;
  virtual void step_over() {}
  /// The play is over. What was seen goes into its result.
  virtual void finish(ScenarioResult& result) = 0;
};

/// One for each scenario and each branch; the world outlives it.
using OnlookerMaker = std::function<std::unique_ptr<Onlooker>(world::World&)>;

}  // namespace understudy::emulator::play
