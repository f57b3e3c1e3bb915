#include "emulator/models/super_40nc/rows/settings.h"

#include <algorithm>
#include <cmath>

#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "motion/move.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::super_40nc {

namespace {

constexpr double kMaxSteps = 65535;
constexpr double kStepsAtOne = 300;  // the magnification is 300 / (PRMG + 1)

motion::RampLaw ramp_by(double slope_u_s2, double section_u_s) {
  return section_u_s > 0 ? motion::RampLaw::by_sections(slope_u_s2, section_u_s)
                         : motion::RampLaw::by_slope(slope_u_s2);
}

}  // namespace

double multiplier_of(double top_pps) {
  constexpr double kMin = 3;
  constexpr double kMax = 4096;
  return kStepsAtOne / std::clamp(std::floor(kStepsAtOne * kMaxSteps / top_pps), kMin, kMax);
}

motion::SpeedLaw law_by(double start_u_s, double top_u_s, double target_u_s, double up_ms, double down_ms,
                        double up_section_u_s, double down_section_u_s) {
  const auto slope = [&](double duration_ms) { return target_u_s * 1000.0 / duration_ms; };
  motion::SpeedLaw law{.start_speed_u_s = std::min(start_u_s, top_u_s),
                       .top_speed_u_s = top_u_s,
                       .up = ramp_by(slope(up_ms), up_section_u_s),
                       .down = ramp_by(slope(down_ms), down_section_u_s)};
  if (down_ms > 2 * up_ms) law.slow_down_reckoned_by = ramp_by(slope(2 * up_ms), down_section_u_s);
  return law;
}

double Settings::multiplier(int axis, double pps) const {
  return multiplier_of(readings_.multiplies_by_x12 ? top_pps(axis) : pps);
}

motion::SpeedLaw Settings::law(int axis, double rpm) const {
  const auto number = [&](StoredRegister kept) { return static_cast<double>(of(kept, axis)); };
  return law_with(axis, rpm,
                  {number(stored_x(d9x::kAccelerationTime)), number(stored_x(d9x::kDecelerationTime)),
                   number(stored_x(d9x::kSAcceleration)), number(stored_x(d9x::kSDeceleration))});
}

motion::SpeedLaw Settings::law_of_c(int axis, double rpm) const {
  const auto number = [&](StoredRegister kept) { return static_cast<double>(of(kept)); };
  return law_with(axis, rpm,
                  {number(stored_d(d9::kAccelerationTime)), number(stored_d(d9::kDecelerationTime)),
                   number(stored_d(d9::kSAcceleration)), number(stored_d(d9::kSDeceleration))});
}

motion::SpeedLaw Settings::law_with(int axis, double rpm, const Ramps& ramps) const {
  const auto start_rpm = static_cast<double>(of(stored_x(d9x::kBiasSpeed), axis));
  const double min_rpm = readings_.starts_as_fast ? start_rpm : 1.0;
  const double top = std::min(pps(axis, std::max(rpm, min_rpm)), top_pps(axis));
  const double step = multiplier(axis, top);
  return law_by(pps(axis, start_rpm), top, pps(axis, static_cast<double>(of(stored_d(d9::kTargetSpeed)))),
                ramps.up_ms, down_ms(ramps.down_ms, ramps.up_ms), ramps.up_steps * step,
                ramps.down_steps * step);
}

}  // namespace understudy::emulator::models::super_40nc
