// Something beside the host that lives in simulated time too, such as a scenario: time moves only while both
// wait.
#pragma once

#include <optional>

#include "base/simulated_time.h"

namespace understudy::emulator::serve {

class Companion {
 public:
  virtual ~Companion() = default;
  /// The host sleeps and time stands at `now`: if the companion's wait is over, it acts on the world until it
  /// waits again.
  virtual void act(SimTime now) = 0;
  /// Returns when its wait ends at the latest, or nothing if time means nothing to it.
  virtual std::optional<SimTime> next_act() const = 0;
};

}  // namespace understudy::emulator::serve
