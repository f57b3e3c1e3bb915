// SUPER-40NC's settings in the form in which they are used: registers limited to their ranges, and the
// resulting speed laws (《X6.》, 《X12./X13.》, 《C22.》, 《X2./X3.》, 《X4./X5.》).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "motion/move.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

/// The maximum pulse rate of the outputs (《SUPER-40NC運動控制器簡介》, 6.55 Mpps): 65,535 steps of 100.
inline constexpr double kFastestPps = 6'553'500;

using Image = std::array<std::uint32_t, kSlotCount>;

/// The registers from D9000 on are the last ones in the image.
inline constexpr std::size_t kFirstParameterSlot = stored_d(d9::kStation).slot;
inline constexpr std::size_t kParameterCount = kSlotCount - kFirstParameterSlot;

/// The choices that affect numeric values.
struct Readings {
  bool multiplies_by_x12 = false;
  bool limits_deceleration = false;  // to twice the acceleration
  bool starts_as_fast = false;       // no speed is below X13
  bool truncates = false;            // lengths are truncated to whole pulses, not rounded
};

class Settings {
 public:
  /// `parameters` are the D9 values in effect. If it is empty, the stored values apply.
  explicit Settings(const Image& image, Readings readings = {},
                    std::span<const std::uint32_t> parameters = {})
      : image_(image),
        parameters_(parameters.empty() ? std::span(image).subspan(kFirstParameterSlot) : parameters),
        readings_(readings) {}

  /// Returns the stored value or, for a parameter, the value in effect.
  std::int32_t raw(StoredRegister kept, int axis = 0) const {
    const std::size_t slot = kept.slot + static_cast<std::size_t>(axis);
    return static_cast<std::int32_t>(slot < kFirstParameterSlot ? image_[slot]
                                                                : parameters_[slot - kFirstParameterSlot]);
  }
  /// Returns the value limited to its range, for use by motion.
  Value of(StoredRegister kept, int axis = 0) const {
    return std::clamp<Value>(raw(kept, axis), kept.min, kept.max);
  }
  bool is_on(StoredRegister kept, int axis = 0) const { return raw(kept, axis) != 0; }

  motion::UnitScale scale(int axis) const {
    return {.multiplier = of(stored_x(d9x::kCmx), axis),
            .divider = of(stored_x(d9x::kCdv), axis),
            .truncates = readings_.truncates};
  }
  double pps(int axis, double rpm) const {
    return rpm * static_cast<double>(of(stored_x(d9x::kPpr), axis)) / 60.0;
  }
  /// Returns the maximum speed of the axis in any motion.
  double top_pps(int axis) const {
    return std::min(pps(axis, static_cast<double>(of(stored_x(d9x::kMaxSpeed), axis))), kFastestPps);
  }
  /// Returns the chip's speed multiplier for a motion with the top speed `pps`.
  double multiplier(int axis, double pps) const;
  /// Returns the speed law of DRV, homing and all motions by hand. A speed below 1 rpm counts as 1 rpm.
  motion::SpeedLaw law(int axis, double rpm) const;
  /// Like law(), but with the times and S sections for C's paths (C11 to C14).
  motion::SpeedLaw law_of_c(int axis, double rpm) const;
  double down_ms(double down_ms, double up_ms) const {
    return readings_.limits_deceleration ? std::min(down_ms, 2 * up_ms) : down_ms;
  }

 private:
  struct Ramps {
    double up_ms, down_ms;
    double up_steps, down_steps;  // S sections, in steps of the multiplier
  };
  motion::SpeedLaw law_with(int axis, double rpm, const Ramps& ramps) const;

  const Image& image_;
  std::span<const std::uint32_t> parameters_;
  Readings readings_;
};

/// Returns the pps per step of the chip's speed: the smallest step with which `top_pps` can be reached.
double multiplier_of(double top_pps);

/// Returns a law with S sections at the ends of its ramps, up to its own top speed. It would accelerate from
/// 0 to the speed of C22 in `up_ms`, and decelerate in `down_ms`. If `down_ms` is more than twice `up_ms`,
/// the deceleration begins too late and is cut off at the target.
motion::SpeedLaw law_by(double start_u_s, double top_u_s, double target_u_s, double up_ms, double down_ms,
                        double up_section_u_s, double down_section_u_s);

}  // namespace understudy::emulator::models::super_40nc
