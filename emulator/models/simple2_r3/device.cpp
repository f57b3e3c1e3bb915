#include "emulator/models/simple2_r3/device.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/prefetch.h"
#include "base/simulated_time.h"
#include "base/state/state_bytes.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/kept_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/stateful_device.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/model.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/program_machine.h"
#include "emulator/models/simple2_r3/registers.h"
#include "interpreter/simple2/execution/execution.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

bool starts_by_itself(const State& state) { return state.image[slot("AutoStart_MainProg")] != 0; }

std::int32_t in_32_bits(std::int64_t value, bool saturates) {
  if (saturates) return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, INT32_MIN, INT32_MAX));
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
}

}  // namespace

std::uint32_t resolution_of(const State& state, int axis) {
  return std::clamp<std::uint32_t>(state.image[kAxisSlots[static_cast<std::size_t>(axis)].resolution], 1,
                                   0x8000'0000U);
}

Simple2R3::Simple2R3(const DeviceSettings& given)
    : StatefulDevice(simple2_r3::model(), given),
      RegisterBankOf(*this, *simple2_r3::model().registers, given.firmware),
      KeptMemory(simple2_r3::model().name, given.firmware) {
  dialect_ = dialect_of(*this);
  map_policy_ = chosen_map_policy();
  timer_unit_ = chose(option("timer_unit", "10ms")) ? 10 : chose(option("timer_unit", "100ms")) ? 100 : 1;
  assigned_at_power_up_ = chose(option("assignment_effect", "at_power_up"));
  adc_10_bits_ = chose(option("adc_width", "10_bits_100_a_volt"));
  motion_first_ = chose(option("tick_order", "motion"));
  limits_physical_ = chose(option("limit_sense", "physical"));
  alarm_latches_ = chose(option("alarm_latch", "latched"));
  alarm_takes_servo_ = chose(option("alarm_reaction", "stops_and_servo_off"));
  coordinate_saturates_ = chose(option("coordinate_overflow", "saturates"));
  velocity_unit_urpm_ = chose(option("velocity_unit", "two_rpm_per_second")) ? 1000 : 1;
  velocity_pulses_first_ = chose(option("velocity_step", "pulses"));
  velocity_settings_latched_ = chose(option("velocity_settings", "next_command"));
  stops_with_encoder_ = chose(option("sync_slope_end", "stops"));
  sync_follows_other_ = chose(option("sync_encoder", "other"));
  counts_physical_sense_ = firmware() <= 140;
  boot_ticks_ = chose(option("boot_time", "100ms")) ? 100 : chose(option("boot_time", "1s")) ? 1000 : 0;
  state_.eeprom = factory_memory();
  set_input(kFirstSwitch, Device::line_settings(0).baud == line_bauds().back() ? 1 : 0);  // DIP1
}

Addressing Simple2R3::addressing(std::uint8_t address) const {
  if (now() + 1 < state_.first_tick) return Addressing::ignore;  // not up yet
  const int rotary_switch = *station_number();
  if (rotary_switch == 0) {
    return address == 0 && chose(option("switch_0_broadcast", "silent")) ? Addressing::obey_silently
                                                                         : Addressing::obey_and_reply;
  }
  if (address == rotary_switch) return Addressing::obey_and_reply;
  if (address == 0 && !chose(option("station_0_request", "ignored"))) return Addressing::obey_silently;
  return Addressing::ignore;
}

MapPolicy Simple2R3::chosen_map_policy() const {
  MapPolicy policy = map().policy();
  if (chose(option("unmapped_addresses", "zero_and_ignored")))
    policy.unmapped = MapPolicy::Unmapped::reads_zero;
  if (chose(option("write_to_read_only", "ignored"))) policy.read_only = MapPolicy::ReadOnly::ignores_writes;
  if (chose(option("read_of_write_only", "exception_02"))) policy.write_only = MapPolicy::WriteOnly::refused;
  if (chose(option("half_writes", "judged_with_other_half")))
    policy.halves = MapPolicy::Halves::judged_with_the_other;
  if (chose(option("write_out_of_range", "clamped"))) policy.out_of_range = MapPolicy::OutOfRange::clamped;
  if (chose(option("request_with_bad_value", "those_before_stored")))
    policy.partly = MapPolicy::Partly::up_to_the_refused;
  if (chose(option("request_effects", "each_in_its_turn"))) policy.effects = MapPolicy::Effects::one_by_one;
  return policy;
}

std::span<const int> Simple2R3::line_bauds() const { return Device::model().line.ports.front().bauds; }

pty::LineSettings Simple2R3::line_settings(std::size_t port) const {
  pty::LineSettings line = Device::line_settings(port);
  line.baud = line_bauds()[dip_switch(0) ? 1 : 0];
  return line;
}

bool Simple2R3::assigned(std::size_t assignment_slot) const {
  if (!assigned_at_power_up_) return state_.image[assignment_slot] != 0;
  return ((state_.assignments >> (assignment_slot - kFirstAssignment)) & 1) != 0;
}

bool Simple2R3::assigned_input(std::size_t assignment_slot, int number) const {
  return assigned(assignment_slot) && ((inputs() >> number) & 1) != 0;
}

bool Simple2R3::alarm(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  if (!assigned(slots.alarm_assigned)) return false;
  const bool on = ((inputs() >> slots.alarm_input) & 1) != 0;
  return on != (state_.image[slots.alarm_polarity] == 1) ||
         state_.axes[static_cast<std::size_t>(axis)].alarm_latched;
}

bool Simple2R3::ready(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return assigned_input(slots.ready_assigned, slots.ready_input);
}

bool Simple2R3::upper_limit(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return assigned_input(slots.upper_assigned, slots.upper_input);
}

bool Simple2R3::lower_limit(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return assigned_input(slots.lower_assigned, slots.lower_input);
}

bool Simple2R3::alarm_clear(int axis) const {
  return now() < state_.axes[static_cast<std::size_t>(axis)].alarm_clear_until;
}

bool Simple2R3::output_level(int number) const {
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

void Simple2R3::write_outputs(std::uint8_t which, std::uint8_t levels) {
  // DOUT 0 to 3 are the first of the registers that assign functions.
  for (unsigned n = 0; n < 4 && chose(option("write_under_function", "ignored")); ++n) {
    if (assigned(kFirstAssignment + n)) which = static_cast<std::uint8_t>(which & ~(1U << n));
  }
  std::uint8_t& outputs = state_.written_outputs;
  outputs = static_cast<std::uint8_t>((outputs & ~which) | (levels & which));
}

motion::Signals Simple2R3::signals_of(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  motion::Signals on = 0;
  const auto add = [&](motion::Signal signal, bool is_on) {
    if (is_on) on |= motion::bit(signal);
  };
  add(motion::Signal::alarm, alarm(axis));
  const bool swapped = limits_physical_ && state_.image[slots.direction_polarity] != 0;
  add(motion::Signal::limit_plus, swapped ? lower_limit(axis) : upper_limit(axis));
  add(motion::Signal::limit_minus, swapped ? upper_limit(axis) : lower_limit(axis));
  add(motion::Signal::home, assigned_input(slots.home_assigned, slots.home_input));
  return on;
}

std::uint16_t Simple2R3::adc_at(int number) const {
  // Millivolts. As the factory's calibration has it: 4000 at 10 V, or 1000.
  const std::int32_t level = input(kFirstAnalog + number);
  const std::int32_t adc = adc_10_bits_ ? std::min(level / 10, 1023) : std::min(level * 2 / 5, 4095);
  return static_cast<std::uint16_t>(std::max(adc, 0));
}

std::uint16_t Simple2R3::input_levels() const {
  std::uint32_t levels = 0;
  for (int i = 0; i < kInputCount; ++i) levels |= static_cast<std::uint32_t>(input(i)) << i;
  return static_cast<std::uint16_t>(levels);
}

void Simple2R3::sample_inputs(Tick) {
  if (!take_inputs_changed()) return;
  const std::uint16_t levels = input_levels();
  if (levels != state_.inputs) state_.touched = true;
  state_.inputs = levels;
  for (int i = 0; i < kAnalogCount; ++i) state_.adc[static_cast<std::size_t>(i)] = adc_at(i);
}

bool Simple2R3::sees_something_new() const {
  if (!inputs_changed()) return false;
  if (input_levels() != state_.inputs) return true;
  for (int i = 0; i < kAnalogCount; ++i) {
    if (adc_at(i) != state_.adc[static_cast<std::size_t>(i)]) return true;
  }
  return false;
}

void Simple2R3::run_interpreters(Tick tick) {
  if (!motion_first_) run_program(tick);
}

void Simple2R3::run_program(Tick tick) {
  if (tick == state_.first_tick && starts_by_itself(state_)) start_program(0);
  if (!state_.execution.running || tick % interpreter::simple2::kSlotMs != 0) return;
  ProgramMachine machine(*this);
  if (program_watch_ != nullptr) {
    program_watch_->look(hash_of(std::as_bytes(std::span(state_.program.lines()))));
    machine.set_watch(program_watch_);
  }
  interpreter::simple2::step(state_.execution, tick, state_.program, dialect_, machine);
  if (!state_.execution.running) program_has_ended();
}

void Simple2R3::apply_servo_state(int axis_number) {
  motion::Axis& motor = state_.axes[static_cast<std::size_t>(axis_number)].motor;
  const bool matters = servo_matters(axis_number);
  if (matters == motor.settings.needs_servo) return;
  motor.settings.needs_servo = matters;
  if (lacks_servo(axis_number)) stop(axis_number);
}

// Called for each axis in every tick; with two callers the compiler would not inline it by itself.
[[gnu::always_inline]] inline DriveSettings Simple2R3::drive_settings(int number) const {
  const AxisState& axis = state_.axes[static_cast<std::size_t>(number)];
  DriveSettings settings{.encoder_counts = followed_count(number),
                         .stops_with_encoder = stops_with_encoder_,
                         .pulses_by_speed_before = velocity_pulses_first_};
  if (axis.mode == Mode::velocity) {
    const bool latched = velocity_settings_latched_;
    settings.pulses_per_revolution = latched ? axis.velocity_resolution : resolution_of(state_, number);
    settings.velocity_step_urpm = latched ? axis.velocity_step_urpm : velocity_step_urpm(number);
  }
  return settings;
}

void Simple2R3::step_motion(Tick tick) {
  for (int number = 0; number < 2; ++number) {
    AxisState& axis = state_.axes[static_cast<std::size_t>(number)];
    const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(number)];
    if (alarm_latches_) axis.alarm_latched = alarm(number);
    if (alarm_takes_servo_ && axis.motor.servo_on && alarm(number)) switch_servo(number, false);
    if (state_.touched || alarm_latches_) {
      apply_servo_state(number);
      apply_signals(number, signals_of(number));
    }
    const std::int64_t commanded = step_drive(axis, drive_settings(number), tick);
    const bool reversed = state_.image[slots.direction_polarity] != 0;
    axis.pulses_this_tick = reversed ? -commanded : commanded;
    const std::int64_t counted = quirk_coordinate_counts_physical_sense() ? axis.pulses_this_tick : commanded;
    axis.coordinate_pulses = in_32_bits(axis.coordinate_pulses + counted, coordinate_saturates_);
    const bool home_found = (axis.motor.events & motion::bit(motion::Event::homed)) != 0;
    if (home_found && !chose(option("home_coordinate", "kept"))) axis.coordinate_pulses = 0;
  }
  state_.touched = false;
  if (motion_first_) {
    set_now(tick);  // what a line starts begins in the next tick
    run_program(tick);
  }
}

void Simple2R3::update_outputs(Tick tick) {
  for (AxisState& axis : state_.axes) {
    remember_encoder(axis, tick);
    if (tick >= axis.alarm_clear_until) axis.alarm_clear_until = 0;
  }
  state_.eeprom.step(tick, state_.image);
}

/// The next tick in which the program does anything. One that waits is asked only until it is found to wait
/// on: what it waits for is a tick of its own.
Tick Simple2R3::next_slot(Tick done) const {
  if (state_.execution.held.command == 0) {
    return done + interpreter::simple2::kSlotMs - done % interpreter::simple2::kSlotMs;
  }
  const ProgramView machine(*this);
  return interpreter::simple2::next_active_slot_ms(state_.execution, done, state_.program, dialect_, machine);
}

Tick Simple2R3::next_tick_without_axes(Tick done) const {
  if (state_.touched) return done + 1;
  Tick next = state_.eeprom.next_active_tick();  // it goes on while the device boots
  if (done < state_.first_tick && starts_by_itself(state_)) next = std::min(next, state_.first_tick);
  if (state_.execution.running) next = std::min(next, next_slot(done));
  for (const AxisState& axis : state_.axes) {
    if (axis.alarm_clear_until > done) next = std::min(next, axis.alarm_clear_until);
  }
  return next;
}

Tick Simple2R3::next_active_tick(Tick done) const {
  // Cheapest first: an axis that moves is active in every tick, and then nothing else needs to be asked.
  for (const AxisState& axis : state_.axes) {
    if (simple2_r3::next_active_tick(axis, done) == done + 1) return done + 1;
  }
  const Tick next = next_tick_without_axes(done);
  if (next > done + 1 && sees_something_new()) return done + 1;
  return next;
}

Crossing Simple2R3::crossing(int axis, Tick done, const ClearTravel& ahead) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return {.done = done,
          .settings = drive_settings(axis),
          .reversed = state_.image[slots.direction_polarity] != 0,
          .encoder_reversed = state_.image[slots.encoder_polarity] != 0,
          .axis = axis,
          .ahead = &ahead};
}

Tick Simple2R3::next_event_tick(Tick done, Tick most, const ClearTravel& ahead) const {
  Tick last = std::min(most, next_tick_without_axes(done) - 1);
  for (int axis = 0; axis < 2 && last > done; ++axis) {
    last = quiet_until(state_.axes[static_cast<std::size_t>(axis)], crossing(axis, done, ahead), last);
  }
  return last > done && sees_something_new() ? done + 1 : last + 1;
}

void Simple2R3::fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                                std::span<std::int64_t> pulses) {
  for (int number = 0; number < 2; ++number) {
    const auto n = static_cast<std::size_t>(number);
    AxisState& axis = state_.axes[n];
    const Crossing by = crossing(number, done, ahead);
    const std::int64_t commanded = cross(axis, by, tick);
    const std::int64_t sent = by.reversed ? -commanded : commanded;
    const std::int64_t counted = quirk_coordinate_counts_physical_sense() ? sent : commanded;
    axis.coordinate_pulses = in_32_bits(axis.coordinate_pulses + counted, coordinate_saturates_);
    pulses[n] += sent;
  }
}

void Simple2R3::prefetch(Tick tick) const {
  Device::prefetch(tick);
  prefetch_line(&dialect_);
  prefetch_line(&state_);
  for (const AxisState& axis : state_.axes) simple2_r3::prefetch(axis, tick);
  prefetch_line(&state_.image[slot("Aaxis_DIR_Polarity")]);  // with the other polarities
  if (tick % interpreter::simple2::kSlotMs != 0) return;
  understudy::prefetch(&state_.image[slot("PROG_VAR{}")], 32 * sizeof(std::uint32_t));
  prefetch_line(&state_.image[slot("Counter1_Value")]);
  prefetch_line(&state_.program);
}

bool Simple2R3::output(int terminal) const {
  return terminal >= kFirstOutput && terminal < kFirstOutput + kOutputCount &&
         output_level(terminal - kFirstOutput);
}

std::int64_t Simple2R3::pulses_this_tick(int axis) const {
  return state_.axes[static_cast<std::size_t>(axis)].pulses_this_tick;
}

std::uint32_t Simple2R3::resolution_in_velocity(int axis) const {
  const AxisState& state = state_.axes[static_cast<std::size_t>(axis)];
  return velocity_settings_latched_ ? state.velocity_resolution : resolution_of(state_, axis);
}

double Simple2R3::speed_pps(int axis) const {
  const auto number = static_cast<std::size_t>(axis);
  const AxisState& state = state_.axes[number];
  const double speed = simple2_r3::speed_pps(state, now(), resolution_in_velocity(axis));
  const bool reversed = state_.image[kAxisSlots[number].direction_polarity] != 0;
  return (reversed ? -speed : speed) + 0.0;  // 0 has no sign
}

std::optional<bool> Simple2R3::servo_on(int axis) const {
  return powered() && state_.axes[static_cast<std::size_t>(axis)].motor.servo_on;
}

std::int64_t Simple2R3::pulses_to_come(int axis) const {
  const auto number = static_cast<std::size_t>(axis);
  const std::int64_t pulses = state_.axes[number].motor.pulses_to_come();
  return state_.image[kAxisSlots[number].direction_polarity] != 0 ? -pulses : pulses;
}

std::span<const std::string_view> Simple2R3::pulse_formats() const {
  static constexpr std::array<std::string_view, 2> kFormats{"CW/CCW", "PLS/DIR"};  // by DIP2
  return kFormats;
}

std::optional<int> Simple2R3::duty_percent(int axis) const {
  return pwm_duty(state_.axes[static_cast<std::size_t>(axis)]);
}

void Simple2R3::set_encoder(int axis, std::int64_t counts) {
  const auto number = static_cast<std::size_t>(axis);
  count_encoder(state_.axes[number], counts, state_.image[kAxisSlots[number].encoder_polarity] != 0);
}

}  // namespace understudy::emulator::models::simple2_r3
