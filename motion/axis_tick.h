// One axis in a tick during which something may happen. It proceeds from moment to moment and handles each
// edge.
//
//   tick - 1 ├──────●───────────────●─────────────┤ tick       ● an edge at a pulse, the end of the drive
//            begin  step_events     step_events   finish
//
// If several axes act on each other, motion/shared_tick.h brings an axis to any moment in between.
#pragma once

#include <cstdint>
#include <optional>

#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/pulse_drive.h"
#include "motion/tick.h"

namespace understudy::motion {

constexpr bool is_before(const Instant& one, const Instant& other) {
  return one.tick < other.tick || (one.tick == other.tick && one.after_s < other.after_s);
}

/// The position of an axis: its travel, and the extra pulses that are not travel.
struct AxisPlace {
  std::int64_t travel_pulses = 0;
  std::int64_t backlash_sent = 0;
};

class AxisTick {
 public:
  /// Begins the tick and handles what has changed since the last tick. `carried` is the number of pulses that
  /// come from elsewhere, evenly over the tick, or that were already taken from the axis's follower.
  AxisTick(Axis& axis, const Environment& environment, Tick tick, std::optional<std::int64_t> carried = {});

  /// Returns the next moment at which something may happen to the axis, or else the end of the tick.
  const Instant& next();
  /// Goes to a moment that is not after next().
  void go_to(Instant at);
  /// Returns where go_to(at) would bring the axis.
  AxisPlace place_at(const Instant& at);
  /// Goes to next() and handles what happens there.
  void step_events();
  bool is_over() const { return is_over_; }
  /// Recomputes how far the axis can go from here before anything can happen.
  void watch() { axis_.watch(here_); }
  /// Moves by `pulses` and handles everything at the new position. For an axis that only its path moves.
  void go_by(std::int64_t pulses, Instant at);
  /// Makes the axis check everything again at its present position. Call it after another object has changed
  /// the axis.
  void rearm() {
    next_ = What::again;
    is_over_ = false;
  }
  void forget_next() { next_ = next_ == What::again ? next_ : What::unknown; }

  /// Returns what has happened since the last call.
  Events take_events();
  /// Moves a start at this moment to the events of the next tick.
  void leave_start_to_next_tick();
  /// Ends the tick. Returns the signed number of pulses; Axis::events then contains all events of the axis.
  std::int64_t finish();

 private:
  /// The kinds of next event, in the order in which they are checked.
  enum class What : std::uint8_t { unknown, again, edge, backlash_ends, drive_ends, carried_edge, nothing };

  bool drives() const;
  Instant end_of_drive() const;
  Instant moment_of_carried(std::int64_t pulse) const;
  void find_next();
  void go_to_edge();
  void end_backlash();
  void end_drive();
  std::int64_t due_at(const Instant& at);
  std::int64_t come_at(const Instant& at) const;
  Cause against(int direction) const;
  bool sets_out(int direction, Instant at);
  void go_on_carried(std::int64_t pulses, Instant at);

  Axis& axis_;
  const Environment& here_;
  Tick tick_;
  Instant at_;
  Instant until_;
  Instant moment_{};  // when next_ happens
  What next_ = What::unknown;
  bool is_over_ = false;
  Task carried_by_ = Task::none;
  std::int64_t carried_ = 0;  // external pulses of this tick, and how many of them have arrived
  std::int64_t come_ = 0;
  std::int64_t travel_before_;
  std::int64_t backlash_before_;
  Events at_end_ = 0;     // events at the tick's end
  Events next_tick_ = 0;  // events of the next tick
  Events taken_ = 0;
};

}  // namespace understudy::motion
