// What a scenario needs from a stage with real controllers, in addition to requests: actions on their
// surroundings, measured times, and a stop. Only the answers of a real controller provide information about
// it.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator::play {

/// Thrown for a request that the user has not allowed. It was not sent.
struct NotAllowed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown for a request that exceeds the user's limits. It was not sent.
struct BeyondEnvelope : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown if a rig failed to do something.
struct RigFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// When something happened, according to the host's clock.
struct Moment {
  SimTime earliest{0};
  SimTime latest{0};
};

class RealBox {
 public:
  virtual ~RealBox() = default;

  /// Returns why no station on a line answers, or nothing if stations answer.
  virtual std::optional<std::string> why_unreachable(std::size_t line) const = 0;
  /// Makes a rig or a person perform an action: {"input", "feeder.DIN_2", "on"}. Returns nothing if the
  /// action was performed, otherwise the reason.
  virtual std::optional<std::string> act(const std::vector<std::string>& words) = 0;
  /// Asks a rig for a value that is not available on the line. Returns nothing if there is none.
  virtual std::optional<std::string> tell(const std::string& name) = 0;

  /// Returns why values cannot be queried on a line of text now, or nothing if they can.
  virtual std::optional<std::string> why_no_query(std::size_t line) const = 0;

  /// Returns when the last request that may have changed something took effect.
  virtual Moment last_write() const = 0;
  /// Returns the last frames. The oldest frame comes first.
  virtual std::vector<std::string> last_frames() const = 0;
  /// Returns true in a rehearsal: nothing is sent, and the world replaces the controllers.
  virtual bool is_rehearsal() const = 0;
  /// Returns true if requests are only listed, and nothing is checked.
  virtual bool only_plans() const = 0;
  /// Returns true if the controller is as it came from the factory, so inputs and programs of the bench are
  /// made first. Otherwise, the bench describes how the controller is set up.
  virtual bool is_bare() const = 0;

  /// Stops everything, provided that the user has allowed anything that may cause motion.
  virtual void stop() = 0;
};

}  // namespace understudy::emulator::play
