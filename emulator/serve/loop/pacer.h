// Makes simulated time follow the wall clock. Pure: its callers pass the wall time, so tests can choose it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::serve {

struct Speed {
  enum class Kind : std::uint8_t {
    factor,  // simulated seconds per second; 1 is real time
    free,    // as fast as possible, up to kFreest
    manual,  // only on request
  } kind = Kind::factor;
  double factor = 1.0;

  /// Limits virtual time to this factor, so that a host's actions take some simulated time, but not years.
  static constexpr double kFreest = 10'000;
  /// Returns the maximum number of simulated seconds per second; 0 for `manual`.
  double rate() const;
};

/// Parses "real", "free", "manual" or a factor above 0 and at most 10000, such as "2.5" or "10x".
std::optional<Speed> parse_speed(std::string_view text);
std::string format_speed(const Speed& speed);

/// Measures how late the daemon woke up for events, over the last 4,096 wake-ups. The maximum covers all
/// wake-ups.
class Lateness {
 public:
  void record(WallTime lateness);
  std::uint64_t count() const { return count_; }
  WallTime percentile(int percent) const;  // Returns 0 if there are no measurements.
  WallTime max() const { return max_; }

 private:
  std::array<WallTime, 4096> recent_{};
  std::uint64_t count_ = 0;
  WallTime max_{0};
};

class Pacer {
 public:
  /// A wake-up that is later than this is a stall: the additional time does not count as simulated time.
  static constexpr WallTime kLongestStall = std::chrono::seconds(1);

  Pacer(Speed speed, WallTime now) : speed_(speed), anchor_wall_(now) {}

  /// Returns the simulated time that should have been reached.
  SimTime target(WallTime wall) const;
  /// Returns when simulated time will reach `time`, or nothing while the clock is stopped.
  std::optional<WallTime> wall_time_of(SimTime time) const;

  /// Records that the daemon woke up at `wall` for an event planned for `planned`. Removes a stall from
  /// simulated time, and returns the removed wall time, or 0.
  WallTime woke(WallTime planned, WallTime wall);

  void pause(WallTime wall);
  /// Sets the speed from now on.
  void set_speed(const Speed& speed, WallTime wall);
  void resume(WallTime wall);
  bool paused() const { return paused_; }
  /// Returns true if the clock is stopped: either paused or manual.
  bool standing() const { return paused_ || speed_.kind == Speed::Kind::manual; }
  /// Continues from `time`, because simulated time was advanced on request or ran ahead (virtual time).
  void moved_to(SimTime time, WallTime wall);

  const Speed& speed() const { return speed_; }
  const Lateness& lateness() const { return lateness_; }
  std::uint64_t slips() const { return slips_; }

 private:
  Speed speed_;
  WallTime anchor_wall_;
  SimTime anchor_sim_{0};  // simulated time at anchor_wall_
  bool paused_ = false;
  Lateness lateness_;
  std::uint64_t slips_ = 0;
};

}  // namespace understudy::emulator::serve
