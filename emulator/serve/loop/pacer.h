// How simulated time follows the wall clock. Pure: it is told the wall time, so tests can tell it
// anything.
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
    factor,  // simulated seconds a second; 1 is real time
    free,    // as fast as possible, up to kFreest
    manual,  // only when told to
  } kind = Kind::factor;
  double factor = 1.0;

  /// Free running is bounded, so that what a host does takes some simulated time, but not years.
  static constexpr double kFreest = 10'000;
  /// The most simulated seconds a second; 0 for `manual`.
  double rate() const;
};

/// "real", "free", "manual" or a factor above 0 and at most 10000, such as "2.5" or "10x".
std::optional<Speed> parse_speed(std::string_view text);
std::string format_speed(const Speed& speed);

/// How late the edge woke up for what was due, over the last 4,096 times (the greatest: ever).
class Lateness {
 public:
  void record(WallTime lateness);
  std::uint64_t count() const { return count_; }
  WallTime percentile(int percent) const;  // 0 if there is none
  WallTime greatest() const { return greatest_; }

 private:
  std::array<WallTime, 4096> recent_{};
  std::uint64_t count_ = 0;
  WallTime greatest_{0};
};

class Pacer {
 public:
  /// A wake-up that is later than this is a stall: the time beyond it is left out of simulated time.
  static constexpr WallTime kLongestStall = std::chrono::seconds(1);

  Pacer(Speed speed, WallTime now) : speed_(speed), anchor_wall_(now) {}

  /// Where simulated time should be.
  SimTime target(WallTime wall) const;
  /// When simulated time will be there; nothing while the clock stands still.
  std::optional<WallTime> wall_time_of(SimTime time) const;

  /// The edge woke up at `wall` for something planned for `planned`. Records how late that is; a stall is
  /// left out of simulated time: returns the wall time that was left out, or 0.
  WallTime woke(WallTime planned, WallTime wall);

  void pause(WallTime wall);
  /// From now on.
  void set_speed(const Speed& speed, WallTime wall);
  void resume(WallTime wall);
  bool paused() const { return paused_; }
  /// The clock stands: paused, or manual.
  bool standing() const { return paused_ || speed_.kind == Speed::Kind::manual; }
  /// Simulated time was moved by hand, or ran ahead (free): it goes on from there.
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
