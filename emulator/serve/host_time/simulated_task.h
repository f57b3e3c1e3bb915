// A task such as a scenario that runs in simulated time beside the host. Time advances only while both wait.
#pragma once

#include <optional>

#include "base/simulated_time.h"

namespace understudy::emulator::serve {

class SimulatedTask {
 public:
  virtual ~SimulatedTask() = default;
  /// Called at time `now`, while the host sleeps. If the task's wait is over, the task acts on the world
  /// until its next wait.
  virtual void act(SimTime now) = 0;
  /// Returns the latest end of the task's wait, or nothing if it does not wait for a time.
  virtual std::optional<SimTime> next_act() const = 0;
};

}  // namespace understudy::emulator::serve
