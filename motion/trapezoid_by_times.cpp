#include "motion/trapezoid_by_times.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace understudy::motion {

namespace {

void demand_positive(double value, const char* quantity) {
  if (!std::isfinite(value) || value <= 0) {
    throw std::invalid_argument(std::string("trapezoid by times: ") + quantity +
                                " must be finite and above 0");
  }
}

}  // namespace

Profile plan(const TrapezoidByTimes& move) {
  if (move.distance_pulses < 0) throw std::invalid_argument("trapezoid by times: distance is negative");
  demand_positive(move.top_speed_pps, "top speed");
  demand_positive(move.acceleration_time_s, "acceleration time");
  demand_positive(move.deceleration_time_s, "deceleration time");

  Profile profile;
  if (move.distance_pulses == 0) return profile;

  const auto distance = static_cast<double>(move.distance_pulses);
  const double ramps_s = move.acceleration_time_s + move.deceleration_time_s;
  double top_pps = 2.0 * distance / ramps_s;
  double cruise_s = 0;
  if (top_pps >= move.top_speed_pps) {
    top_pps = move.top_speed_pps;
    cruise_s = distance / top_pps - ramps_s / 2.0;
  }
  profile.distance_pulses = move.distance_pulses;
  profile.append(move.acceleration_time_s, 0, top_pps / move.acceleration_time_s, 0);
  profile.append(cruise_s, top_pps, 0, 0);
  profile.append(move.deceleration_time_s, top_pps, -top_pps / move.deceleration_time_s, 0);
  return profile;
}

}  // namespace understudy::motion
