#include "emulator/models/super_40nc/axis/axis_parameters.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/comparator_rows.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/error.h"
#include "motion/axis.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

motion::AxisSettings AxisParameters::motor_settings(int axis, bool homes) const {
  const Settings settings = registers();
  const auto reaction = [&](StoredRegister kept) {
    return settings.is_on(kept, axis) ? motion::Reaction::slow_down : motion::Reaction::stop_at_once;
  };
  motion::AxisSettings made = chip(axis).settings;
  made.needs_servo = false;
  made.at_limit_plus = made.at_limit_minus = reaction(stored_x(d9x::kOtStop));
  made.at_alarm = reaction(stored_x(d9x::kAlmStop));
  made.soft_limit_plus = made.soft_limit_minus = std::nullopt;
  if (homes && chose(option("home_soft_limits", "ignored"))) return made;
  const std::int64_t counter_lead = machine_pulses(axis) - chip(axis).travel_pulses;
  struct Side {
    StoredRegister source, method, action, value;
    std::optional<std::int64_t> motion::AxisSettings::*limit;
  };
  static constexpr Side kSides[] = {
      {stored_x(d9x::kCp1Source), stored_x(d9x::kCp1Method), stored_x(d9x::kCp1Action), stored_d(d8x::kRcmp1),
       &motion::AxisSettings::soft_limit_plus},
      {stored_x(d9x::kCp2Source), stored_x(d9x::kCp2Method), stored_x(d9x::kCp2Action), stored_d(d8x::kRcmp2),
       &motion::AxisSettings::soft_limit_minus}};
  for (const Side& side : kSides) {
    const Value action = settings.of(side.action, axis);
    const bool is_limit = settings.of(side.method, axis) == kSoftLimit &&
                          settings.of(side.source, axis) == kCounter1 && stops(action) &&
                          !is_held_cleared(axis, kCounter1);
    if (!is_limit) continue;
    made.*side.limit = settings.raw(side.value, axis) - counter_lead;
    const motion::Reaction at_limit =
        action == kStopByRamp ? motion::Reaction::slow_down : motion::Reaction::stop_at_once;
    if (side.limit == &motion::AxisSettings::soft_limit_plus) {
      made.at_soft_limit = at_limit;
    } else {
      made.at_soft_limit_minus = at_limit;
    }
  }
  return made;
}

/// If D8x17 is a separate counter, a new CMX or CDV does not change it.
void AxisParameters::keep_display(int axis_number) {
  AxisState& state = axis(axis_number);
  const motion::UnitScale scale = registers().scale(axis_number);
  const motion::UnitScale before = std::exchange(state.scale_seen, scale);
  if (before == scale || !chose(option("positions_model", "a_counter_that_keeps_its_value"))) return;
  const std::int64_t pulses = machine_pulses(axis_number);
  state.offset_lu += before.to_units(pulses).value_or(0) - scale.to_units(pulses).value_or(0);
}

void AxisParameters::apply_axis_parameters(int axis_number, int number) {
  const Settings settings = registers();
  const auto limit_pulses = [&](StoredRegister kept) {
    constexpr std::int64_t kRange = std::int64_t{1} << 28;  // the chip's numbers wrap
    const std::int64_t pulses =
        settings.scale(axis_number).to_pulses(settings.of(kept, axis_number)).value_or(0);
    const std::int64_t wrapped = ((pulses + kRange / 2) % kRange + kRange) % kRange - kRange / 2;
    return static_cast<std::int32_t>(wrapped);
  };
  switch (number) {
    case d9x::kEncoderDirection: {
      // From here on, the axis counts in the other direction, and no signal has affected it yet.
      motion::Axis& motor = chip(axis_number);
      const std::int64_t counts = axis(axis_number).encoder_counts;
      motor.encoder_pulses = motor.encoder_seen =
          settings.is_on(stored_x(d9x::kEncoderDirection), axis_number) ? -counts : counts;
      break;
    }
    case d9x::kPlusOtSignal:
      if (inputs_.has_limit_copies())
        ground_.put(stored_d(d8x::kPlusLimitPort), settings.raw(stored_x(d9x::kPlusOtSignal), axis_number),
                    axis_number);
      break;
    case d9x::kMinusOtSignal:
      if (inputs_.has_limit_copies())
        ground_.put(stored_d(d8x::kMinusLimitPort), settings.raw(stored_x(d9x::kMinusOtSignal), axis_number),
                    axis_number);
      break;
    case d9x::kCmx:
    case d9x::kCdv:
    case d9x::kPlusSoftLimit:
    case d9x::kMinusSoftLimit:
      if (number != d9x::kMinusSoftLimit)
        ground_.put(stored_d(d8x::kRcmp1), limit_pulses(stored_x(d9x::kPlusSoftLimit)), axis_number);
      if (number != d9x::kPlusSoftLimit)
        ground_.put(stored_d(d8x::kRcmp2), limit_pulses(stored_x(d9x::kMinusSoftLimit)), axis_number);
      if (number <= d9x::kCdv) {
        axis(axis_number).stands_on_target = false;
        keep_display(axis_number);
      }
      break;
    default: break;
  }
  const motion::AxisSettings wanted = motor_settings(axis_number);
  if (wanted != chip(axis_number).settings) chip(axis_number).set(wanted);
  comparators_.set_comparators(axis_number);
  inputs_.update_environment(axis_number);
}

void AxisParameters::apply_all_axis_parameters() {
  for (int number = 0; number < kAxisCount; ++number) {
    for (const int parameter : {d9x::kPlusOtSignal, d9x::kMinusOtSignal, d9x::kCmx})
      apply_axis_parameters(number, parameter);
  }
}

void AxisParameters::set_work_lu(int axis_number, std::int64_t position) {
  AxisState& state = axis(axis_number);
  if (state.moves() && chose(option("pset_moving", "void"))) {
    report(Code::axis_taken);
    return;
  }
  state.offset_lu += position - work_lu(axis_number);
  state.stands_on_target = false;
}

void AxisParameters::set_counter(int axis_number, int number, std::int32_t pulses) {
  AxisState& state = axis(axis_number);
  if (number > 0) {
    state.counts[static_cast<std::size_t>(number - 1)] = pulses;
    comparators_.set_comparators(axis_number);
    return;
  }
  state.command.set(pulses, chip(axis_number).travel_pulses);
  state.stands_on_target = false;
  apply_axis_parameters(axis_number, 0);
}

void AxisParameters::set_zero(int axis_number) {
  AxisState& state = axis(axis_number);
  if (state.moves() && !chose(option("zero_set_moving", "carried_out"))) {
    report(Code::axis_taken);
    return;
  }
  state.offset_lu = 0;
  set_counter(axis_number, 0, 0);
  set_counter(axis_number, 1, 0);
}

}  // namespace understudy::emulator::models::super_40nc
