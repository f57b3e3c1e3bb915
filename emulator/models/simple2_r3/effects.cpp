#include "emulator/models/simple2_r3/effects.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/simulated_time.h"
#include "emulator/device/reasons.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/commands.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/memory.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/signals.h"
#include "emulator/models/simple2_r3/slots.h"
#include "emulator/models/simple2_r3/state.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

const AxisState& axis_of(const Simple2R3& device, Cell cell) {
  return device.state().axes[static_cast<std::size_t>(cell.argument)];
}

/// Calls `act` for the axis to which the cell refers, or for both axes.
template <typename Act>
void for_each_axis(Cell cell, Act act) {
  for (int axis = 0; axis < 2; ++axis) {
    if (cell.argument == kAllAxes || cell.argument == axis) act(axis);
  }
}

MoveParameters own_parameters(const Simple2R3& device, int axis) {
  const auto& image = device.state().image;
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return {.distance_pulses = static_cast<std::int32_t>(image[slots.pulse]),
          .speed_rpm = image[slots.speed],
          .acceleration_10ms = image[slots.acc_time],
          .deceleration_10ms = image[slots.dec_time],
          .of_the_axis = true,
          .by_trigger = true};
}

bool is_unlocked(const Simple2R3& device) { return simple2_r3::is_unlocked(device.state(), device.setup()); }

/// Returns true if the program is locked, so that writes to it are ignored.
bool is_write_protected(const Simple2R3& device) {
  return !is_unlocked(device) && device.chose(option("locked_writes", "ignored"));
}

/// Says that the device ignores a command, and which choice decides that.
void say_ignored(const Simple2R3& device, const char* what, const char* why, const Option& chosen) {
  device.setup().reasons.say(device.now(), std::string("ignores ") + what + ": " + why + " (" +
                                               choice_words(device.setup(), chosen.choice) + ")");
}
constexpr const char* kLocked = "the program is locked, because PWD does not match";

/// Copies a set to the axis's registers, only if so chosen.
void show_set(Simple2R3& device, int axis, const MoveParameters& set) {
  if (!device.chose(option("set_move", "copied"))) return;
  auto& image = device.state().image;
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  image[slots.pulse] = static_cast<std::uint32_t>(set.distance_pulses);
  image[slots.speed] = set.speed_rpm;
  image[slots.acc_time] = set.acceleration_10ms;
  image[slots.dec_time] = set.deceleration_10ms;
}

/// Returns the value of a trigger register whose motion may be in progress.
Value while_in_progress(const Simple2R3& device, Cell cell, Command command) {
  const AxisState& axis = axis_of(device, cell);
  const bool is_shown = axis.by_trigger || !device.chose(option("triggers_shown", "those_written_there"));
  return axis.command == command && is_shown && !device.chose(option("trigger_read_back", "zero"));
}

MoveParameters parameters_of_set(const Simple2R3& device, Value set) {
  const auto& image = device.state().image;
  const auto i = static_cast<std::size_t>(set - 1);
  return {.distance_pulses = static_cast<std::int32_t>(image[slot("Parms_Pulse{}") + i]),
          .speed_rpm = image[slot("Parms_Speed{}") + i],
          .acceleration_10ms = image[slot("Parms_AccTime{}") + i],
          .deceleration_10ms = image[slot("Parms_DecTime{}") + i]};
}

/// Converts a target to a distance. The distance has 64 bits, because it may be twice the range of a
/// coordinate.
MoveParameters from_here(const Simple2R3& device, int axis, MoveParameters move) {
  move.distance_pulses -= device.state().axes[static_cast<std::size_t>(axis)].coordinate_pulses;
  return move;
}

/// Returns the image slot of a program cell.
std::size_t cell_slot(Cell cell) {
  return kColumns[static_cast<std::size_t>(cell.argument)] + static_cast<std::size_t>(cell.index);
}

}  // namespace

Value read_status(const Simple2R3& device, Cell) { return device.signals().status(); }

Value read_version(const Simple2R3& device, Cell) {
  const Value version = device.firmware();
  if (!device.chose(option("version_encoding", "bcd"))) return version;
  return version / 100 << 8 | version / 10 % 10 << 4 | version % 10;
}

Value read_output(const Simple2R3& device, Cell cell) {
  if (device.chose(option("output_read_back", "written_level")))
    return (device.state().written_outputs >> cell.index) & 1;
  return device.signals().output(cell.index);
}

Value read_all_outputs(const Simple2R3& device, Cell) {
  Value levels = 0;
  for (int i = 0; i < kOutputCount; ++i) levels |= read_output(device, {.index = i}) << i;
  return levels;
}

Value read_input(const Simple2R3& device, Cell cell) { return device.signals().input(cell.index); }

Value read_all_inputs(const Simple2R3& device, Cell) { return device.signals().inputs(); }

Value read_encoder(const Simple2R3& device, Cell cell) {
  const AxisState& axis = axis_of(device, cell);
  return axis.encoder_counts + axis.encoder_preset;
}

Value read_coordinate(const Simple2R3& device, Cell cell) { return axis_of(device, cell).coordinate_pulses; }

Value read_incremental_trigger(const Simple2R3& device, Cell cell) {
  return while_in_progress(device, cell, Command::incremental);
}

Value read_absolute_trigger(const Simple2R3& device, Cell cell) {
  return while_in_progress(device, cell, Command::absolute);
}

Value read_homing_trigger(const Simple2R3& device, Cell cell) {
  return while_in_progress(device, cell, Command::homing);
}

Value read_mode(const Simple2R3& device, Cell cell) { return static_cast<Value>(axis_of(device, cell).mode); }

Value read_encoder_speed(const Simple2R3& device, Cell cell) {
  const auto& image = device.state().image;
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(cell.argument)];
  const std::uint32_t resolution = std::max(image[slots.encoder_resolution], 1U);
  return encoder_rpm(
      axis_of(device, cell), device.now(),
      {.window = device.chose(option("encoder_speed", "window_of_10ms")) ? 10 : AxisState::kSpeedWindow,
       .counts_per_revolution = resolution,
       .wraps = device.chose(option("encoder_speed_overflow", "wraps"))});
}

Value read_now_line(const Simple2R3& device, Cell) {
  const auto& execution = device.state().execution;
  return execution.running || !device.chose(option("line_after_end", "zero")) ? execution.now_line : 0;
}

Value read_program_runs(const Simple2R3& device, Cell) { return device.state().execution.running; }

Value read_timer(const Simple2R3& device, Cell cell) {
  const Setup& setup = device.setup();
  return device.state().timers[static_cast<std::size_t>(cell.argument)].at(setup.timer_time(),
                                                                           setup.timers_stay);
}

Tick every_tick(const Simple2R3&, Cell, Tick done) { return done + 1; }

Tick next_count_of_timer(const Simple2R3& device, Cell cell, Tick done) {
  const Tick unit = device.setup().timer_unit;
  return device.state().timers[static_cast<std::size_t>(cell.argument)].running ? (done / unit + 1) * unit
                                                                                : kNever;
}

Value read_servo(const Simple2R3& device, Cell cell) { return axis_of(device, cell).motor.servo_on; }

Value read_alarm_clear(const Simple2R3& device, Cell cell) {
  return device.signals().alarm_clear(cell.argument);
}

Value read_adc(const Simple2R3& device, Cell cell) { return device.signals().adc(cell.argument); }

Value read_analog(const Simple2R3& device, Cell cell) {
  const auto& image = device.state().image;
  const auto i = static_cast<std::size_t>(cell.argument);
  const Value at_10v = image[slot("ADC_10V_A") + i];
  if (device.chose(option("analog_scaling", "line_through_zero"))) {
    return at_10v == 0 ? 0 : std::clamp<Value>(read_adc(device, cell) * 2000 / at_10v, 0, 65535);
  }
  // The two calibration points define a line: 200 at 1 V, 2000 at 10 V.
  const Value at_1v = image[slot("ADC_1V_A") + i];
  const Value span = at_10v - at_1v;
  if (span == 0) return 0;
  return std::clamp<Value>(200 + (read_adc(device, cell) - at_1v) * 1800 / span, 0, 65535);
}

Value read_eeprom_busy(const Simple2R3& device, Cell) { return device.state().eeprom.writing(); }

Value read_cell(const Simple2R3& device, Cell cell) {
  return is_unlocked(device) ? device.state().image[cell_slot(cell)] : 0;
}

Value read_unlocked(const Simple2R3& device, Cell) { return is_unlocked(device); }

Value read_password(const Simple2R3& device, Cell) {
  return is_unlocked(device) && !device.chose(option("password_read_back", "zero")) ? device.state().password
                                                                                    : 0;
}

Value read_zero(const Simple2R3&, Cell) { return 0; }

void write_output(Simple2R3& device, Cell cell, Value level) {
  write_outputs(device.state(), device.setup(), static_cast<std::uint8_t>(1U << cell.index),
                level != 0 ? 0x7F : 0);
}

void write_all_outputs(Simple2R3& device, Cell, Value levels) {
  write_outputs(device.state(), device.setup(), 0x7F, static_cast<std::uint8_t>(levels));
}

void preset_encoder(Simple2R3& device, Cell cell, Value counts) {
  AxisState& axis = device.state().axes[static_cast<std::size_t>(cell.argument)];
  axis.encoder_preset += counts - static_cast<std::int32_t>(read_encoder(device, cell));
}

void preset_coordinate(Simple2R3& device, Cell cell, Value pulses) {
  device.axis(cell.argument).preset_coordinate(static_cast<std::int32_t>(pulses));
}

void change_sync(Simple2R3& device, Cell cell, Value) { device.axis(cell.argument).sync_changed(); }

void change_speed(Simple2R3& device, Cell cell, Value) { device.axis(cell.argument).speed_changed(); }

void start_incremental(Simple2R3& device, Cell cell, Value) {
  for_each_axis(cell, [&](int axis) {
    device.axis(axis).start_move(Command::incremental, own_parameters(device, axis));
  });
}

void start_absolute(Simple2R3& device, Cell cell, Value) {
  for_each_axis(cell, [&](int axis) {
    device.axis(axis).start_move(Command::absolute, from_here(device, axis, own_parameters(device, axis)));
  });
}

void start_incremental_by_set(Simple2R3& device, Cell cell, Value set) {
  const MoveParameters move = parameters_of_set(device, set);
  for_each_axis(cell, [&](int axis) {
    show_set(device, axis, move);
    device.axis(axis).start_move(Command::incremental, move);
  });
}

void start_absolute_by_set(Simple2R3& device, Cell cell, Value set) {
  const MoveParameters move = parameters_of_set(device, set);
  for_each_axis(cell, [&](int axis) {
    show_set(device, axis, move);
    device.axis(axis).start_move(Command::absolute, from_here(device, axis, move));
  });
}

void stop_motion(Simple2R3& device, Cell cell, Value) {
  for_each_axis(cell, [&](int axis) { device.axis(axis).stop(Stopping::by_register); });
}

void switch_servo(Simple2R3& device, Cell cell, Value on) {
  for_each_axis(cell, [&](int axis) { device.axis(axis).switch_servo(on != 0); });
}

void clear_alarm(Simple2R3& device, Cell cell, Value) {
  for_each_axis(cell, [&](int axis) { device.axis(axis).clear_alarm(); });
}

void go_home(Simple2R3& device, Cell cell, Value) {
  for_each_axis(cell, [&](int axis) { device.axis(axis).go_home(true); });
}

void command_velocity(Simple2R3& device, Cell cell, Value milli_rpm) {
  // The manual notes next to the high word that the speed takes effect, so a low word written alone has to
  // wait for the high word.
  if (!cell.high_half && !device.chose(option("velocity_commit", "takes_effect"))) {
    return say_ignored(device, "the low word of the velocity until the high word is written",
                       "the high word makes the speed take effect",
                       option("velocity_commit", "takes_effect"));
  }
  device.axis(cell.argument).run_velocity(milli_rpm);
}

void run_velocity_by_set(Simple2R3& device, Cell cell, Value set) {
  const auto& image = device.state().image;
  const std::uint32_t milli_rpm = image[slot("Parms_mRPM{}") + static_cast<std::size_t>(set - 1)];
  for_each_axis(cell, [&](int axis) {
    device.axis(axis).show_velocity(static_cast<std::int32_t>(milli_rpm));
    device.axis(axis).run_velocity(static_cast<std::int32_t>(milli_rpm));
  });
}

void command_pwm(Simple2R3& device, Cell cell, Value percent) {
  device.axis(cell.argument).output_pwm(static_cast<std::uint8_t>(percent));
}

void command_following(Simple2R3& device, Cell cell, Value) {
  for_each_axis(cell, [&](int axis) { device.axis(axis).follow_encoder(); });
}

void preset_timer(Simple2R3& device, Cell cell, Value value) {
  device.state().timers[static_cast<std::size_t>(cell.argument)].set(static_cast<std::uint32_t>(value),
                                                                     device.setup().timer_time());
}

void start_program(Simple2R3& device, Cell, Value line) {
  if (!is_unlocked(device) && device.chose(option("locked_start", "ignored")))
    return say_ignored(device, "the start", kLocked, option("locked_start", "ignored"));
  device.programs().start(static_cast<std::uint8_t>(line));
}

void stop_program(Simple2R3& device, Cell, Value) { device.programs().stop(); }

void write_cell(Simple2R3& device, Cell cell, Value value) {
  const int number = 4 * cell.index + cell.argument;
  if (is_write_protected(device)) {
    device.state().image[cell_slot(cell)] = device.state().program.cell(number);
    return say_ignored(device, "the write to the program", kLocked, option("locked_writes", "ignored"));
  }
  device.state().program.set_cell(number, static_cast<std::uint8_t>(value));
}

void enter_password(Simple2R3& device, Cell, Value) { device.kept().judge_lock(); }

void change_password(Simple2R3& device, Cell, Value password) {
  device.kept().change_password(static_cast<std::uint16_t>(password));
}

void erase_program(Simple2R3& device, Cell, Value) {
  if (is_write_protected(device))
    return say_ignored(device, "the erasure", kLocked, option("locked_writes", "ignored"));
  device.power().erase_program();
}

void reset_to_factory(Simple2R3& device, Cell, Value) { device.power().reset_to_factory(); }

}  // namespace understudy::emulator::models::simple2_r3
