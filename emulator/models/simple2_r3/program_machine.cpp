#include "emulator/models/simple2_r3/program_machine.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/model.h"
#include "emulator/models/simple2_r3/options.h"
#include "interpreter/simple2/dialect.h"
#include "interpreter/simple2/machine.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

using interpreter::simple2::Dialect;

std::size_t number_of(ProgramMachine::Axis axis) { return axis == ProgramMachine::Axis::a ? 0 : 1; }

/// Where each parameter number leads; empty for those that are not defined.
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

/// A program's speed and times are not those of the axis's registers.
bool has_speed_of_its_own(const Simple2R3& device) {
  return device.chose(option("program_speed", "of_its_own"));
}

MoveParameters parameters_for(const Simple2R3& device, std::size_t axis, std::int64_t distance_pulses) {
  if (has_speed_of_its_own(device)) {
    const ProgramSpeed& own = device.state().program_speeds[axis];
    return {.distance_pulses = distance_pulses,
            .speed_rpm = own.speed_rpm,
            .acceleration_10ms = own.acceleration_10ms,
            .deceleration_10ms = own.deceleration_10ms};
  }
  const auto& image = device.state().image;
  const AxisSlots& slots = kAxisSlots[axis];
  return {.distance_pulses = distance_pulses,
          .speed_rpm = image[slots.speed],
          .acceleration_10ms = image[slots.acc_time],
          .deceleration_10ms = image[slots.dec_time],
          .of_the_axis = true};
}

/// Only a choice has a program's move appear in the axis's register.
void show_pulse(Simple2R3& device, std::size_t axis, std::int32_t pulses) {
  if (!device.chose(option("program_pulse", "shown"))) return;
  device.state().image[kAxisSlots[axis].pulse] = static_cast<std::uint32_t>(pulses);
}

}  // namespace

template <class Seen, class Of>
bool ProgramSight<Seen, Of>::input(int din) const {
  return ((device_.inputs() >> din) & 1) != 0;
}

template <class Seen, class Of>
bool ProgramSight<Seen, Of>::status_bit(int bit) const {
  return ((read_status(device_, {}) >> bit) & 1) != 0;
}

template <class Seen, class Of>
std::int32_t ProgramSight<Seen, Of>::parameter(int number) const {
  const NamedPlace& place = parameter_places()[static_cast<std::size_t>(number)];
  if (!place.place) return 0;
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(read_value(device_, place)));
}

template <class Seen, class Of>
bool ProgramSight<Seen, Of>::moving(Axis axis) const {
  const State& state = device_.state();
  const std::size_t number = number_of(axis);
  return state.axes[number].command != Command::none || state.kept[number].command != Command::none;
}

template <class Seen, class Of>
bool ProgramSight<Seen, Of>::moving_for_wait(Axis axis) const {
  const State& state = device_.state();
  const std::size_t number = number_of(axis);
  const bool homes =
      state.axes[number].command == Command::homing || state.kept[number].command == Command::homing;
  return moving(axis) && !(homes && device_.chose(option("wait_move_homing", "does_not_wait")));
}

template <class Seen, class Of>
bool ProgramSight<Seen, Of>::cut_short(Axis axis) const {
  return device_.state().axes[number_of(axis)].cut_short;
}

template class ProgramSight<interpreter::simple2::MachineView, const Simple2R3>;
template class ProgramSight<interpreter::simple2::Machine, Simple2R3>;

void ProgramMachine::set_outputs(std::uint8_t which, std::uint8_t levels) {
  device_.write_outputs(which, levels);
}

void ProgramMachine::set_parameter(int number, std::int32_t value) {
  const NamedPlace& place = parameter_places()[static_cast<std::size_t>(number)];
  if (!place.place || place.place.row->access == Access::read) return;
  const RegisterRow& row = *place.place.row;
  const bool is_counter = row.name == "Counter1_Value" || row.name == "Counter2_Value";
  // A timer's 32 bits have no sign; what has one, or 16 bits, is brought into its range.
  Value wanted = value;
  if (row.type == Type::u32 && row.min == 0) {
    wanted = static_cast<std::uint32_t>(value);
  } else if (is_counter && device_.chose(option("counter_by_var", "as_a_counter"))) {
    const bool saturates = device_.dialect().counter_overflow == Dialect::CounterOverflow::saturates;
    wanted = saturates ? std::clamp(value, 0, 65535) : value & 0xFFFF;
  } else if (row.ranged && row.type == Type::u16) {
    wanted = interpreter::simple2::fitted(device_.dialect(), value, static_cast<std::int32_t>(row.min),
                                          static_cast<std::int32_t>(row.max));
  } else if (row.ranged) {
    if ((value < row.min || value > row.max) && device_.chose(option("program_value_of_32_bits", "ignored")))
      return;
    wanted = std::clamp<Value>(value, row.min, row.max);
  }
  write_value(device_, place, wanted);
}

void ProgramMachine::run_timer(int timer, bool run) {
  device_.run_timer(device_.state().timers[static_cast<std::size_t>(timer - 1)], run);
}

void ProgramMachine::move_incremental(Axis axis, std::int32_t pulses) {
  const std::size_t number = number_of(axis);
  show_pulse(device_, number, pulses);
  device_.start_move(static_cast<int>(number), Command::incremental, parameters_for(device_, number, pulses));
}

void ProgramMachine::move_absolute(Axis axis, std::int32_t pulses) {
  const std::size_t number = number_of(axis);
  const std::int64_t distance = std::int64_t{pulses} - device_.state().axes[number].coordinate_pulses;
  show_pulse(device_, number, pulses);
  device_.start_move(static_cast<int>(number), Command::absolute, parameters_for(device_, number, distance));
}

void ProgramMachine::go_home(Axis axis) { device_.go_home(static_cast<int>(number_of(axis))); }

void ProgramMachine::set_speed(Axis axis, std::int32_t rpm) {
  const std::size_t number = number_of(axis);
  const auto speed_rpm = static_cast<std::uint32_t>(rpm);
  if (has_speed_of_its_own(device_)) {
    device_.state().program_speeds[number].speed_rpm = speed_rpm;
    return;
  }
  device_.state().image[kAxisSlots[number].speed] = speed_rpm;
  device_.speed_changed(static_cast<int>(number));
}

void ProgramMachine::set_ramps(Axis axis, std::int32_t acceleration_10ms, std::int32_t deceleration_10ms) {
  const std::size_t number = number_of(axis);
  const auto up_10ms = static_cast<std::uint32_t>(acceleration_10ms);
  const auto down_10ms = static_cast<std::uint32_t>(deceleration_10ms);
  if (has_speed_of_its_own(device_)) {
    device_.state().program_speeds[number].acceleration_10ms = up_10ms;
    device_.state().program_speeds[number].deceleration_10ms = down_10ms;
    return;
  }
  device_.state().image[kAxisSlots[number].acc_time] = up_10ms;
  device_.state().image[kAxisSlots[number].dec_time] = down_10ms;
  device_.speed_changed(static_cast<int>(number));
}

void ProgramMachine::stop(Axis axis) { device_.stop(static_cast<int>(number_of(axis))); }

void ProgramMachine::switch_servo(Axis axis, bool on) {
  device_.switch_servo(static_cast<int>(number_of(axis)), on);
}

void ProgramMachine::run_velocity(Axis axis, std::int32_t milli_rpm) {
  device_.show_velocity(static_cast<int>(number_of(axis)), milli_rpm);
  device_.run_velocity(static_cast<int>(number_of(axis)), milli_rpm);
}

void ProgramMachine::output_pwm(Axis axis, std::int32_t percent) {
  device_.show_pwm(static_cast<int>(number_of(axis)), static_cast<std::uint8_t>(percent));
  device_.output_pwm(static_cast<int>(number_of(axis)), static_cast<std::uint8_t>(percent));
}

void ProgramMachine::follow_encoder(Axis axis) { device_.follow_encoder(static_cast<int>(number_of(axis))); }

Dialect dialect_of(const Simple2R3& device) {
  Dialect dialect = interpreter::simple2::dialect_of_firmware(device.firmware());
  if (device.chose(option("wait_move_b_139", "waits"))) dialect.quirk_wait_move_b_is_move_inc_b_wait = false;
  if (device.chose(option("loop_count", "further_passes")))
    dialect.loop_count = Dialect::LoopCount::further_passes;
  if (device.chose(option("loop_left", "remembered"))) dialect.loop_left = Dialect::LoopLeft::remembered;
  if (device.chose(option("loop_nesting", "when_outer_starts")))
    dialect.loop_nesting = Dialect::LoopNesting::when_outer_starts;
  if (device.chose(option("unknown_command", "ends")))
    dialect.unknown_command = Dialect::UnknownCommand::ends;
  if (device.chose(option("undefined_operand", "ends")))
    dialect.undefined_operand = Dialect::UndefinedOperand::ends;
  if (device.chose(option("undefined_parameter", "ends")))
    dialect.undefined_parameter = Dialect::UndefinedParameter::ends;
  if (device.chose(option("read_only_parameter", "ends")))
    dialect.read_only_parameter = Dialect::ReadOnlyParameter::ends;
  if (device.chose(option("logic_operand", "lowest_bit"))) dialect.logic = Dialect::Logic::lowest_bit;
  if (device.chose(option("value_out_of_range", "low_16_bits")))
    dialect.value_out_of_range = Dialect::ValueOutOfRange::low_16_bits;
  if (device.chose(option("after_last_line", "goes_on_at_0")))
    dialect.after_last_line = Dialect::AfterLastLine::goes_on_at_0;
  if (device.chose(option("delay_counts", "before_next_slot")))
    dialect.delay_counts = Dialect::DelayCounts::before_next_slot;
  if (device.chose(option("wait_slot", "in_the_same_slot")))
    dialect.wait_slot = Dialect::WaitSlot::next_line_runs_in_it;
  if (device.chose(option("timer1_defect", "always_jumps")))
    dialect.timer1_defect = Dialect::Timer1Defect::always_jumps;
  if (device.chose(option("arithmetic", "saturates"))) dialect.overflow = Dialect::Overflow::saturates;
  if (device.chose(option("division", "downwards"))) dialect.division = Dialect::Division::downwards;
  if (device.chose(option("counter_overflow", "saturates")))
    dialect.counter_overflow = Dialect::CounterOverflow::saturates;
  if (device.chose(option("undefined_flag", "line_void")))
    dialect.undefined_flag = Dialect::UndefinedFlag::line_void;
  if (device.chose(option("timer_compare", "with_sign")))
    dialect.timer_compare = Dialect::TimerCompare::with_sign;
  if (device.chose(option("wait_cut_short", "waits_on")))
    dialect.wait_cut_short = Dialect::WaitCutShort::waits_on;
  if (device.chose(option("rewritten_line", "waits_on")))
    dialect.rewritten_line = Dialect::RewrittenLine::waits_on;
  if (device.chose(option("wait_cut_short", "program_ends")))
    dialect.wait_cut_short = Dialect::WaitCutShort::program_ends;
  return dialect;
}

}  // namespace understudy::emulator::models::simple2_r3
