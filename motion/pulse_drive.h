// A pulse generator as a value: a profile that follows the clock, in whole pulses.
//
// It has one direction and sends pulses. Its owner, such as motion/axis.h, decides what a pulse means (a
// coordinate, a direction pin) and when a move is allowed (servo, alarm, limit).
#pragma once

#include <cstdint>

#include "motion/profile.h"
#include "motion/tick.h"

namespace understudy::motion {

/// A moment between ticks: `after_s` (0 <= after_s < 0.001) after `tick`.
struct Instant {
  Tick tick = 0;
  double after_s = 0;
  bool operator==(const Instant&) const = default;
};

enum class Drive : std::uint8_t {
  idle,
  running,  // runs a profile
  hanging,  // a move at speed 0: it counts as moving, sends no pulses, and ends only by stop()
};

/// A segment in ticks: position = place + k (first + k (second + k third)), k ticks after its beginning.
/// Counting in ticks keeps whole values of k exact and needs no division.
struct TickSegment {
  double begin_ticks = 0;  // the beginning, relative to the drive's begin_tick
  double place = 0;        // the place plus the tolerance, so rounding down gives the pulse
  double first = 0;
  double second = 0;
  double third = 0;

  bool operator==(const TickSegment&) const = default;
};

struct PulseDrive {
  // The members that every tick needs come first: the current segment.
  TickSegment now{};
  Tick begin_tick = 0;           // the tick in which the profile begins
  Tick next_check = kNoTick;     // from this tick on, `now` is no longer the current segment
  std::int64_t sent_pulses = 0;  // pulses sent, counted from the beginning of the profile's coordinate
  std::int64_t direction = +1;   // +1 or -1: where the position increases; an owner may set 0 at rest
  Drive drive = Drive::idle;
  double begin_after_s = 0;  // the profile begins this long after `begin_tick`
  double tolerance = 0;      // pulse_tolerance of the distance

  Profile profile;

  bool operator==(const PulseDrive&) const = default;

  /// Begins `move` in `move_direction` (+1 or -1) from standstill, at `first_tick` (the first tick to be
  /// stepped) or at a moment between ticks. A running profile is dropped at its present place. An empty
  /// profile ends the motion at once.
  void start(const Profile& move, int move_direction, Tick first_tick);
  void start(const Profile& move, int move_direction, Instant begin);
  /// Continues with another profile of the same coordinate and direction, which begins at `begin`.
  void continue_with(const Profile& rest, Instant begin);
  /// Begins a move that never sends a pulse.
  void move_at_zero_speed(int move_direction);
  /// Stops the drive: no further pulse is sent.
  void stop();

  bool moving() const { return drive != Drive::idle; }
  Instant beginning() const { return {.tick = begin_tick, .after_s = begin_after_s}; }

  /// Returns the signed number of pulses in the tick. Ticks must come in order but may be skipped; the result
  /// then includes the pulses of the skipped ticks. When the profile ends, the drive becomes idle.
  std::int64_t step(Tick tick) {
    const std::int64_t total = pulses_at(tick);
    const std::int64_t now_pulses = (total - sent_pulses) * direction;
    sent_pulses = total;
    if (over_at(tick)) stop();
    return now_pulses;
  }

  /// Returns the number of whole pulses sent by `tick`, counted from the beginning of the coordinate. Looks
  /// up the segment if necessary.
  std::int64_t pulses_at(Tick tick) {
    if (tick >= next_check) look_up_segment(tick);
    return pulses_of_segment(tick);
  }

  /// Like pulses_at(), but only within a segment, before `next_check`. It costs one cubic and one rounding.
  std::int64_t pulses_of_segment(Tick tick) const {
    const double k = static_cast<double>(tick - begin_tick) - now.begin_ticks;
    return whole(now.place + k * (now.first + k * (now.second + k * now.third)));
  }

  bool over_at(Tick tick) const {
    return drive == Drive::running &&
           elapsed_s(tick) * kTicksPerSecond >= profile.duration_s * kTicksPerSecond - kTickTolerance;
  }

  /// Returns the position (not rounded), speed and acceleration at a moment; the state is at rest if nothing
  /// runs.
  Sample sample(Instant at) const;
  /// Returns the number of whole pulses at a moment.
  std::int64_t pulses_at_moment(Instant at) const;
  /// Returns the moment at which pulse number `pulse` is sent, after `from` and until `until` (less than two
  /// ticks apart).
  Instant time_of_pulse(std::int64_t pulse, Instant from, Instant until) const;

  /// Returns the next tick whose step may send a pulse or end the move, or kNoTick if nothing runs. `done` is
  /// the last tick stepped.
  Tick next_active_tick(Tick done) const { return drive == Drive::running ? done + 1 : kNoTick; }

  double elapsed_s(Tick tick) const {
    return static_cast<double>(tick - begin_tick) / kTicksPerSecond - begin_after_s;
  }
  double elapsed_s(Instant at) const {
    return static_cast<double>(at.tick - begin_tick) / kTicksPerSecond + (at.after_s - begin_after_s);
  }

 private:
  /// Rounds down, without a library call. Returns 9e18 for larger values.
  static std::int64_t whole(double place) {
    constexpr std::int64_t kMax = 9'000'000'000'000'000'000;
    if (place >= 0 && place < 9e18) [[likely]]
      return static_cast<std::int64_t>(place);
    if (!(place < 0)) return kMax;
    if (place <= -9e18) return -kMax;
    const auto cut = static_cast<std::int64_t>(place);
    return cut - static_cast<std::int64_t>(static_cast<double>(cut) > place);
  }
  void look_up_segment(Tick tick);
};

}  // namespace understudy::motion
