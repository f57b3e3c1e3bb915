#include "emulator/models/rs_m8194h/chip/axis_unit.h"

#include <cstddef>
#include <cstdint>
#include <iterator>

#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "motion/axis.h"
#include "motion/counter.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

using motion::Comparator;
using motion::Counter;

/// Lets a counter wrap in its ring again, after a count from outside the ring has entered the ring.
void enter_ring(Counter& counter, const BasicSettings& settings, std::int64_t travel, std::int64_t came) {
  if (!settings.ring || counter.range == Counter::Range::ring) return;
  const std::int64_t count = counter.at(travel);
  const std::int64_t before = count - came;
  const bool has_entered = (count >= 0 && count <= settings.ring_top) ||
                           (before < 0 && count > settings.ring_top) ||
                           (before > settings.ring_top && count < 0);
  if (has_entered) set_count(counter, settings, count, travel, true);
}

/// Changes the range of a counter without changing its count.
void set_range(Counter& counter, const BasicSettings& settings, std::int64_t travel, bool ring_folds) {
  const std::int64_t count = counter.at(travel);
  counter.ring_top = settings.ring ? settings.ring_top : 0;
  set_count(counter, settings, count, travel, ring_folds);
}

motion::Reaction limit_reaction(const BasicSettings& basic) {
  return basic.limit_stop_mode == 1 ? motion::Reaction::slow_down : motion::Reaction::stop_at_once;
}

/// Returns how many edges make up one count (3.10): the chip counts all edges of both lines, all edges of one
/// line, or only rising edges. Up and down pulses are not divided.
std::int64_t divider_of(const BasicSettings& basic) {
  const bool is_quadrature = basic.encoder_mode == 0 || basic.encoder_mode == 2;
  return is_quadrature ? std::int64_t{1} << basic.encoder_division : 1;
}
bool counts_down(const BasicSettings& basic) { return basic.encoder_mode >= 2; }

std::int64_t divided(const BasicSettings& basic, std::int64_t edges) {
  const std::int64_t by = divider_of(basic);
  const std::int64_t counts = edges >= 0 ? edges / by : -((-edges + by - 1) / by);
  return counts_down(basic) ? -counts : counts;
}

}  // namespace

void set_count(motion::Counter& counter, const BasicSettings& settings, std::int64_t count,
               std::int64_t travel, bool ring_folds) {
  const bool is_within = count >= 0 && count <= settings.ring_top;
  const bool is_ring = settings.ring && (ring_folds || is_within);
  counter.range = is_ring ? motion::Counter::Range::ring : motion::Counter::Range::bits32;
  counter.set(count, travel);
}

std::int64_t encoder_travel(const AxisUnit& axis, const motion::Axis& motor) {
  return axis.has_encoder ? motor.encoder_pulses : motor.travel_pulses;
}

SpeedRange range_of(const AxisUnit& axis, const SpeedRules& rules) {
  return speed_range(axis.basic.max_v, rules);
}

motion::SpeedLaw law_at(const AxisUnit& axis, std::uint32_t drive_pps, const SpeedRules& rules) {
  const bool is_like_1 = axis.speed.mode == 3 && rules.mode_3_is_symmetric;
  const Shape& shape = kNormalShapes[is_like_1 ? 1 : axis.speed.mode];
  return law_of(axis.speed, drive_pps, range_of(axis, rules), shape, axis.basic.avoids_triangles);
}

motion::SpeedLaw law_of(const AxisUnit& axis, const SpeedRules& rules) {
  return law_at(axis, axis.speed.drive_pps, rules);
}

std::int32_t logic_count(const AxisUnit& axis, const motion::Axis& motor) {
  return static_cast<std::int32_t>(axis.logic.at(motor.travel_pulses));
}

std::int32_t absolute_count(const AxisUnit& axis, const motion::Axis& motor) {
  return static_cast<std::int32_t>(axis.absolute.at(motor.travel_pulses));
}

std::int32_t encoder_count(const AxisUnit& axis, const motion::Axis& motor) {
  return static_cast<std::int32_t>(axis.encoder.at(encoder_travel(axis, motor)));
}

void set_logic_position(AxisUnit& axis, motion::Axis& motor, std::int32_t value, bool ring_folds) {
  set_count(axis.logic, axis.basic, value, motor.travel_pulses, ring_folds);
}

void set_absolute_position(AxisUnit& axis, motion::Axis& motor, std::int32_t value, bool /*ring_folds*/) {
  axis.absolute.set(value, motor.travel_pulses);
}

void set_encoder_position(AxisUnit& axis, motion::Axis& motor, std::int32_t value, bool ring_folds) {
  set_count(axis.encoder, axis.basic, value, encoder_travel(axis, motor), ring_folds);
}

bool is_beyond_ring(const AxisUnit& axis) {
  return axis.basic.ring &&
         (axis.logic.range != Counter::Range::ring || axis.encoder.range != Counter::Range::ring);
}

void enter_ring(AxisUnit& axis, const motion::Axis& motor) {
  const std::int64_t sent = axis.sent_pulses;
  enter_ring(axis.logic, axis.basic, motor.travel_pulses, sent);
  enter_ring(axis.encoder, axis.basic, encoder_travel(axis, motor), axis.has_encoder ? 0 : sent);
}

void set_external_levels(AxisUnit& axis) {
  axis.external.plus_high = (axis.external_seen[0] & 1U) == 0;
  axis.external.minus_high = (axis.external_seen[1] & 1U) == 0;
}

void update_encoder(AxisUnit& axis, motion::Axis& motor, std::int64_t raw_count) {
  if (!axis.has_encoder) {
    // The encoder continues at the count that the pulses have reached.
    const std::int32_t count = encoder_count(axis, motor);
    axis.has_encoder = true;
    axis.encoder_zero = axis.encoder_raw;
    motor.set_encoder(0);
    motor.encoder_seen = motor.encoder_pulses;
    axis.encoder.set(count, motor.encoder_pulses);
  }
  axis.encoder_raw = raw_count;
  motor.set_encoder(divided(axis.basic, raw_count - axis.encoder_zero));
}

void apply_basic(AxisUnit& axis, motion::Axis& motor, const BasicSettings& settings,
                 const AxisOptions& options) {
  const BasicSettings before = axis.basic;
  axis.basic = settings;
  motion::AxisSettings changed = motor.settings;
  changed.at_limit_plus = changed.at_limit_minus = limit_reaction(settings);
  changed.at_soft_limit = options.at_soft_limit;
  changed.at_alarm = changed.at_emergency = options.at_alarm;
  changed.needs_servo = false;
  changed.waits_for_in_position = settings.in_position && options.drives_wait_for_in_position;
  changed.waits_beside_limits = options.in_position_waits_beside_limits;
  motor.set(changed);
  if (before.ring != settings.ring || before.ring_top != settings.ring_top) {
    set_range(axis.logic, settings, motor.travel_pulses, options.ring_folds);
    set_range(axis.encoder, settings, encoder_travel(axis, motor), options.ring_folds);
    if (options.ring_takes_absolute) {
      set_range(axis.absolute, settings, motor.travel_pulses, true);
    }
  }
  const bool counts_otherwise =
      before.encoder_mode != settings.encoder_mode || before.encoder_division != settings.encoder_division;
  if (axis.has_encoder && counts_otherwise) {
    // The new setting applies from here on; the present count does not change.
    const std::int32_t count = encoder_count(axis, motor);
    axis.encoder_zero = axis.encoder_raw;
    motor.set_encoder(0);
    motor.encoder_seen = motor.encoder_pulses;
    axis.encoder.set(count, motor.encoder_pulses);
  }
}

void arm(const AxisUnit& axis, motion::Axis& motor, motion::Events asked, const AxisOptions& options) {
  struct Comparison {
    motion::Event event;
    std::size_t which;  // C+, C-
    Comparator::Relation relation;
  };
  static constexpr Comparison kComparisons[] = {
      {motion::Event::comparator_0, 0, Comparator::Relation::at_least},
      {motion::Event::comparator_1, 0, Comparator::Relation::below},
      {motion::Event::comparator_2, 1, Comparator::Relation::below},
      {motion::Event::comparator_3, 1, Comparator::Relation::at_least},
  };
  for (const Comparison& each : kComparisons) {
    const Compare& mine = axis.compare[each.which];
    Comparator wanted;
    if ((asked & motion::bit(each.event)) != 0) {
      wanted.relation = each.relation;
      wanted.value = mine.value;
      wanted.counter = mine.source == 0 ? axis.logic : axis.encoder;
      const bool by_pulses = mine.source == 0 || !axis.has_encoder;
      wanted.count = by_pulses ? motion::Count::command : motion::Count::encoder;
    }
    const auto number = static_cast<std::size_t>(each.event);
    wanted.was_true = motor.comparators[number].was_true;
    if (wanted == motor.comparators[number]) continue;
    const bool is_new = motor.comparators[number].relation == Comparator::Relation::off;
    motor.set_comparator(number, wanted);
    if (is_new && options.comparisons_fire_when_armed) motor.comparators[number].was_true = false;
  }
  motion::AxisSettings changed = motor.settings;
  constexpr motion::Events kCostly = motion::bit(motion::Event::pulse) |
                                     motion::bit(motion::Event::constant_started) |
                                     motion::bit(motion::Event::constant_ended);
  changed.raises = asked & kCostly;
  changed.soft_limit_plus.reset();
  changed.soft_limit_minus.reset();
  const bool by_encoder = axis.basic.soft_limit_source == 1 && axis.has_encoder;
  const bool applies = options.homing_obeys_soft_limits || !motor.homing.active();
  if (axis.basic.soft_limits && applies) {
    const Counter& counter = axis.basic.soft_limit_source == 0 ? axis.logic : axis.encoder;
    // Use the present difference between count and position, because the offset itself may differ by whole
    // turns of the counter.
    const std::int64_t place = by_encoder ? motor.encoder_pulses : motor.travel_pulses;
    const std::int64_t ahead = place - counter.at(place);
    changed.soft_limits_of = by_encoder ? motion::Count::encoder : motion::Count::command;
    changed.soft_limit_plus = axis.basic.forward_soft_limit + ahead;
    changed.soft_limit_minus = axis.basic.reverse_soft_limit + ahead;
  }
  if (changed != motor.settings) motor.set(changed);
}

motion::EncoderLine encoder_line(const AxisUnit& axis, motion::EncoderLine machine) {
  if (!axis.has_encoder) return {};
  machine.zero = axis.encoder_zero;
  machine.divider = divider_of(axis.basic);
  machine.turned = counts_down(axis.basic);
  return machine;
}

std::uint16_t di_all_word(const AxisUnit& axis, bool emergency_is_on, bool is_driving, UpperBits upper) {
  const auto is_on = [&](Pin pin) { return (axis.pins.passed & bit_of(pin)) != 0; };
  const BasicSettings& basic = axis.basic;
  // There is no setting for the active level of IN3.
  const auto upper_bit = [&](Pin pin, std::uint8_t level_setting) {
    return upper == UpperBits::line_levels ? !is_on(pin) : is_active(is_on(pin), level_setting);
  };
  const bool bits[] = {
      is_driving,
      is_active(is_on(Pin::limit_plus), basic.forward_limit_level),
      is_active(is_on(Pin::limit_minus), basic.reverse_limit_level),
      emergency_is_on,
      basic.alarm && is_active(is_on(Pin::alarm), basic.alarm_level),
      upper_bit(Pin::home, basic.home_level),
      upper_bit(Pin::near_home, basic.near_home_level),
      upper_bit(Pin::in3, 0),
      upper_bit(Pin::in_position, basic.in_position_level),
      upper_bit(Pin::index, basic.index_level),
  };
  std::uint16_t word = 0;
  for (std::size_t i = 0; i < std::size(bits); ++i) word |= static_cast<std::uint16_t>(bits[i] ? 1U << i : 0);
  return word;
}

std::uint16_t di_signal_word(const AxisUnit& axis) {
  const auto is_on = [&](Pin pin) { return (axis.pins.passed & bit_of(pin)) != 0; };
  // IN0 to IN3 are 0 while on, the other bits are 1 while on (12.5.4).
  const bool bits[] = {!is_on(Pin::near_home),  !is_on(Pin::home),         !is_on(Pin::index),
                       !is_on(Pin::in3),        is_on(Pin::external_plus), is_on(Pin::external_minus),
                       is_on(Pin::in_position), is_on(Pin::alarm)};
  std::uint16_t word = 0;
  for (std::size_t i = 0; i < std::size(bits); ++i) word |= static_cast<std::uint16_t>(bits[i] ? 1U << i : 0);
  return word;
}

}  // namespace understudy::emulator::models::rs_m8194h
