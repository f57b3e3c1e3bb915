// Checks of every profile of a move: it has no gaps, stays within the limits of its law, and has the
// positions that it reports.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "tests/motion/move_oracle.h"

namespace understudy::motion {

using oracle::Long;

/// The promised tolerance, relative to the limit.
constexpr Long kLimitTolerance = 1e-9L;
/// The tolerance of gaps between segments (rounding errors), relative to the largest speed, position or
/// acceleration.
constexpr Long kGapTolerance = 1e-10L;

/// A failure in words; empty for success.
using Fault = std::optional<std::string>;

inline std::string text(Long value) { return std::to_string(static_cast<double>(value)); }

inline bool has_jerk(const RampLaw& law) {
  return law.kind == RampLaw::Kind::jerk || (law.kind == RampLaw::Kind::sections && law.section_u_s > 0);
}

/// The limits of one direction of a law, for changes of speed by up to `dv`.
struct Limits {
  Long acceleration = 0;
  Long jerk = 0;
};
inline Limits limits_of(const RampLaw& law, Long dv) {
  const oracle::Shape shape = oracle::shape_of(law, dv);
  return {.acceleration = shape.acceleration, .jerk = shape.jerk};
}

struct State {
  Long position = 0, speed = 0, acceleration = 0;
};

inline State advance(const State& from, Long jerk, Long t) {
  return {.position = from.position + t * (from.speed + t * (from.acceleration / 2 + t * jerk / 6)),
          .speed = from.speed + t * (from.acceleration + t * jerk / 2),
          .acceleration = from.acceleration + t * jerk};
}

inline State begin_of(const Segment& segment) {
  return {
      .position = segment.position_u, .speed = segment.speed_u_s, .acceleration = segment.acceleration_u_s2};
}

inline Long segment_end_s(const Profile& profile, std::int32_t i) {
  return i + 1 < profile.segment_count ? profile.segments[static_cast<std::size_t>(i + 1)].begin_s
                                       : profile.duration_s;
}

inline Long greatest_speed(const Profile& profile) {
  Long speed = std::abs(profile.end_speed_u_s);
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    speed = std::max<Long>(speed, std::abs(profile.segments[static_cast<std::size_t>(i)].speed_u_s));
  }
  return speed;
}

/// Returns the largest distance from 0.
inline Long farthest(const Profile& profile) {
  Long far = profile.endless() ? 0 : std::abs(Long{profile.end_position_u});
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    far = std::max(far, std::abs(Long{profile.segments[static_cast<std::size_t>(i)].position_u}));
  }
  return far;
}

/// Returns +1, -1 or 0 if a segment increases the speed (in the direction of motion), decreases it, or
/// neither.
inline int sense_of(const Segment& segment) {
  const double change = segment.acceleration_u_s2 != 0 ? segment.acceleration_u_s2 : segment.jerk_u_s3;
  return change > 0 ? 1 : change < 0 ? -1 : 0;
}

/// Times are doubles counted from the profile's beginning, so every boundary between segments has an error of
/// up to a rounding error of the whole duration. The effect of that on speeds and accelerations is not a
/// fault; in moves of hours with ramps of milliseconds it exceeds rounding errors of the speeds themselves.
struct Blur {
  Long time_s = 0, speed = 0, acceleration = 0;
};
inline Blur blur_of(const Profile& profile) {
  Blur blur;
  if (profile.segment_count == 0) return blur;
  const auto last = static_cast<std::size_t>(profile.segment_count - 1);
  blur.time_s = 5e-16L * (profile.endless() ? profile.segments[last].begin_s : profile.duration_s);
  Long acceleration = 0;
  Long jerk = 0;
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    const Segment& segment = profile.segments[static_cast<std::size_t>(i)];
    const Long end_s = segment_end_s(profile, i);
    const Long duration_s = std::isinf(end_s) ? 0 : end_s - segment.begin_s;
    acceleration = std::max({acceleration, std::abs(Long{segment.acceleration_u_s2}),
                             std::abs(segment.acceleration_u_s2 + segment.jerk_u_s3 * duration_s)});
    jerk = std::max<Long>(jerk, std::abs(segment.jerk_u_s3));
  }
  blur.acceleration = jerk * blur.time_s;
  blur.speed = (acceleration + blur.acceleration) * blur.time_s;
  return blur;
}

/// Returns true if the motion reverses after segment `i`: it stops from the start speed, and returns at that
/// speed.
inline bool turns_after(const Profile& profile, std::int32_t i) {
  return i + 1 < profile.segment_count && profile.segments[static_cast<std::size_t>(i + 1)].speed_u_s < 0 &&
         profile.segments[static_cast<std::size_t>(i)].speed_u_s > 0;
}

/// Checks that the profile has no gaps in position and speed.
inline Fault gap_in(const Profile& profile, Long scale_u, Long scale_u_s = 0) {
  const Blur blur = blur_of(profile);
  scale_u_s = std::max(scale_u_s, greatest_speed(profile));
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    const Segment& segment = profile.segments[static_cast<std::size_t>(i)];
    const Long duration_s = segment_end_s(profile, i) - segment.begin_s;
    if (std::isinf(duration_s)) continue;
    if (!(duration_s >= 0)) return "segment " + std::to_string(i) + " ends before it begins";
    const State end = advance(begin_of(segment), segment.jerk_u_s3, duration_s);
    const bool last = i + 1 == profile.segment_count;
    const Segment& next = profile.segments[static_cast<std::size_t>(last ? i : i + 1)];
    const Long position = last ? profile.end_position_u : next.position_u;
    const Long speed = last ? profile.end_speed_u_s : next.speed_u_s;
    if (std::abs(end.position - position) > kGapTolerance * scale_u) {
      return "position has a gap of " + text(end.position - position) + " after segment " + std::to_string(i);
    }
    if (turns_after(profile, i)) continue;
    if (std::abs(end.speed - speed) > kGapTolerance * scale_u_s + blur.speed) {
      return "speed has a gap of " + text(end.speed - speed) + " after segment " + std::to_string(i);
    }
  }
  return {};
}

/// Checks a move from rest to rest, forwards: limits kept, and acceleration without gaps if the law has jerk.
/// `whole_ramps` means that no ramp was broken off.
inline Fault beyond_limits(const Profile& profile, const SpeedLaw& law, bool whole_ramps) {
  const Long start = oracle::start_of(law);
  const Long peak = greatest_speed(profile);
  if (peak > law.top_speed_u_s * (1 + kLimitTolerance)) return "speed is " + text(peak);
  const Limits down = limits_of(law.down, peak - start);
  Limits up = limits_of(law.up, peak - start);
  if (!whole_ramps) {  // it may be a part of a ramp to a higher speed
    const Limits whole = limits_of(law.up, law.top_speed_u_s - start);
    up = {std::max(up.acceleration, whole.acceleration), std::max(up.jerk, whole.jerk)};
  }
  const Blur blur = blur_of(profile);
  // A change of speed next to a large start speed has an error of a few rounding errors of the start speed.
  const Long rounding = 1e-15L * peak;
  State before{};
  bool is_known = true;  // `before` is the end of the last segment
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    const Segment& segment = profile.segments[static_cast<std::size_t>(i)];
    const int sense = sense_of(segment);
    const Limits& limits = sense < 0 ? down : up;
    const State begin = begin_of(segment);
    const Long duration_s = segment_end_s(profile, i) - segment.begin_s;
    const State end = advance(begin, segment.jerk_u_s3, duration_s);
    // A segment that is hardly longer than the uncertainty of times proves nothing.
    if (duration_s <= 1e4L * blur.time_s) {
      before = {};
      is_known = false;
      continue;
    }
    const Long slack = limits.acceleration * kLimitTolerance + rounding / duration_s + blur.acceleration;
    for (const State& state : {begin, end}) {
      if (state.speed < start - kGapTolerance * peak - blur.speed) return "speed is " + text(state.speed);
      if (state.acceleration * sense < -slack) return "acceleration turns in segment " + std::to_string(i);
      if (std::abs(state.acceleration) > limits.acceleration + slack) {
        return "acceleration is " + text(state.acceleration) + ", not " + text(limits.acceleration);
      }
    }
    if (std::abs(segment.jerk_u_s3) >
        limits.jerk * (1 + kLimitTolerance) + rounding / (duration_s * duration_s)) {
      return "jerk is " + text(segment.jerk_u_s3) + ", not " + text(limits.jerk);
    }
    const bool smooth = has_jerk(sense < 0 ? law.down : law.up) && whole_ramps && is_known;
    const Long jump = std::abs(begin.acceleration - before.acceleration);
    if (smooth && jump > slack + kGapTolerance * std::max(up.acceleration, down.acceleration)) {
      return "acceleration jumps by " + text(jump) + " before segment " + std::to_string(i);
    }
    before = has_jerk(sense < 0 ? law.down : law.up) ? end : State{};
    is_known = true;
  }
  return {};
}

/// Checks that the move stays at its target after its end.
inline Fault off_target(const Profile& profile, double target_u) {
  for (const double t_s : {profile.duration_s, profile.duration_s * 2 + 1}) {
    const Sample sample = profile.sample(t_s);
    if (sample.position_u != target_u || sample.speed_u_s != 0)
      return "it ends on " + text(sample.position_u);
  }
  return {};
}

/// Integrates only the jerk, by the Runge-Kutta method, from the beginning; acceleration jumps where a
/// segment has a jump. sample() must agree everywhere, and the end must be the target.
inline Fault differs_from_integral(const Profile& profile, double target_u, Long scale_u) {
  const Long tolerance_u = kLimitTolerance * scale_u + blur_of(profile).speed * profile.duration_s;
  const Long tolerance_u_s = kLimitTolerance * greatest_speed(profile) + 2 * blur_of(profile).speed;
  State state = begin_of(profile.segments[0]);
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    const Segment& segment = profile.segments[static_cast<std::size_t>(i)];
    constexpr int kSteps = 5;
    const Long step_s = (segment_end_s(profile, i) - segment.begin_s) / kSteps;
    state.acceleration = segment.acceleration_u_s2;
    if (i > 0 && turns_after(profile, i - 1)) state.speed = segment.speed_u_s;
    for (int n = 0; n < kSteps; ++n) {
      // d position = speed, d speed = acceleration, d acceleration = jerk.
      const auto slope = [&](const State& s) { return State{s.speed, s.acceleration, segment.jerk_u_s3}; };
      const auto moved = [&](const State& s, const State& by, Long t) {
        return State{s.position + t * by.position, s.speed + t * by.speed,
                     s.acceleration + t * by.acceleration};
      };
      const State k1 = slope(state);
      const State k2 = slope(moved(state, k1, step_s / 2));
      const State k3 = slope(moved(state, k2, step_s / 2));
      const State k4 = slope(moved(state, k3, step_s));
      state =
          moved(moved(moved(moved(state, k1, step_s / 6), k2, step_s / 3), k3, step_s / 3), k4, step_s / 6);
      const auto t_s = static_cast<double>(static_cast<Long>(segment.begin_s) + (n + 1) * step_s);
      if (t_s >= profile.duration_s || (n + 1 == kSteps && turns_after(profile, i))) break;
      const Sample sample = profile.sample(t_s);
      if (std::abs(sample.position_u - state.position) > tolerance_u) {
        return "is at " + text(sample.position_u) + ", not " + text(state.position);
      }
      if (std::abs(sample.speed_u_s - state.speed) > tolerance_u_s) {
        return "has speed " + text(sample.speed_u_s) + ", not " + text(state.speed);
      }
    }
  }
  if (std::abs(state.position - target_u) > tolerance_u) {
    return "integrates to " + text(state.position);
  }
  if (std::abs(state.speed - profile.end_speed_u_s) > tolerance_u_s) {
    return "integrates to speed " + text(state.speed);
  }
  return {};
}

}  // namespace understudy::motion
