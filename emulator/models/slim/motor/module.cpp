#include "emulator/models/slim/motor/module.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/axis.h"
#include "motion/move.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::slim {

namespace {

/// Up to this value, a double can represent every pulse, and every sum of two such positions.
constexpr double kFarthest_pulses = 4'503'599'627'370'496.0;  // 2^52

/// No module is this fast. At a higher speed, a century of jogging would overflow the pulse count.
constexpr double kFastest_pps = 1e9;

double pulses_a_second(const ModuleSettings& settings, double rpm_or_rps) {
  const double rps = settings.speed_unit == SpeedUnit::rps ? rpm_or_rps : rpm_or_rps / 60;
  return std::min(rps * settings.pulses_per_revolution, kFastest_pps);
}

/// Returns PR2 as an acceleration, for the moves that use it instead of VA.
double path_slope(const ModuleSettings& settings) {
  constexpr double kSlowest_pps2 = 1e-8;  // the minimum of VA corresponds to this, and a ramp must end
  return std::clamp(settings.path_acceleration_units_s2 * settings.scale.pulses_per_unit(), kSlowest_pps2,
                    kFastest_pps);
}

motion::SpeedLaw trapezoid(const ModuleSettings& settings, double rpm_or_rps, const ChainOptions& options) {
  const double slope = options.chose(option("single_axis_profile", "trapezoid_with_tva"))
                           ? path_slope(settings)
                           : pulses_a_second(settings, settings.acceleration);
  const auto ramp = motion::RampLaw::by_slope(slope);
  return {.top_speed_u_s = pulses_a_second(settings, rpm_or_rps), .up = ramp, .down = ramp};
}

}  // namespace

std::int64_t Module::pulses_of(double units) const {
  // The order of calculation is the same as for coordinated motion, because both must result in the same
  // pulse.
  const double pulses =
      units * static_cast<double>(settings.scale.multiplier) / static_cast<double>(settings.scale.divider);
  return std::llround(pulses);
}

double Module::units_of(std::int64_t pulses) const {
  return static_cast<double>(pulses) * static_cast<double>(settings.scale.divider) /
         static_cast<double>(settings.scale.multiplier);
}

bool Module::reaches(double units) const {
  // The range limits of paths and pulses.
  constexpr double kFarthest_units = 1e12;
  return std::abs(units) <= kFarthest_units &&
         std::abs(units) * settings.scale.pulses_per_unit() <= kFarthest_pulses;
}

Activity Module::activity_or_held() const {
  if (activity != Activity::idle) return activity;
  if (held_thrust != 0) return Activity::thrust;
  if (held_jog_direction != 0) return Activity::jog;
  if (fifo.empty() || !fifo[0].begun) return Activity::idle;
  return fifo[0].kind == Job::Kind::home ? Activity::home : Activity::move;
}

bool Module::servo_expected(const motion::Axis& axis) const {
  for (std::size_t i = fifo.size(); i-- > 0;) {
    if (fifo[i].kind == Job::Kind::servo) return fifo[i].servo_on;
  }
  return axis.servo_on;
}

double Module::end_expected(int number, const motion::Axis& axis) const {
  for (std::size_t i = fifo.size(); i-- > 0;) {
    const Job& job = fifo[i];
    if (!job.moves() && job.kind != Job::Kind::set_coordinate) continue;
    return job.ends[static_cast<std::size_t>(job.letter_of(number))];
  }
  return activity == Activity::idle ? place_units : coordinate(axis);
}

double Module::analog_factor() const {
  return analog_speed ? static_cast<double>(analog) / kFullAnalog : 1.0;
}

motion::SpeedLaw Module::working_law(const ChainOptions& options) const {
  return trapezoid(settings, settings.working_speed * analog_factor(), options);
}

motion::SpeedLaw Module::jog_law(const ChainOptions& options) const {
  return trapezoid(settings,
                   std::abs(settings.jog_speed) *
                       (options.chose(option("analog_speed_of", "moves")) ? 1 : analog_factor()),
                   options);
}

}  // namespace understudy::emulator::models::slim
