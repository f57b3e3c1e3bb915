// A profile is motion along one coordinate over time, as a value that consists of constant-jerk segments.
//
//   speed            ______
//                   /      \          segment 0: accelerate, 1: cruise, 2: decelerate
//                  /        \         (an S-curve has up to seven; a change of target while moving adds some)
//                 /__________\___ time
//
// The coordinate's unit u is pulses for an axis, and a unit of length for a path. Positions increase in the
// direction of the motion; only a return after an overshoot decreases them.
//
// A profile has a closed form: you can sample any moment, in any order, at the same cost.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace understudy::motion {

/// A piece of motion at constant jerk. The quantities are those at the beginning of the segment.
struct Segment {
  double begin_s = 0;  // the beginning, relative to the profile's
  double position_u = 0;
  double speed_u_s = 0;
  double acceleration_u_s2 = 0;
  double jerk_u_s3 = 0;

  bool operator==(const Segment&) const = default;
};

/// The state of a profile at one moment.
struct Sample {
  double position_u = 0;
  double speed_u_s = 0;
  double acceleration_u_s2 = 0;
  double jerk_u_s3 = 0;
};

/// Returns how close to a whole pulse a position must be to count as having reached it: a few rounding errors
/// of a position as large as the distance. With a larger tolerance, the last pulses of a slow, long ramp
/// would be sent too early.
constexpr double pulse_tolerance(double distance_u) {
  const double tolerance = 1e-12 + distance_u * 5e-16;
  return tolerance < 0.25 ? tolerance : 0.25;
}

/// Returns the state of `segment`, `t_s` after its beginning.
inline Sample sample_segment(const Segment& segment, double t_s) {
  const double half_jerk = 0.5 * segment.jerk_u_s3;
  return {
      .position_u = segment.position_u +
                    t_s * (segment.speed_u_s +
                           t_s * (0.5 * segment.acceleration_u_s2 + t_s * (segment.jerk_u_s3 * (1.0 / 6.0)))),
      .speed_u_s = segment.speed_u_s + t_s * (segment.acceleration_u_s2 + t_s * half_jerk),
      .acceleration_u_s2 = segment.acceleration_u_s2 + t_s * segment.jerk_u_s3,
      .jerk_u_s3 = segment.jerk_u_s3,
  };
}

/// A default-constructed profile is a move of no distance and no duration.
struct Profile {
  // Twelve are enough for a change of target that overshoots: up to four segments to stop, seven to return
  // and one to creep.
  static constexpr std::size_t kMaxSegments = 12;

  std::array<Segment, kMaxSegments> segments{};
  std::int32_t segment_count = 0;
  double duration_s = 0;      // infinite: the last segment continues forever
  double end_position_u = 0;  // the exact target of the move
  double end_speed_u_s = 0;   // speed at the end of the last segment; not 0 if the motion ends abruptly

  bool operator==(const Profile&) const = default;

  /// Returns a profile that begins at `position_u` and has no duration yet.
  static Profile from(double position_u);

  /// Adds a segment that begins where the last one ended, and updates end_position_u, end_speed_u_s and
  /// duration_s. `segment_duration_s` must be >= 0 or infinite. A segment of duration 0 is omitted.
  void append(double segment_duration_s, double speed_u_s, double acceleration_u_s2, double jerk_u_s3);

  /// Ends the profile where it first reaches `position_u`, abruptly if necessary. A profile that ends earlier
  /// does not change. The profile must never reverse.
  void cut_at(double position_u);

  /// Declares that the end is exactly `position_u`, from which the sum of the segments differs only by
  /// rounding errors.
  void end_exactly_at(double position_u) { end_position_u = position_u; }

  /// Returns the state at `t_s`. If `t_s` < 0, it is the beginning; if `t_s` >= duration_s, it is exactly the
  /// end, at rest.
  Sample sample(double t_s) const;

  bool endless() const;
};

inline void Profile::append(double segment_duration_s, double speed_u_s, double acceleration_u_s2,
                            double jerk_u_s3) {
  if (!(segment_duration_s > 0)) return;
  assert(segment_count < static_cast<std::int32_t>(kMaxSegments));
  Segment& added = segments[static_cast<std::size_t>(segment_count)];
  added = {.begin_s = duration_s,
           .position_u = end_position_u,
           .speed_u_s = speed_u_s,
           .acceleration_u_s2 = acceleration_u_s2,
           .jerk_u_s3 = jerk_u_s3};
  ++segment_count;
  duration_s += segment_duration_s;
  if (std::isinf(segment_duration_s)) {
    end_position_u = std::numeric_limits<double>::infinity();
    end_speed_u_s = speed_u_s;
    return;
  }
  const Sample end = sample_segment(added, segment_duration_s);
  end_position_u = end.position_u;
  end_speed_u_s = end.speed_u_s;
}

// This is defined in the header so that the compiler can omit the rest for callers that need only the place,
// such as the tick of a path.
inline Sample Profile::sample(double t_s) const {
  if (segment_count == 0 || t_s >= duration_s) return {.position_u = end_position_u};
  if (t_s <= 0) return sample_segment(segments[0], 0);
  auto i = static_cast<std::size_t>(segment_count - 1);
  while (i > 0 && t_s < segments[i].begin_s) --i;
  return sample_segment(segments[i], t_s - segments[i].begin_s);
}

/// Returns the moment in [from_s, to_s] at which the profile is first at or beyond `position_u`, exact to the
/// last bit, or to_s if the profile does not reach it. Moments before 0 count as 0. The profile must not
/// reverse between the two moments. This takes at most 67 samples.
double time_of(const Profile& profile, double position_u, double from_s, double to_s);

}  // namespace understudy::motion
