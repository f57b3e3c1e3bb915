// One axis in a tick in which something can happen: it goes from moment to moment, and meets what lies there.
//
//   tick - 1 ├──────●───────────────●──────┤ tick       ● an edge at a pulse, the end of the drive
//            begin  look            look   finish
//
// Whoever has several axes act on each other (motion/shared_tick.h) brings one to any moment between.
#pragma once

#include <cstdint>
#include <optional>

#include "motion/axis.h"
#include "motion/pulse_drive.h"
#include "motion/surroundings.h"
#include "motion/tick.h"

namespace understudy::motion {

constexpr bool is_before(const Instant& one, const Instant& other) {
  return one.tick < other.tick || (one.tick == other.tick && one.after_s < other.after_s);
}

class AxisTick {
 public:
  /// Begins it: what has changed since the last tick is met at once. `carried`: pulses that come from
  /// elsewhere, evenly over the tick; or what its follower has been asked for already.
  AxisTick(Axis& axis, const Surroundings& here, Tick tick, std::optional<std::int64_t> carried = {});

  /// The next moment at which something can happen to it; the tick's end where nothing can.
  const Instant& next();
  /// On to a moment that is not beyond that.
  void go_to(Instant at);
  /// On to next(), and through what is to happen there.
  void look();
  bool is_over() const { return is_over_; }
  /// How far it may go from here is known again.
  void watch() { axis_.watch(here_); }
  /// Of an axis on a path, which alone moves it: goes by so many pulses, and meets what is there.
  void go_by(std::int64_t pulses, Instant at);
  /// Somebody else has changed it: it is to look round where it is.
  void look_again() {
    next_ = What::again;
    is_over_ = false;
  }
  void forget_next() { next_ = next_ == What::again ? next_ : What::unknown; }

  /// What has happened since it was asked last.
  Events take_events();
  /// A start at this moment is an event of the next tick.
  void leave_start_to_next_tick();
  /// The pulses of the tick, signed as they come out. Axis::events are all of it.
  std::int64_t finish();

 private:
  /// What is to happen next, in the order in which it is looked for.
  enum class What : std::uint8_t { unknown, again, edge, backlash_ends, drive_ends, carried_edge, nothing };

  bool drives() const;
  Instant end_of_drive() const;
  Instant moment_of_carried(std::int64_t pulse) const;
  void find_next();
  void go_to_edge();
  void end_backlash();
  void end_drive();
  void set_travel(std::int64_t travel, Instant at, int way);
  Cause against(int way) const;
  bool sets_out(int way, Instant at);
  void go_on_carried(std::int64_t pulses, Instant at);

  Axis& axis_;
  const Surroundings& here_;
  Tick tick_;
  Instant at_;
  Instant until_;
  Instant moment_{};  // of what is next
  What next_ = What::unknown;
  bool is_over_ = false;
  Task carried_by_ = Task::none;
  std::int64_t carried_ = 0;  // in this tick, and how many of them have come
  std::int64_t come_ = 0;
  std::int64_t travel_before_;
  std::int64_t backlash_before_;
  Events at_end_ = 0;     // events of the tick's end
  Events next_tick_ = 0;  // and of the next tick
  Events taken_ = 0;
};

}  // namespace understudy::motion
