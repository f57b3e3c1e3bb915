// RS-M8194H: the settings of an axis. The Initial Table contains the basic settings; all other settings have
// their power-up values until a command sets them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/state/fields.h"
#include "base/state/state_error.h"
#include "motion/axis.h"
#include "motion/homing.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

inline constexpr std::size_t kAxes = 4;
/// One bit per axis, X first.
using AxisMask = std::uint8_t;
inline constexpr AxisMask kAllAxes = 0xF;
constexpr bool has(AxisMask mask, std::size_t axis) { return (mask >> axis & 1) != 0; }
constexpr AxisMask mask_of(std::size_t axis) { return static_cast<AxisMask>(1U << axis); }

/// The settings of sections 3.3 to 3.16, with the factory values of section 8.
struct BasicSettings {
  std::uint8_t pulse_mode = 0;
  std::uint32_t max_v = 200'000;  // as sent
  std::uint8_t forward_limit_level = 0;
  std::uint8_t reverse_limit_level = 0;
  std::uint8_t limit_stop_mode = 0;  // 1: slows down
  std::uint8_t near_home_level = 0;
  std::uint8_t home_level = 0;
  bool soft_limits = false;
  std::int32_t forward_soft_limit = 0;
  std::int32_t reverse_soft_limit = 0;
  std::uint8_t soft_limit_source = 0;  // 0 LP, 1 EP
  std::uint8_t encoder_mode = 0;
  std::uint8_t encoder_division = 0;
  std::uint8_t index_level = 0;
  bool servo = false;
  bool alarm = false;
  std::uint8_t alarm_level = 0;
  bool in_position = false;
  std::uint8_t in_position_level = 0;
  std::uint8_t filtered = 0;  // FEn
  std::uint8_t filter_time = 0;
  bool ring = false;
  std::uint32_t ring_top = 0;
  bool avoids_triangles = false;  // AVTRI

  bool operator==(const BasicSettings&) const = default;
};

/// Rules about speeds that the manual leaves open (choices.h).
struct SpeedRules {
  bool rounds_to_nearest = false;
  bool has_offset = true;            // AO
  bool mode_3_is_symmetric = false;  // for NORMAL_SPEED, as printed
  double min_jerk_part = 0.0119211;  // the minimum jerk, as a fraction of MAX_V
};

/// Rules about an axis that the manual leaves open (choices.h).
struct AxisOptions {
  motion::Reaction at_soft_limit = motion::Reaction::slow_down;
  motion::Reaction at_alarm = motion::Reaction::stop_at_once;  // also for the EMG input
  bool drives_wait_for_in_position = true;
  bool in_position_waits_beside_limits = false;
  bool ring_folds = true;
  bool ring_takes_absolute = false;
  bool homing_obeys_soft_limits = true;
  bool comparisons_fire_when_armed = false;
};

/// The size of a speed count, and the minimum and maximum of other quantities, for a MAX_V (3.4, 7.1).
struct SpeedRange {
  SpeedRules rules = {};
  std::uint32_t max_v = 0;
  double step_pps = 0;
  double min_slope = 0;
  double max_slope = 0;
  double min_jerk = 0;
};
inline constexpr double kMaxJerk = 2e9;

inline SpeedRange speed_range(std::uint32_t max_v_as_sent, const SpeedRules& rules,
                              std::uint32_t highest = 4'000'000) {
  const std::uint32_t max_v = std::clamp<std::uint32_t>(max_v_as_sent, 8'000, highest);
  return {.rules = rules,
          .max_v = max_v,
          .step_pps = max_v / 8000.0,
          .min_slope = max_v / 64.0,
          .max_slope = max_v * 125.0,
          .min_jerk = max_v * rules.min_jerk_part};
}

/// The speed settings of an axis or of the path (7.1.1 to 7.1.8, 7.2.3 to 7.2.9), as sent. 0 means that the
/// value was never set; the axis then uses the minimum.
struct SpeedSettings {
  std::uint8_t mode = 0;  // NORMAL_SPEED; for the path, VECTOR_SPEED
  std::uint32_t start_pps = 0;
  std::uint32_t drive_pps = 0;
  std::uint32_t acceleration = 0;
  std::uint32_t deceleration = 0;
  std::uint32_t jerk_up = 0;
  std::uint32_t jerk_down = 0;
  std::int32_t offset_pulses = 8;  // AO

  bool operator==(const SpeedSettings&) const = default;
};

/// The shape of a drive's speed profile.
struct Shape {
  bool constant = false;  // no ramps
  bool s_curve = false;
  bool unlike_ramps = false;
};
/// The shapes for NORMAL_SPEED 0 to 3.
inline constexpr std::array<Shape, 4> kNormalShapes{
    {{}, {.s_curve = true}, {.unlike_ramps = true}, {.s_curve = true, .unlike_ramps = true}}};

/// Returns the law of a drive at `drive_pps`, with the ranges applied and speeds rounded to whole counts.
motion::SpeedLaw law_of(const SpeedSettings& speed, std::uint32_t drive_pps, const SpeedRange& range,
                        const Shape& shape, bool avoids_triangles);

/// The settings of sections 6.1 to 6.3.
struct HomeSettings {
  std::uint32_t home_pps = 0;  // HV
  bool limit_is_home = false;
  std::array<std::uint8_t, 4> steps{};  // 0 skipped, 1 positive, 2 negative
  std::uint32_t offset_pulses = 0;

  bool operator==(const HomeSettings&) const = default;
};

}  // namespace understudy::emulator::models::rs_m8194h

namespace understudy {

template <>
struct StateOf<emulator::models::rs_m8194h::BasicSettings> {
  using Value = emulator::models::rs_m8194h::BasicSettings;
  static constexpr auto fields = FieldList{field<&Value::pulse_mode>(),
                                           field<&Value::max_v>(),
                                           field<&Value::forward_limit_level>(),
                                           field<&Value::reverse_limit_level>(),
                                           field<&Value::limit_stop_mode>(),
                                           field<&Value::near_home_level>(),
                                           field<&Value::home_level>(),
                                           field<&Value::soft_limits>(),
                                           field<&Value::forward_soft_limit>(),
                                           field<&Value::reverse_soft_limit>(),
                                           field<&Value::soft_limit_source>(),
                                           field<&Value::encoder_mode>(),
                                           field<&Value::encoder_division>(),
                                           field<&Value::index_level>(),
                                           field<&Value::servo>(),
                                           field<&Value::alarm>(),
                                           field<&Value::alarm_level>(),
                                           field<&Value::in_position>(),
                                           field<&Value::in_position_level>(),
                                           field<&Value::filtered>(),
                                           field<&Value::filter_time>(),
                                           field<&Value::ring>(),
                                           field<&Value::ring_top>(),
                                           field<&Value::avoids_triangles>()};
  static void check(const Value& value) {
    constexpr std::uint32_t kMaxRing = 2'000'000'000;
    const bool fits = value.pulse_mode <= 5 && value.encoder_mode <= 3 && value.encoder_division <= 2 &&
                      value.filter_time <= 7 && value.ring_top <= kMaxRing && value.soft_limit_source <= 1;
    require_state(fits, "a setting is not in the manual");
  }
};

template <>
struct StateOf<emulator::models::rs_m8194h::SpeedSettings> {
  using Value = emulator::models::rs_m8194h::SpeedSettings;
  static constexpr auto fields =
      FieldList{field<&Value::mode>(),         field<&Value::start_pps>(),    field<&Value::drive_pps>(),
                field<&Value::acceleration>(), field<&Value::deceleration>(), field<&Value::jerk_up>(),
                field<&Value::jerk_down>(),    field<&Value::offset_pulses>()};
  static void check(const Value& value) {
    require_state(value.mode < 12, "a speed mode is not in the manual");
    require_state(value.offset_pulses >= INT16_MIN && value.offset_pulses <= INT16_MAX,
                  "a deceleration offset is outside the manual's range");
  }
};

template <>
struct StateOf<emulator::models::rs_m8194h::HomeSettings> {
  using Value = emulator::models::rs_m8194h::HomeSettings;
  static constexpr auto fields = FieldList{field<&Value::home_pps>(), field<&Value::limit_is_home>(),
                                           field<&Value::steps>(), field<&Value::offset_pulses>()};
  static void check(const Value& value) {
    constexpr std::uint32_t kMaxOffset = 2'000'000'000;
    require_state(value.offset_pulses <= kMaxOffset, "a homing offset is too large");
  }
};

}  // namespace understudy
