// Who looks on while a scenario is played, for what is told of it afterwards: a report, the host's manners.
// What is played is the same with and without one.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "emulator/play/results/result.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

/// Everything of it is called where the world is run, between two ticks.
class Onlooker {
 public:
  virtual ~Onlooker() = default;
  /// The world was put into another state, after so many steps: its time may be an earlier one, and its lines
  /// are hearing something else.
  virtual void world_restored(std::size_t steps) = 0;
  virtual void step_over() {}
  /// The play is over. What was seen goes into its result.
  virtual void finish(ScenarioResult& result) = 0;
};

/// One for each scenario and each branch; the world outlives it.
using OnlookerMaker = std::function<std::unique_ptr<Onlooker>(world::World&)>;

}  // namespace understudy::emulator::play
