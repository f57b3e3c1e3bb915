// SUPER-40NC's settings as they are used: registers limited to their ranges, and the laws of speed that
// follow from them (《X6.》, 《X12./X13.》, 《C22.》, 《X2./X3.》, 《X4./X5.》).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/models/super_40nc/registers.h"
#include "motion/move.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

/// Of the outputs (《SUPER-40NC運動控制器簡介》, 6.55 Mpps): 65,535 steps of 100.
inline constexpr double kFastestPps = 6'553'500;

using Image = std::array<std::uint32_t, kSlotCount>;

/// D9000 on are the last of the image.
inline constexpr std::size_t kFirstParameterSlot = kept_d(9000).slot;
inline constexpr std::size_t kParameterCount = kSlotCount - kFirstParameterSlot;

/// Choices that numbers depend on.
struct Readings {
  bool multiplies_by_x12 = false;
  bool limits_deceleration = false;  // to twice the acceleration
  bool starts_as_fast = false;       // no speed is below X13
  bool truncates = false;            // lengths, to whole pulses
};

class Settings {
 public:
  /// `parameters`: D9 as they act; none: as they are stored.
  explicit Settings(const Image& image, Readings readings = {},
                    std::span<const std::uint32_t> parameters = {})
      : image_(image),
        parameters_(parameters.empty() ? std::span(image).subspan(kFirstParameterSlot) : parameters),
        readings_(readings) {}

  /// As it is stored; of parameters what acts.
  std::int32_t raw(Kept kept, int axis = 0) const {
    const std::size_t slot = kept.slot + static_cast<std::size_t>(axis);
    return static_cast<std::int32_t>(slot < kFirstParameterSlot ? image_[slot]
                                                                : parameters_[slot - kFirstParameterSlot]);
  }
  /// Limited as it is used.
  Value of(Kept kept, int axis = 0) const { return std::clamp<Value>(raw(kept, axis), kept.min, kept.max); }
  bool is_on(Kept kept, int axis = 0) const { return raw(kept, axis) != 0; }

  motion::UnitScale scale(int axis) const {
    return {.multiplier = of(kept_x(71), axis),
            .divider = of(kept_x(72), axis),
            .truncates = readings_.truncates};
  }
  double pps(int axis, double rpm) const { return rpm * static_cast<double>(of(kept_x(70), axis)) / 60.0; }
  /// No motion of the axis is faster.
  double top_pps(int axis) const {
    return std::min(pps(axis, static_cast<double>(of(kept_x(75), axis))), kFastestPps);
  }
  /// Of the chip's speeds, for a motion with that top speed.
  double multiplier(int axis, double pps) const;
  /// Of DRV, homing and all that is moved by hand. Below 1 rpm it is 1.
  motion::SpeedLaw law(int axis, double rpm) const;
  /// The same by the times and the S sections of C's paths (C11 to C14).
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

/// The chip counts a speed in steps of so many pps, the finest that reach up to it.
double multiplier_of(double top_pps);

/// Up to the top speed in `up_ms` from 0 to the speed that C22 gives, and down in `down_ms`, with rounded
/// ends of so many steps of the multiplier. A ramp down that lasts more than twice as long as the one up is
/// begun too late, and cut off at the target.
motion::SpeedLaw law_by(double start_u_s, double top_u_s, double target_u_s, double up_ms, double down_ms,
                        double up_section_u_s, double down_section_u_s);

}  // namespace understudy::emulator::models::super_40nc
