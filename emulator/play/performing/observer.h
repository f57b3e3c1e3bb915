// Observes a scenario to produce a result at the end, such as a report or findings about a host. The observer
// does not affect the scenario.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "emulator/play/results/result.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

/// All functions are called on the thread that runs the world, between two ticks.
class Observer {
 public:
  virtual ~Observer() = default;
  /// Called when the world was put into another state, after this many steps. Time may have gone back, and
  /// the state of the lines has changed.
  virtual void world_restored(std::size_t steps) = 0;
  virtual void step_over() {}
  /// Called when the scenario has ended. Writes the observations into its result.
  virtual void finish(ScenarioResult& result) = 0;
};

/// Called for each scenario and each branch. The world outlives the returned observer.
using ObserverMaker = std::function<std::unique_ptr<Observer>(world::World&)>;

}  // namespace understudy::emulator::play
