// What a scenario needs from a stage with real controllers, besides requests: actions on their surroundings,
// measured times, and a stop. Nothing is known about a real controller except its answers.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator::play {

/// A request that the user has not allowed. It was not sent.
struct NotAllowed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A request beyond the user's limits. It was not sent.
struct BeyondEnvelope : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A rig that should have done something has failed.
struct RigFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// When something happened, by the host's clock.
struct Moment {
  SimTime earliest{0};
  SimTime latest{0};
};

class RealBox {
 public:
  virtual ~RealBox() = default;

  /// Returns why no station answers on a line, or nothing if stations answer.
  virtual std::optional<std::string> why_unreachable(std::size_t line) const = 0;
  /// Has a rig or a person perform an action: {"input", "feeder.DIN_2", "on"}. Returns nothing if the action
  /// was performed, otherwise the reason.
  virtual std::optional<std::string> act(const std::vector<std::string>& words) = 0;
  /// Asks a rig for a value that is not on the line. Returns nothing if there is none.
  virtual std::optional<std::string> tell(const std::string& name) = 0;

  /// Returns why no value can be queried on a line of text now, or nothing.
  virtual std::optional<std::string> why_no_query(std::size_t line) const = 0;

  /// Returns when the last request that may have changed something took effect.
  virtual Moment last_write() const = 0;
  /// Returns the last frames, the oldest first.
  virtual std::vector<std::string> last_frames() const = 0;
  /// Returns true in a rehearsal: nothing is sent, and the world takes the place of the controllers.
  virtual bool is_rehearsal() const = 0;
  /// Returns true if requests are only listed, and nothing is judged.
  virtual bool only_plans() const = 0;

  /// Stops everything if the user has allowed anything that may move.
  virtual void stop() = 0;
};

}  // namespace understudy::emulator::play
