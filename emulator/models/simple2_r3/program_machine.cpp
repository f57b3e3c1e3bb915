#include "emulator/models/simple2_r3/program_machine.h"

#include <algorithm>
#include <vector>

#include "emulator/device/register_map/access.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/model.h"

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

MoveParameters parameters_for(const Simple2R3& device, std::size_t axis, std::int64_t distance_pulses) {
  if (device.chose(kProgramSpeedOfItsOwn)) {
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
  if (!device.chose(kProgramPulseShown)) return;
  device.state().image[kAxisSlots[axis].pulse] = static_cast<std::uint32_t>(pulses);
}

}  // namespace

bool ProgramMachine::input(int din) const { return ((device_.inputs() >> din) & 1) != 0; }

bool ProgramMachine::status_bit(int bit) const { return ((read_status(device_, {}) >> bit) & 1) != 0; }

void ProgramMachine::set_outputs(std::uint8_t which, std::uint8_t levels) {
  device_.write_outputs(which, levels);
}

std::int32_t ProgramMachine::parameter(int number) const {
  const NamedPlace& place = parameter_places()[static_cast<std::size_t>(number)];
  if (!place.place) return 0;
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(read_value(device_, place)));
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
  } else if (is_counter && device_.chose(kVarsCountAsCounters)) {
    wanted = device_.chose(kCountersSaturate) ? std::clamp(value, 0, 65535) : value & 0xFFFF;
  } else if (row.ranged && row.type == Type::u16) {
    wanted = interpreter::simple2::fitted(device_.dialect(), value, static_cast<std::int32_t>(row.min),
                                          static_cast<std::int32_t>(row.max));
  } else if (row.ranged) {
    if ((value < row.min || value > row.max) && device_.chose(kProgramValueIgnored)) return;
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

bool ProgramMachine::moving(Axis axis) const {
  const State& state = device_.state();
  const std::size_t number = number_of(axis);
  return state.axes[number].command != Command::none || state.kept[number].command != Command::none;
}

bool ProgramMachine::moving_for_wait(Axis axis) const {
  const State& state = device_.state();
  const std::size_t number = number_of(axis);
  const bool homes =
      state.axes[number].command == Command::homing || state.kept[number].command == Command::homing;
  return moving(axis) && !(homes && device_.chose(kWaitMoveLeavesHoming));
}

bool ProgramMachine::cut_short(Axis axis) const { return device_.state().axes[number_of(axis)].cut_short; }

void ProgramMachine::set_speed(Axis axis, std::int32_t rpm) {
  const std::size_t number = number_of(axis);
  const auto speed_rpm = static_cast<std::uint32_t>(rpm);
  if (device_.chose(kProgramSpeedOfItsOwn)) {
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
  if (device_.chose(kProgramSpeedOfItsOwn)) {
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
  const auto take = [&](const Option& option, auto& field, auto value) {
    if (device.chose(option)) field = value;
  };
  take(kWaitMoveBWaits, dialect.quirk_wait_move_b_is_move_inc_b_wait, false);
  take(kLoopFurtherPasses, dialect.loop_count, Dialect::LoopCount::further_passes);
  take(kLoopRemembered, dialect.loop_left, Dialect::LoopLeft::remembered);
  take(kLoopNestingAtStart, dialect.loop_nesting, Dialect::LoopNesting::when_outer_starts);
  take(kUnknownCommandEnds, dialect.unknown_command, Dialect::UnknownCommand::ends);
  take(kUndefinedOperandEnds, dialect.undefined_operand, Dialect::UndefinedOperand::ends);
  take(kUndefinedParameterEnds, dialect.undefined_parameter, Dialect::UndefinedParameter::ends);
  take(kReadOnlyParameterEnds, dialect.read_only_parameter, Dialect::ReadOnlyParameter::ends);
  take(kLogicLowestBit, dialect.logic, Dialect::Logic::lowest_bit);
  take(kLow16Bits, dialect.value_out_of_range, Dialect::ValueOutOfRange::low_16_bits);
  take(kGoesOnAt0, dialect.after_last_line, Dialect::AfterLastLine::goes_on_at_0);
  take(kDelayBeforeNextSlot, dialect.delay_counts, Dialect::DelayCounts::before_next_slot);
  take(kWaitSharesItsSlot, dialect.wait_slot, Dialect::WaitSlot::next_line_runs_in_it);
  take(kTimer1AlwaysJumps, dialect.timer1_defect, Dialect::Timer1Defect::always_jumps);
  take(kArithmeticSaturates, dialect.overflow, Dialect::Overflow::saturates);
  take(kDivisionDownwards, dialect.division, Dialect::Division::downwards);
  take(kCountersSaturate, dialect.counter_overflow, Dialect::CounterOverflow::saturates);
  take(kUndefinedFlagVoid, dialect.undefined_flag, Dialect::UndefinedFlag::line_void);
  take(kTimersWithSign, dialect.timer_compare, Dialect::TimerCompare::with_sign);
  take(kWaitsForLaterMove, dialect.wait_cut_short, Dialect::WaitCutShort::waits_on);
  take(kRewrittenWaitsOn, dialect.rewritten_line, Dialect::RewrittenLine::waits_on);
  take(kCutShortEndsProgram, dialect.wait_cut_short, Dialect::WaitCutShort::program_ends);
  return dialect;
}

}  // namespace understudy::emulator::models::simple2_r3
