// A profile: motion along one coordinate over time, as a value made of constant-jerk segments.
//
//   speed            ______
//                   /      \          segment 0: accelerate, 1: cruise, 2: decelerate
//                  /        \         (an S-curve has up to seven)
//                 /__________\___ time
//
// Pure and in closed form: any moment can be asked for, in any order, at the same cost.
#pragma once

#include <array>
#include <cstdint>

namespace understudy::motion {

/// Simulated milliseconds since power-up: the tick that every axis steps by.
using Tick = std::int64_t;

/// Within this much of a tick (1 ns) a duration counts as a whole number of ticks. Durations come out
/// of divisions (3.05 s as 3.0500000000000003 s) and must not cost a tick for that.
inline constexpr double kTickTolerance = 1e-6;

/// Within this much below a whole pulse the pulse counts as sent, for the same reason: a few roundings of a
/// position as large as the distance. More would send the last pulses of a slow, long ramp too early.
constexpr double pulse_tolerance(double distance_pulses) { return 1e-12 + distance_pulses * 5e-16; }

/// Motion at constant jerk. Quantities are those at the segment's beginning.
struct Segment {
  double duration_s = 0;
  double position_pulses = 0;
  double speed_pps = 0;
  double acceleration_pps2 = 0;
  double jerk_pps3 = 0;

  bool operator==(const Segment&) const = default;
};

/// Where a profile is at one moment.
struct Sample {
  double position_pulses = 0;
  double speed_pps = 0;
  double acceleration_pps2 = 0;
};

/// A move from rest to rest over a whole number of pulses, always counted from 0 upwards: direction
/// belongs to the axis. A default-made profile is a move of no distance and no duration.
struct Profile {
  std::array<Segment, 7> segments{};
  std::int32_t segment_count = 0;
  std::int64_t distance_pulses = 0;
  double duration_s = 0;

  bool operator==(const Profile&) const = default;

  /// Adds a segment that begins where the last one ended. `duration_s` >= 0; one of 0 is left out.
  void append(double segment_duration_s, double start_speed_pps, double acceleration_pps2, double jerk_pps3);

  /// t_s < 0 gives the beginning, t_s > duration_s exactly the end.
  Sample sample(double t_s) const;

  /// Whole pulses sent `elapsed` ticks after the beginning: floor of the position, and exactly
  /// `distance_pulses` from end_tick() on.
  std::int64_t pulses_at(Tick elapsed) const;

  /// The first tick, counted from the beginning, at which the profile is over.
  Tick end_tick() const;
};

}  // namespace understudy::motion
