#include "emulator/models/rs_m8194h/rows/axis_settings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "motion/move.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// Returns a speed in whole counts of MAX_V / 8000, at least one.
double in_counts(std::uint32_t speed_pps, const SpeedRange& range) {
  const double within = std::min<double>(speed_pps, range.max_v);
  const double counts = within / range.step_pps;
  return std::max(1.0, std::floor(range.rules.rounds_to_nearest ? counts + 0.5 : counts)) * range.step_pps;
}

}  // namespace

motion::SpeedLaw law_of(const SpeedSettings& speed, std::uint32_t drive_pps, const SpeedRange& range,
                        const Shape& shape, bool avoids_triangles) {
  const auto slope = [&](std::uint32_t given) {
    return motion::RampLaw::by_slope(std::clamp<double>(given, range.min_slope, range.max_slope));
  };
  const auto jerk = [&](std::uint32_t given) {
    return motion::RampLaw::by_jerk(std::clamp<double>(given, range.min_jerk, kMaxJerk));
  };
  motion::SpeedLaw law;
  law.top_speed_u_s = in_counts(drive_pps, range);
  law.start_speed_u_s = shape.constant ? law.top_speed_u_s : in_counts(speed.start_pps, range);
  law.start_speed_u_s = std::min(law.start_speed_u_s, law.top_speed_u_s);
  if (shape.s_curve) {
    law.up = jerk(speed.jerk_up);
    law.down = shape.unlike_ramps ? jerk(speed.jerk_down) : law.up;
  } else {
    law.up = slope(speed.acceleration);
    law.down = shape.unlike_ramps ? slope(speed.deceleration) : law.up;
    if (avoids_triangles) law.when_short = motion::Short::keep_half;
  }
  if (!shape.constant && range.rules.has_offset) law.slow_down_offset_u = speed.offset_pulses;
  return law;
}

}  // namespace understudy::emulator::models::rs_m8194h
