// Observes a scenario to produce something at its end, such as a report or the findings about a host. The
// scenario runs the same with or without it.
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
  /// Called when the world has been put into another state, after this many steps. Time may have gone back,
  /// and the state of the lines has changed.
  virtual void world_restored(std::size_t steps) = 0;
  virtual void step_over() {}
  /// Called when the scenario is over. Writes the observations into its result.
  virtual void finish(ScenarioResult& result) = 0;
};

/// Called for each scenario and each branch. The world outlives the result.
using ObserverMaker = std::function<std::unique_ptr<Observer>(world::World&)>;

}  // namespace understudy::emulator::play
