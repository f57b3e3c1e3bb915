#include "emulator/models/super_40nc/axis/chips.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "motion/axis.h"
#include "motion/profile.h"
#include "motion/ramp.h"
#include "motion/tick.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

bool Chips::holds_cleared(int axis) const {
  if (!has_chip_pins()) return false;
  return registers().of(stored_x(d9x::kClrSignal), axis) ==
         (pin_seen(axis, kClearPin) ? kWhileOn : kWhileOff);
}

bool Chips::is_held_cleared(int axis, int which) const {
  return holds_cleared(axis) && is_bit(registers().raw(stored_x(d9x::kClrResetC), axis), which);
}

std::int32_t Chips::counter(int axis_number, int number) const {
  const AxisState& state = axis(axis_number);
  if (number == 0) return static_cast<std::int32_t>(machine_pulses(axis_number));
  return state.counts[static_cast<std::size_t>(number - 1)];
}

std::int64_t Chips::work_lu(int axis_number) const {
  const AxisState& state = axis(axis_number);
  return registers().scale(axis_number).to_units(machine_pulses(axis_number)).value_or(0) + state.offset_lu;
}

std::int64_t Chips::relative_base_lu(int axis_number) const {
  const AxisState& state = axis(axis_number);
  const bool continues = state.stands_on_target && !chose(option("relative_base", "present_position"));
  return continues ? state.target_lu : work_lu(axis_number);
}

std::int64_t Chips::distance_to(int axis_number, std::int64_t target_lu) const {
  const motion::UnitScale scale = registers().scale(axis_number);
  return scale.to_pulses(target_lu - axis(axis_number).offset_lu).value_or(0) - machine_pulses(axis_number);
}

std::int64_t Chips::remaining_pulses(int axis_number) const {
  const AxisState& state = axis(axis_number);
  const bool has_target = state.rest.kind == RestKind::path || state.holder == Activity::rest;
  return has_target ? std::abs(state.rest.travel - chip(axis_number).travel_pulses)
                    : chip(axis_number).remaining_pulses();
}

std::int64_t Chips::braking_pulses(int axis) const {
  const motion::Axis& motor = chip(axis);
  if (motor.task != motion::Task::move) return 0;
  const motion::RampLaw& down = motor.law.slow_down_reckoned_by.value_or(motor.law.down);
  return std::llround(motion::ramp_distance(down, motor.law.start_speed_u_s, motor.law.top_speed_u_s));
}

/// Returns X16, for MRK.
std::int64_t Chips::search_pulses(int axis) const {
  const Settings settings = registers();
  const Value distance = settings.of(stored_x(d9x::kLowSpeedLength), axis);
  const bool is_in_pulses = chose(option("mark_distance_unit", "pulses"));
  return is_in_pulses ? distance : settings.scale(axis).to_pulses(distance).value_or(0);
}

std::int64_t Chips::place_pulses(int axis) const {
  const motion::Axis& motor = chip(axis);
  return motor.inverted ? -motor.travel_pulses : motor.travel_pulses;
}

std::int64_t Chips::pulses_to_come(int axis_number) const {
  if (axis(axis_number).masked) return 0;
  return is_on_path(axis_number)
             ? axes_.path.pulses_to_come(static_cast<std::size_t>(axis_number), axes_.chips)
             : chip(axis_number).pulses_to_come();
}

std::int32_t Chips::operation_of(int axis_number) const {
  const AxisState& state = axis(axis_number);
  const motion::Axis& motor = chip(axis_number);
  if (!motor.moving() || !state.moves()) return kStopped;
  if (motor.settling) return kAtInp;
  if (motor.task == motion::Task::following) return kByWheel;
  if (motor.in_backlash || state.path_backlash != 0) return kBacklash;
  const motion::Sample sample = is_on_path(axis_number) ? axes_.path.run.sample(now()) : motor.sample(now());
  if (!(sample.speed_u_s > 0)) return kStopped;
  if (sample.acceleration_u_s2 > 0) return kSpeedingUp;
  if (sample.acceleration_u_s2 < 0) return kSlowingDown;
  constexpr int kCreep = 1;  // index into the speeds of a homing
  if (motor.homing.active() && motor.homing.row().speed == kCreep) return kAtFa;
  return sample.speed_u_s > motor.law.start_speed_u_s ? kAtFh : kAtFl;
}

double Chips::commanded_pps(int axis_number) const {
  const motion::Axis& motor = chip(axis_number);
  if (!motor.moving()) return 0;
  if (axis(axis_number).path_backlash != 0 && !axes_.path_is_held) {
    const double direction = axis(axis_number).path_backlash < 0 ? -1 : +1;
    return direction * motor.settings.backlash_speed_pps;
  }
  if (is_on_path(axis_number)) return axes_.path.speed_pps(static_cast<std::size_t>(axis_number), now());
  if (motor.task == motion::Task::following) {
    return static_cast<double>(axis(axis_number).followed_pulses) * motion::kTicksPerSecond;
  }
  return motor.sample(now()).speed_u_s * static_cast<double>(motor.drive.direction);
}

double Chips::speed_pps(int axis_number) const {
  const AxisState& state = axis(axis_number);
  if (state.masked) return 0;
  const double speed = commanded_pps(axis_number);
  return (chip(axis_number).inverted ? -speed : speed) + 0.0;  // 0 has no sign
}

std::int32_t Chips::chip_speed(int axis_number) const {
  return wrapped(std::llround(std::abs(commanded_pps(axis_number)) / axis(axis_number).step_pps));
}

bool Chips::is_awaited_by(Mover mover) const {
  return std::any_of(axes_.axes.begin(), axes_.axes.end(), [&](const AxisState& state) {
    return (state.mover == mover && state.awaited) || state.stop_awaited_by == mover;
  });
}

void Chips::forget_end(int axis) {
  motion::Axis& motor = chip(axis);
  motor.events_between =
      static_cast<motion::Events>(motor.events_between & ~motion::bit(motion::Event::ended));
}

}  // namespace understudy::emulator::models::super_40nc
