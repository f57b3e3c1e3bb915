// Another implementation of the laws of moves, in long double, from the chips' formulas, for comparison with
// plan().
//
//   slope     T = dv / a                     time      T given
//   jerk      T = 2 sqrt(dv / K), with a bound A: dv / A + A / K once A is reached (dv > A^2 / K)
//   sections  T = (dv + 2 S) / a, and 2 dv / a when 2 S >= dv
//
// Every ramp covers the mean of its two speeds times its duration. Peaks are found by bisection, which needs
// no algebra.
#pragma once

#include <algorithm>
#include <cmath>

#include "motion/move.h"

namespace understudy::motion::oracle {

using Long = long double;

/// A ramp's shape: jerk for `end_s`, none for `middle_s`, the opposite jerk for `end_s`.
struct Shape {
  Long end_s = 0, middle_s = 0, acceleration = 0, jerk = 0;
  Long duration_s() const { return 2 * end_s + middle_s; }
};

inline Shape shape_of(const RampLaw& law, Long dv) {
  if (!(dv > 0)) return {};
  const Long a = law.acceleration_u_s2;
  const Long k = law.jerk_u_s3;
  switch (law.kind) {
    case RampLaw::Kind::slope: return {0, dv / a, a, 0};
    case RampLaw::Kind::time: return {0, law.duration_s, dv / law.duration_s, 0};
    case RampLaw::Kind::jerk:
      if (std::isinf(a) || dv * k <= a * a) return {std::sqrt(dv / k), 0, std::sqrt(dv * k), k};
      return {a / k, dv / a - a / k, a, k};
    case RampLaw::Kind::sections: {
      const Long s = std::min<Long>(law.section_u_s, dv / 2);
      if (s == 0) return {0, dv / a, a, 0};
      return {2 * s / a, (dv - 2 * s) / a, a, a * a / (2 * s)};
    }
  }
  return {};
}

inline Long ramp_distance(const RampLaw& law, Long low, Long high) {
  return (low + high) / 2 * shape_of(law, high - low).duration_s();
}

struct Place {
  Long position = 0, speed = 0;
};

/// Returns the state on a ramp up from `low` by `dv`, `t` after its beginning. A ramp down is its mirror
/// image.
inline Place on_ramp(const RampLaw& law, Long low, Long dv, Long t) {
  const Shape shape = shape_of(law, dv);
  const Long whole_s = shape.duration_s();
  if (t >= whole_s) return {(2 * low + dv) / 2 * whole_s, low + dv};
  if (t <= shape.end_s) return {low * t + shape.jerk * t * t * t / 6, low + shape.jerk * t * t / 2};
  if (t <= shape.end_s + shape.middle_s) {
    const Long m = t - shape.end_s;
    const Place in = on_ramp(law, low, dv, shape.end_s);
    const Long speed = shape.end_s > 0 ? in.speed : low;
    return {in.position + speed * m + shape.acceleration * m * m / 2, speed + shape.acceleration * m};
  }
  const Long before_end = whole_s - t;
  const Long high = low + dv;
  const Long missing = shape.jerk * before_end * before_end / 2;
  return {
      (low + high) / 2 * whole_s - high * before_end + shape.jerk * before_end * before_end * before_end / 6,
      high - missing};
}

/// Returns the largest x in [low, high] for which `fits` is still true; it is true for `low`.
template <class Fits>
Long greatest(Long low, Long high, const Fits& fits) {
  if (fits(high)) return high;
  // Searches first for the power of two, then for the last bit, because numbers range from 1e-12 to 1e12.
  const Long origin = low;
  while (high - origin > 1e-300L && !fits(origin + (high - origin) / 2)) high = origin + (high - origin) / 2;
  low = origin + (high - origin) / 2;
  if (!fits(low)) low = origin;
  for (int halving = 0; halving < 70; ++halving) {
    const Long middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) break;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

struct Expected {
  Long peak = 0;
  Long duration_s = 0;
  Long end_speed = 0;
};

inline Long start_of(const SpeedLaw& law) { return std::min(law.start_speed_u_s, law.top_speed_u_s); }

/// Returns the distance that remains when deceleration begins.
inline Long slow_down_distance(const SpeedLaw& law, Long speed) {
  const Long start = start_of(law);
  const RampLaw& by = law.slow_down_reckoned_by ? *law.slow_down_reckoned_by : law.down;
  const Long reckoned = law.slow_down_at_u ? *law.slow_down_at_u : ramp_distance(by, start, speed);
  return reckoned + law.slow_down_offset_u;
}

inline Expected move_of(double distance_u, const SpeedLaw& law) {
  const Long distance = distance_u;
  const Long start = start_of(law);
  const Long top = law.top_speed_u_s;
  Expected expected{.peak = start};
  Long rise_s = 0;
  Long risen = 0;
  Long rise_to = top;  // the top of the ramp with which the move starts, whole or broken off
  if (law.slow_down_at_u || law.when_short == Short::cut_ramp) {
    rise_s = greatest(0, shape_of(law.up, top - start).duration_s(), [&](Long t) {
      const Place here = on_ramp(law.up, start, top - start, t);
      return here.position + slow_down_distance(law, here.speed) <= distance;
    });
    const Place here = on_ramp(law.up, start, top - start, rise_s);
    expected.peak = here.speed;
    risen = here.position;
  } else {
    const Long room = (distance - law.slow_down_offset_u) / (law.when_short == Short::keep_half ? 2 : 1);
    const RampLaw& by = law.slow_down_reckoned_by ? *law.slow_down_reckoned_by : law.down;
    rise_to = greatest(start, top, [&](Long peak) {
      return ramp_distance(law.up, start, peak) + ramp_distance(by, start, peak) <= room || peak == start;
    });
    expected.peak = rise_to;
    rise_s = shape_of(law.up, rise_to - start).duration_s();
    risen = ramp_distance(law.up, start, rise_to);
  }
  if (risen > distance) {  // cut off before deceleration has started
    expected.duration_s = greatest(
        0, rise_s, [&](Long t) { return on_ramp(law.up, start, rise_to - start, t).position <= distance; });
    expected.end_speed = on_ramp(law.up, start, rise_to - start, expected.duration_s).speed;
    expected.peak = expected.end_speed;
    return expected;
  }
  const Long cruise =
      std::clamp<Long>(distance - risen - slow_down_distance(law, expected.peak), 0, distance - risen);
  const Long before_s = rise_s + (cruise > 0 ? cruise / expected.peak : 0);
  const Long left = distance - risen - cruise;
  const Shape down = shape_of(law.down, expected.peak - start);
  const Long down_u = ramp_distance(law.down, start, expected.peak);
  expected.duration_s = before_s + down.duration_s();
  expected.end_speed = start;
  const bool rounding_only = std::abs(left - down_u) <= 1e-15L * distance;
  if (rounding_only) return expected;
  if (left > down_u) {
    if (start > 0) expected.duration_s += (left - down_u) / start;
    return expected;
  }
  // Cut off: this much of the end of the mirror image is missing.
  const Long missing_s = greatest(0, down.duration_s(), [&](Long t) {
    return on_ramp(law.down, start, expected.peak - start, t).position <= down_u - left;
  });
  expected.duration_s -= missing_s;
  expected.end_speed = on_ramp(law.down, start, expected.peak - start, missing_s).speed;
  return expected;
}

}  // namespace understudy::motion::oracle
