#include "emulator/devices/simple2_r3/program_machine.h"

#include <algorithm>
#include <vector>

#include "emulator/devices/simple2_r3/axis_slots.h"
#include "emulator/devices/simple2_r3/choices.h"
#include "emulator/devices/simple2_r3/model.h"
#include "emulator/register_map/access.h"

namespace understudy::emulator::simple2_r3 {

namespace {

using interpreter::simple2::Dialect;

std::size_t number_of(ProgramMachine::Axis axis) { return axis == ProgramMachine::Axis::a ? 0 : 1; }

/// Where each parameter number leads; empty for those that are not defined.
const std::vector<NamedPlace>& parameter_places() {
  static const std::vector<NamedPlace> places = [] {
    std::vector<NamedPlace> all(256);
    const Model& mine = simple2_r3::model();
    for (const ParameterRow& row : mine.parameters) {
      for (const RegisterRow& target : mine.registers.rows()) {
        if (target.name != row.register_name) continue;
        for (int i = 0; i < row.count; ++i) {
          const auto found = mine.registers.find(RegisterMap::name_of(target, i), mine.firmwares.back());
          if (found) all[static_cast<std::size_t>(row.first + i)] = *found;
        }
      }
    }
    return all;
  }();
  return places;
}

MoveParameters parameters_for(const State& state, std::size_t axis, std::int64_t distance_pulses) {
  const AxisSlots& slots = kAxisSlots[axis];
  return {.distance_pulses = distance_pulses,
          .speed_rpm = state.image[slots.speed],
          .acceleration_10ms = state.image[slots.acc_time],
          .deceleration_10ms = state.image[slots.dec_time]};
}

}  // namespace

bool ProgramMachine::input(int din) const { return ((device_.state().inputs >> din) & 1) != 0; }

bool ProgramMachine::status_bit(int bit) const { return ((read_status(device_, {}) >> bit) & 1) != 0; }

void ProgramMachine::set_outputs(std::uint8_t which, std::uint8_t levels) {
  std::uint8_t& outputs = device_.state().written_outputs;
  outputs = static_cast<std::uint8_t>((outputs & ~which) | (levels & which));
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
  // A timer's 32 bits have no sign; what has one, or 16 bits, is brought into its range.
  Value wanted = value;
  if (row.type == Type::u32 && row.min == 0) {
    wanted = static_cast<std::uint32_t>(value);
  } else if (row.ranged) {
    wanted = std::clamp<Value>(value, row.min, row.max);
  }
  write_value(device_, place, wanted);
}

void ProgramMachine::run_timer(int timer, bool run) {
  device_.state().timers[static_cast<std::size_t>(timer - 1)].run(run, device_.now());
}

void ProgramMachine::move_incremental(Axis axis, std::int32_t pulses) {
  const std::size_t number = number_of(axis);
  device_.start_move(static_cast<int>(number), Command::incremental,
                     parameters_for(device_.state(), number, pulses));
}

void ProgramMachine::move_absolute(Axis axis, std::int32_t pulses) {
  const std::size_t number = number_of(axis);
  const std::int64_t distance = std::int64_t{pulses} - device_.state().axes[number].coordinate_pulses;
  device_.start_move(static_cast<int>(number), Command::absolute,
                     parameters_for(device_.state(), number, distance));
}

void ProgramMachine::go_home(Axis axis) { device_.go_home(static_cast<int>(number_of(axis))); }

bool ProgramMachine::moving(Axis axis) const {
  return device_.state().axes[number_of(axis)].command != Command::none;
}

void ProgramMachine::set_speed(Axis axis, std::int32_t rpm) {
  device_.state().image[kAxisSlots[number_of(axis)].speed] = static_cast<std::uint32_t>(rpm);
}

void ProgramMachine::set_ramps(Axis axis, std::int32_t acceleration_10ms, std::int32_t deceleration_10ms) {
  const AxisSlots& slots = kAxisSlots[number_of(axis)];
  device_.state().image[slots.acc_time] = static_cast<std::uint32_t>(acceleration_10ms);
  device_.state().image[slots.dec_time] = static_cast<std::uint32_t>(deceleration_10ms);
}

void ProgramMachine::stop(Axis axis) { device_.stop(static_cast<int>(number_of(axis))); }

void ProgramMachine::switch_servo(Axis axis, bool on) {
  device_.switch_servo(static_cast<int>(number_of(axis)), on);
}

void ProgramMachine::run_velocity(Axis axis, std::int32_t milli_rpm) {
  device_.state().image[kAxisSlots[number_of(axis)].velocity] = static_cast<std::uint32_t>(milli_rpm);
  device_.run_velocity(static_cast<int>(number_of(axis)), milli_rpm);
}

void ProgramMachine::output_pwm(Axis axis, std::int32_t percent) {
  device_.state().image[kAxisSlots[number_of(axis)].pwm] = static_cast<std::uint32_t>(percent);
  device_.output_pwm(static_cast<int>(number_of(axis)), static_cast<std::uint8_t>(percent));
}

void ProgramMachine::follow_encoder(Axis axis) { device_.follow_encoder(static_cast<int>(number_of(axis))); }

Dialect dialect_of(const Simple2R3& device) {
  Dialect dialect = interpreter::simple2::dialect_of_firmware(device.firmware());
  if (device.choice(kWaitMoveB139) == 1) dialect.quirk_wait_move_b_is_move_inc_b_wait = false;
  dialect.loop_count = static_cast<Dialect::LoopCount>(device.choice(kLoopCount));
  dialect.loop_left = static_cast<Dialect::LoopLeft>(device.choice(kLoopLeft));
  dialect.loop_nesting = static_cast<Dialect::LoopNesting>(device.choice(kLoopNesting));
  dialect.unknown_command = static_cast<Dialect::UnknownCommand>(device.choice(kUnknownCommand));
  dialect.after_last_line = static_cast<Dialect::AfterLastLine>(device.choice(kAfterLastLine));
  dialect.delay_counts = static_cast<Dialect::DelayCounts>(device.choice(kDelayCounts));
  return dialect;
}

}  // namespace understudy::emulator::simple2_r3
