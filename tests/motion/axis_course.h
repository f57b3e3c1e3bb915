// An axis during a motion: stepped tick by tick, with all its pulses and events.
#pragma once

#include <cstdint>

#include "motion/axis.h"

namespace understudy::motion {

/// Returns a trapezoid with `slope_pps2` up and down.
inline SpeedLaw trapezoid(double top_pps, double slope_pps2) {
  return {
      .top_speed_u_s = top_pps, .up = RampLaw::by_slope(slope_pps2), .down = RampLaw::by_slope(slope_pps2)};
}

/// Returns a law with the constant speed `pps` from the first moment to the last.
inline SpeedLaw constant(double pps) {
  SpeedLaw law = trapezoid(pps, 1e6);
  law.start_speed_u_s = pps;
  return law;
}

struct AxisCourse {
  Axis axis;
  Environment environment;
  Tick now = 0;
  std::int64_t output_pulses = 0;  // all pulses sent, signed
  std::int64_t farthest = 0;       // the largest and the smallest travel at any tick
  std::int64_t nearest = 0;
  Events seen = 0;
  int endings = 0;

  AxisCourse() { axis.switch_servo(true); }

  std::int64_t note(std::int64_t pulses) {
    output_pulses += pulses;
    farthest = std::max(farthest, axis.travel_pulses);
    nearest = std::min(nearest, axis.travel_pulses);
    seen |= axis.events;
    endings += (axis.events & bit(Event::ended)) != 0 ? 1 : 0;
    return pulses;
  }

  std::int64_t step() {
    ++now;
    return note(axis.step(now, environment));
  }
  std::int64_t carry(std::int64_t pulses) {
    ++now;
    return note(axis.carry(pulses, now, environment));
  }
  std::int64_t steps(Tick ticks) {
    std::int64_t sent = 0;
    for (Tick tick = 0; tick < ticks; ++tick) sent += step();
    return sent;
  }
  /// Runs until the axis is at rest. Returns the number of ticks, or -1 if it still moves after `at_most`.
  Tick until_rest(Tick at_most = 1'000'000) {
    for (Tick ticks = 0; ticks <= at_most; ++ticks) {
      if (!axis.moving()) return ticks;
      step();
    }
    return -1;
  }
  /// Returns true if the event has occurred.
  bool saw(Event event) const { return (seen & bit(event)) != 0; }

  std::int64_t travel() const { return axis.travel_pulses; }
};

}  // namespace understudy::motion
