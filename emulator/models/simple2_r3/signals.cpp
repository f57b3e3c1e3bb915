#include "emulator/models/simple2_r3/signals.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/state.h"
#include "emulator/models/simple2_r3/terminals.h"
#include "motion/environment.h"

namespace understudy::emulator::models::simple2_r3 {

bool Signals::dip_switch(int number) const {
  const std::uint8_t levels =
      setup_.chose(option("switches_sampled", "always")) ? setup_.switch_levels() : state_.switches;
  return ((levels >> number) & 1) != 0;
}

bool Signals::have_changed() const {
  if (setup_.input_levels() != state_.inputs) return true;
  for (int i = 0; i < kAnalogCount; ++i) {
    if (setup_.adc(i) != state_.adc[static_cast<std::size_t>(i)]) return true;
  }
  return false;
}

bool Signals::assigned(std::size_t assignment_slot) const {
  if (!setup_.assigned_at_power_up) return state_.image[assignment_slot] != 0;
  return ((state_.assignments >> (assignment_slot - kFirstAssignment)) & 1) != 0;
}

bool Signals::alarm(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  if (!assigned(slots.alarm_assigned)) return false;
  return input(slots.alarm_input) != (state_.image[slots.alarm_polarity] == 1) ||
         state_.axes[static_cast<std::size_t>(axis)].alarm_latched;
}

bool Signals::ready(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return assigned_input(slots.ready_assigned, slots.ready_input);
}

bool Signals::upper_limit(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return assigned_input(slots.upper_assigned, slots.upper_input);
}

bool Signals::lower_limit(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return assigned_input(slots.lower_assigned, slots.lower_input);
}

motion::Signals Signals::of_motor(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  motion::Signals on = 0;
  const auto add = [&](motion::Signal signal, bool is_on) {
    if (is_on) on |= motion::bit(signal);
  };
  add(motion::Signal::alarm, alarm(axis));
  const bool swapped = setup_.limits_physical && state_.image[slots.direction_polarity] != 0;
  add(motion::Signal::limit_plus, swapped ? lower_limit(axis) : upper_limit(axis));
  add(motion::Signal::limit_minus, swapped ? upper_limit(axis) : lower_limit(axis));
  add(motion::Signal::home, assigned_input(slots.home_assigned, slots.home_input));
  return on;
}

bool Signals::output(int number) const {
  for (int axis = 0; axis < 2; ++axis) {
    const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
    if (number == slots.servo_output && assigned(slots.servo_output_assigned)) {
      return state_.axes[static_cast<std::size_t>(axis)].motor.servo_on ==
             (state_.image[slots.servo_polarity] == 1);
    }
    if (number == slots.alarm_clear_output && assigned(slots.alarm_clear_output_assigned)) {
      return alarm_clear(axis);
    }
  }
  return ((state_.written_outputs >> number) & 1) != 0;
}

/// Returns an axis's bit in STATUS: `by_function` if the pin has its function. Otherwise, a choice can show
/// the level of the pin.
bool Signals::shown(bool by_function, std::size_t assignment_slot, int number) const {
  if (assigned(assignment_slot) || !setup_.chose(option("unassigned_input_status", "level_of_pin")))
    return by_function;
  return input(number);
}

Value Signals::status() const {
  Value status = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const AxisState& state = state_.axes[static_cast<std::size_t>(axis)];
    const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
    const bool shows_moving =
        state.mode == Mode::position || !setup_.chose(option("moving_bit", "position_only"));
    const auto bit = [&](int number, bool on) { status |= static_cast<Value>(on) << (number + axis); };
    bit(0, shown(alarm(axis), slots.alarm_assigned, slots.alarm_input));
    bit(2, shown(ready(axis), slots.ready_assigned, slots.ready_input));
    const bool homes_apart =
        state.command == Command::homing && setup_.chose(option("homing_bits", "homing_alone"));
    bit(4, shows_moving && is_moving(state) && !homes_apart);
    bit(6, state.command == Command::homing);
    bit(8, state.homed);
    bit(10, state.motor.servo_on);
    bit(12, shown(upper_limit(axis), slots.upper_assigned, slots.upper_input));
    bit(14, shown(lower_limit(axis), slots.lower_assigned, slots.lower_input));
  }
  return status;
}

void sample_inputs(State& state, const Setup& setup) {
  const std::uint16_t levels = setup.input_levels();
  if (levels != state.inputs) state.touched = true;
  state.inputs = levels;
  for (int i = 0; i < kAnalogCount; ++i) state.adc[static_cast<std::size_t>(i)] = setup.adc(i);
}

void write_outputs(State& state, const Setup& setup, std::uint8_t which, std::uint8_t levels) {
  // DOUT 0 to 3 belong to the first registers that assign functions.
  for (unsigned n = 0; n < 4 && setup.chose(option("write_under_function", "ignored")); ++n) {
    if (Signals(state, setup).assigned(kFirstAssignment + n)) {
      which = static_cast<std::uint8_t>(which & ~(1U << n));
    }
  }
  std::uint8_t& outputs = state.written_outputs;
  outputs = static_cast<std::uint8_t>((outputs & ~which) | (levels & which));
}

}  // namespace understudy::emulator::models::simple2_r3
