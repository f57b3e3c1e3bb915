#include "motion/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace understudy::motion {

namespace {

Sample sample_segment(const Segment& s, double t) {
  const double half_jerk = 0.5 * s.jerk_pps3;
  return {
      .position_pulses = s.position_pulses + t * (s.speed_pps + t * (0.5 * s.acceleration_pps2 +
                                                                     t * (s.jerk_pps3 * (1.0 / 6.0)))),
      .speed_pps = s.speed_pps + t * (s.acceleration_pps2 + t * half_jerk),
      .acceleration_pps2 = s.acceleration_pps2 + t * s.jerk_pps3,
  };
}

}  // namespace

void Profile::append(double segment_duration_s, double start_speed_pps, double acceleration_pps2,
                     double jerk_pps3) {
  if (segment_duration_s <= 0) return;
  assert(segment_count < static_cast<std::int32_t>(segments.size()));
  double position_pulses = 0;
  if (segment_count > 0) {
    const Segment& last = segments[static_cast<std::size_t>(segment_count - 1)];
    position_pulses = sample_segment(last, last.duration_s).position_pulses;
  }
  segments[static_cast<std::size_t>(segment_count)] = {.duration_s = segment_duration_s,
                                                       .position_pulses = position_pulses,
                                                       .speed_pps = start_speed_pps,
                                                       .acceleration_pps2 = acceleration_pps2,
                                                       .jerk_pps3 = jerk_pps3};
  ++segment_count;
  duration_s += segment_duration_s;
}

Sample Profile::sample(double t_s) const {
  if (segment_count == 0 || t_s >= duration_s) {
    return {.position_pulses = static_cast<double>(distance_pulses)};
  }
  double t = std::max(t_s, 0.0);
  std::size_t i = 0;
  const auto last = static_cast<std::size_t>(segment_count - 1);
  while (i < last && t >= segments[i].duration_s) {
    t -= segments[i].duration_s;
    ++i;
  }
  return sample_segment(segments[i], t);
}

std::int64_t Profile::pulses_at(Tick elapsed) const {
  if (elapsed <= 0) return 0;
  const double t_s = static_cast<double>(elapsed) / 1000.0;
  if (t_s * 1000.0 >= duration_s * 1000.0 - kTickTolerance) return distance_pulses;
  const auto pulses = static_cast<std::int64_t>(
      std::floor(sample(t_s).position_pulses + pulse_tolerance(static_cast<double>(distance_pulses))));
  return std::clamp<std::int64_t>(pulses, 0, distance_pulses);
}

Tick Profile::end_tick() const { return static_cast<Tick>(std::ceil(duration_s * 1000.0 - kTickTolerance)); }

}  // namespace understudy::motion
