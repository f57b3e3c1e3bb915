#include "emulator/models/simple2_r3/program_machine.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/model.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/signals.h"
#include "emulator/models/simple2_r3/state.h"
#include "interpreter/simple2/dialect.h"
#include "interpreter/simple2/machine.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

/// Returns the place for each parameter number. The place is empty if the number is not defined.
const std::vector<NamedPlace>& parameter_places() {
  static const std::vector<NamedPlace> places = [] {
    std::vector<NamedPlace> all(256);
    const Model& mine = simple2_r3::model();
    for (const ParameterRow& row : mine.parameters) {
      for (const RegisterRow& target : mine.registers->rows()) {
        if (target.name != row.register_name) continue;
        for (int i = 0; i < row.count; ++i) {
          const auto found = mine.registers->find(RegisterMap::name_of(target, i), mine.firmwares.back());
          if (found) all[static_cast<std::size_t>(row.first) + static_cast<std::size_t>(i)] = *found;
        }
      }
    }
    return all;
  }();
  return places;
}

}  // namespace

template <class Seen, class StateSeen, class Bank>
bool ProgramStateView<Seen, StateSeen, Bank>::input(int din) const {
  return Signals(state_, setup_).input(din);
}

template <class Seen, class StateSeen, class Bank>
bool ProgramStateView<Seen, StateSeen, Bank>::status_bit(int bit) const {
  return ((Signals(state_, setup_).status() >> bit) & 1) != 0;
}

template <class Seen, class StateSeen, class Bank>
std::int32_t ProgramStateView<Seen, StateSeen, Bank>::parameter(int number) const {
  const NamedPlace& place = parameter_places()[static_cast<std::size_t>(number)];
  if (!place.place) return 0;
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(read_value(bank_, place)));
}

template <class Seen, class StateSeen, class Bank>
bool ProgramStateView<Seen, StateSeen, Bank>::moving(Axis axis) const {
  const std::size_t number = number_of(axis);
  return state_.axes[number].command != Command::none || state_.kept[number].command != Command::none;
}

template <class Seen, class StateSeen, class Bank>
bool ProgramStateView<Seen, StateSeen, Bank>::moving_for_wait(Axis axis) const {
  const std::size_t number = number_of(axis);
  const bool homes =
      state_.axes[number].command == Command::homing || state_.kept[number].command == Command::homing;
  return moving(axis) && !(homes && setup_.chose(option("wait_move_homing", "does_not_wait")));
}

template <class Seen, class StateSeen, class Bank>
bool ProgramStateView<Seen, StateSeen, Bank>::cut_short(Axis axis) const {
  return state_.axes[number_of(axis)].cut_short;
}

template class ProgramStateView<interpreter::simple2::MachineView, const State, const RegisterBank>;
template class ProgramStateView<interpreter::simple2::Machine, State, RegisterBank>;

void ProgramMachine::set_outputs(std::uint8_t which, std::uint8_t levels) {
  write_outputs(state_, setup_, which, levels);
}

void ProgramMachine::set_parameter(int number, std::int32_t value) {
  const NamedPlace& place = parameter_places()[static_cast<std::size_t>(number)];
  if (!place.place || place.place.row->access == Access::read) return;
  const RegisterRow& row = *place.place.row;
  const bool is_counter = row.name == "Counter1_Value" || row.name == "Counter2_Value";
  // A timer has 32 unsigned bits. A signed or 16-bit value is brought into its range.
  Value wanted = value;
  if (row.type == Type::u32 && row.min == 0) {
    wanted = static_cast<std::uint32_t>(value);
  } else if (is_counter && setup_.chose(option("counter_by_var", "as_a_counter"))) {
    const bool saturates =
        setup_.dialect.counter_overflow == interpreter::simple2::Dialect::CounterOverflow::saturates;
    wanted = saturates ? std::clamp(value, 0, 65535) : value & 0xFFFF;
  } else if (row.ranged && row.type == Type::u16) {
    wanted = interpreter::simple2::fitted(setup_.dialect, value, static_cast<std::int32_t>(row.min),
                                          static_cast<std::int32_t>(row.max));
  } else if (row.ranged) {
    if ((value < row.min || value > row.max) && setup_.chose(option("program_value_of_32_bits", "ignored")))
      return;
    wanted = std::clamp<Value>(value, row.min, row.max);
  }
  write_value(bank_, place, wanted);
}

void ProgramMachine::run_timer(int timer, bool run) {
  state_.timers[static_cast<std::size_t>(timer - 1)].run(run, setup_.timer_time(), setup_.timers_stay);
}

MoveParameters ProgramMachine::parameters_for(std::size_t axis, std::int64_t distance_pulses) const {
  if (has_speed_of_its_own()) {
    const ProgramSpeed& own = state_.program_speeds[axis];
    return {.distance_pulses = distance_pulses,
            .speed_rpm = own.speed_rpm,
            .acceleration_10ms = own.acceleration_10ms,
            .deceleration_10ms = own.deceleration_10ms};
  }
  const AxisSlots& slots = kAxisSlots[axis];
  return {.distance_pulses = distance_pulses,
          .speed_rpm = state_.image[slots.speed],
          .acceleration_10ms = state_.image[slots.acc_time],
          .deceleration_10ms = state_.image[slots.dec_time],
          .of_the_axis = true};
}

/// Shows a program's move in the axis's register, if a choice requires it.
void ProgramMachine::show_pulse(std::size_t axis, std::int32_t pulses) {
  if (!setup_.chose(option("program_pulse", "shown"))) return;
  state_.image[kAxisSlots[axis].pulse] = static_cast<std::uint32_t>(pulses);
}

void ProgramMachine::move_incremental(Axis axis, std::int32_t pulses) {
  const std::size_t number = number_of(axis);
  show_pulse(number, pulses);
  commands(axis).start_move(Command::incremental, parameters_for(number, pulses));
}

void ProgramMachine::move_absolute(Axis axis, std::int32_t pulses) {
  const std::size_t number = number_of(axis);
  const std::int64_t distance = std::int64_t{pulses} - state_.axes[number].coordinate_pulses;
  show_pulse(number, pulses);
  commands(axis).start_move(Command::absolute, parameters_for(number, distance));
}

void ProgramMachine::go_home(Axis axis) { commands(axis).go_home(); }

void ProgramMachine::set_speed(Axis axis, std::int32_t rpm) {
  const std::size_t number = number_of(axis);
  const auto speed_rpm = static_cast<std::uint32_t>(rpm);
  if (has_speed_of_its_own()) {
    state_.program_speeds[number].speed_rpm = speed_rpm;
    return;
  }
  state_.image[kAxisSlots[number].speed] = speed_rpm;
  commands(axis).speed_changed();
}

void ProgramMachine::set_ramps(Axis axis, std::int32_t acceleration_10ms, std::int32_t deceleration_10ms) {
  const std::size_t number = number_of(axis);
  const auto up_10ms = static_cast<std::uint32_t>(acceleration_10ms);
  const auto down_10ms = static_cast<std::uint32_t>(deceleration_10ms);
  if (has_speed_of_its_own()) {
    state_.program_speeds[number].acceleration_10ms = up_10ms;
    state_.program_speeds[number].deceleration_10ms = down_10ms;
    return;
  }
  state_.image[kAxisSlots[number].acc_time] = up_10ms;
  state_.image[kAxisSlots[number].dec_time] = down_10ms;
  commands(axis).speed_changed();
}

void ProgramMachine::stop(Axis axis) { commands(axis).stop(); }

void ProgramMachine::switch_servo(Axis axis, bool on) { commands(axis).switch_servo(on); }

void ProgramMachine::run_velocity(Axis axis, std::int32_t milli_rpm) {
  commands(axis).show_velocity(milli_rpm);
  commands(axis).run_velocity(milli_rpm);
}

void ProgramMachine::output_pwm(Axis axis, std::int32_t percent) {
  commands(axis).show_pwm(static_cast<std::uint8_t>(percent));
  commands(axis).output_pwm(static_cast<std::uint8_t>(percent));
}

void ProgramMachine::follow_encoder(Axis axis) { commands(axis).follow_encoder(); }

}  // namespace understudy::emulator::models::simple2_r3
