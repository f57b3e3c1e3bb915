#include "emulator/devices/simple2_r3/device.h"

#include <algorithm>

#include "emulator/devices/simple2_r3/axis_slots.h"
#include "emulator/devices/simple2_r3/choices.h"
#include "emulator/devices/simple2_r3/model.h"
#include "emulator/devices/simple2_r3/program_machine.h"
#include "motion/homing_tables.h"

namespace understudy::emulator::simple2_r3 {

namespace {

// A half of a 32-bit register may have been written alone, so it can be anything: 0 would divide by zero.
std::uint32_t resolution_of(const State& state, int axis) {
  return std::clamp<std::uint32_t>(state.image[kAxisSlots[static_cast<std::size_t>(axis)].resolution], 1,
                                   0x8000'0000U);
}

}  // namespace

Simple2R3::Simple2R3(const DeviceSettings& given) : Device(simple2_r3::model(), given) {
  dialect_ = dialect_of(*this);
  state_.eeprom = factory_memory();
  set_input(kFirstSwitch, settings().baud == simple2_r3::model().rtu.bauds.back() ? 1 : 0);  // DIP1
}

Addressing Simple2R3::addressing(std::uint8_t address) const {
  const int rotary_switch = settings().address;
  if (rotary_switch == 0) {
    return address == 0 && choice(kSwitch0Broadcast) == 1 ? Addressing::obey_silently
                                                          : Addressing::obey_and_reply;
  }
  if (address == rotary_switch) return Addressing::obey_and_reply;
  if (address == 0 && choice(kStation0Request) == 0) return Addressing::obey_silently;
  return Addressing::ignore;
}

pty::LineSettings Simple2R3::line_settings() const {
  pty::LineSettings line = Device::model().rtu.settings;
  line.baud = Device::model().rtu.bauds[dip_switch(0) ? 1 : 0];
  return line;
}

bool Simple2R3::assigned_input(std::size_t assignment_slot, int number) const {
  return state_.image[assignment_slot] != 0 && ((state_.inputs >> number) & 1) != 0;
}

bool Simple2R3::alarm(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  if (state_.image[slots.alarm_assigned] == 0) return false;
  const bool on = ((state_.inputs >> slots.alarm_input) & 1) != 0;
  return on != (state_.image[slots.alarm_polarity] == 1);
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
    if (number == slots.servo_output && state_.image[slots.servo_output_assigned] != 0) {
      return state_.axes[static_cast<std::size_t>(axis)].motor.servo_on ==
             (state_.image[slots.servo_polarity] == 1);
    }
    if (number == slots.alarm_clear_output && state_.image[slots.alarm_clear_output_assigned] != 0) {
      return alarm_clear(axis);
    }
  }
  return ((state_.written_outputs >> number) & 1) != 0;
}

motion::SpeedLaw Simple2R3::law_of(int axis, std::uint32_t speed_rpm, std::uint32_t acceleration_10ms,
                                   std::uint32_t deceleration_10ms) const {
  // Times of 0 count as 1 (appendix A), that is 10 ms.
  const auto by_time = [](std::uint32_t time_10ms) {
    return motion::RampLaw::by_time(std::max(time_10ms, 1U) / 100.0);
  };
  const double speed_pps = static_cast<double>(speed_rpm) * resolution_of(state_, axis) / 60.0;
  return {.top_speed_u_s = std::min(speed_pps, static_cast<double>(kMaxPulseRate_pps)),
          .up = by_time(acceleration_10ms),
          .down = by_time(deceleration_10ms)};
}

motion::Signals Simple2R3::signals_of(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  motion::Signals on = 0;
  const auto add = [&](motion::Signal signal, bool is_on) {
    if (is_on) on |= motion::bit(signal);
  };
  add(motion::Signal::alarm, alarm(axis));
  add(motion::Signal::limit_plus, upper_limit(axis));
  add(motion::Signal::limit_minus, lower_limit(axis));
  add(motion::Signal::home, assigned_input(slots.home_assigned, slots.home_input));
  return on;
}

void Simple2R3::refresh_signals(int axis) {
  state_.axes[static_cast<std::size_t>(axis)].motor.signals = signals_of(axis);
}

void Simple2R3::start_move(int axis_number, Command command, const MoveParameters& move) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  if (!axis.motor.servo_on) return;
  if (choice(kAlarmReaction) == 0 && alarm(axis_number)) return;
  stop(axis_number);
  if (move.distance_pulses == 0) return;
  refresh_signals(axis_number);
  const int direction = move.distance_pulses < 0 ? -1 : +1;
  const motion::Cause refused =
      move.speed_rpm == 0
          ? axis.motor.hang(direction)
          : axis.motor.move(
                move.distance_pulses,
                law_of(axis_number, move.speed_rpm, move.acceleration_10ms, move.deceleration_10ms), now());
  if (refused == motion::Cause::none) axis.command = command;
}

void Simple2R3::go_home(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  if (!axis.motor.servo_on) return;
  if (choice(kAlarmReaction) == 0 && alarm(axis_number)) return;
  stop(axis_number);
  axis.homed = false;
  refresh_signals(axis_number);
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis_number)];
  const std::uint32_t time_10ms = state_.image[slots.home_acc_time];
  const motion::Cause refused = axis.motor.home(
      motion::simple2_homing(
          {.way = state_.image[slots.home_direction] != 0 ? +1 : -1,
           .speed = law_of(axis_number, state_.image[slots.home_speed], time_10ms, time_10ms)}),
      now());
  if (refused == motion::Cause::none) axis.command = Command::homing;
}

void Simple2R3::run_velocity(int axis, std::int64_t milli_rpm) {
  refresh_signals(axis);
  simple2_r3::run_velocity(state_.axes[static_cast<std::size_t>(axis)], milli_rpm);
}

void Simple2R3::output_pwm(int axis, std::uint8_t percent) {
  refresh_signals(axis);
  simple2_r3::output_pwm(state_.axes[static_cast<std::size_t>(axis)], percent);
}

void Simple2R3::follow_encoder(int axis) {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  refresh_signals(axis);
  const auto pps = [&](std::uint32_t rpm) {
    const std::int64_t speed = static_cast<std::int64_t>(rpm) * resolution_of(state_, axis) / 60;
    return std::clamp<std::int64_t>(speed, 1, kMaxPulseRate_pps);
  };
  const std::uint32_t slope_rpm = state_.image[slots.sync_slope];
  simple2_r3::follow_encoder(state_.axes[static_cast<std::size_t>(axis)],
                             {.numerator = state_.image[slots.sync_numerator],
                              .denominator = std::max<std::int64_t>(state_.image[slots.sync_denominator], 1),
                              .period_ticks = 5,  // 200 Hz (appendix B)
                              .top_speed_pps = pps(state_.image[slots.sync_speed]),
                              // Of each 5 ms; 0 is without bound.
                              .slope_pps = slope_rpm == 0 ? 0 : pps(slope_rpm)});
}

void Simple2R3::stop(int axis) { stop_drive(state_.axes[static_cast<std::size_t>(axis)]); }

void Simple2R3::switch_servo(int axis, bool on) {
  if (!on) stop(axis);
  state_.axes[static_cast<std::size_t>(axis)].motor.switch_servo(on);
}

void Simple2R3::start_program(std::uint8_t line) { interpreter::simple2::start(state_.execution, line); }

void Simple2R3::stop_program() { interpreter::simple2::stop(state_.execution); }

std::uint16_t Simple2R3::adc_at(int number) const {
  // 12 bits, and 4000 at 10 V as the factory's calibration has it.
  return static_cast<std::uint16_t>(std::clamp(input(kFirstAnalog + number) * 2 / 5, 0, 4095));
}

void Simple2R3::sample_inputs(Tick) {
  state_.inputs = 0;
  for (int i = 0; i < kInputCount; ++i) state_.inputs |= static_cast<std::uint16_t>(input(i) << i);
  for (int i = 0; i < kAnalogCount; ++i) state_.adc[static_cast<std::size_t>(i)] = adc_at(i);
  state_.touched = false;
}

bool Simple2R3::starts_by_itself() const { return state_.image[slot("AutoStart_MainProg")] != 0; }

void Simple2R3::run_interpreters(Tick tick) {
  if (tick == state_.first_tick && starts_by_itself()) start_program(0);
  if (!state_.execution.running || tick % interpreter::simple2::kSlotMs != 0) return;
  ProgramMachine machine(*this);
  interpreter::simple2::step(state_.execution, tick, state_.program, dialect_, machine);
}

void Simple2R3::step_motion(Tick tick) {
  for (int number = 0; number < 2; ++number) {
    AxisState& axis = state_.axes[static_cast<std::size_t>(number)];
    const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(number)];
    if (const motion::Signals on = signals_of(number); on != axis.signals.steady) {
      axis.signals.steady = on;
      ++axis.signals.version;
    }
    const std::uint32_t resolution = resolution_of(state_, number);
    const std::uint32_t acceleration = std::max(state_.image[slots.velocity_acceleration], 1U);
    const std::int64_t commanded =
        step_drive(axis,
                   {.pulses_per_revolution = resolution,
                    .velocity_step_urpm = choice(kVelocityUnit) == 0 ? acceleration : acceleration * 1000,
                    .encoder_reversed = state_.image[slots.encoder_polarity] != 0},
                   tick);
    const bool reversed = state_.image[slots.direction_polarity] != 0;
    axis.pulses_this_tick = reversed ? -commanded : commanded;
    const std::int64_t counted = quirk_coordinate_counts_physical_sense() ? axis.pulses_this_tick : commanded;
    // Wraps at 32 bits.
    axis.coordinate_pulses = static_cast<std::int32_t>(static_cast<std::uint32_t>(axis.coordinate_pulses) +
                                                       static_cast<std::uint32_t>(counted));
    const bool home_found = (axis.motor.events & motion::bit(motion::Event::homed)) != 0;
    if (home_found && choice(kHomeCoordinate) == 0) axis.coordinate_pulses = 0;
  }
}

void Simple2R3::update_outputs(Tick tick) {
  for (AxisState& axis : state_.axes) {
    remember_encoder(axis, tick);
    if (tick >= axis.alarm_clear_until) axis.alarm_clear_until = 0;
  }
  state_.eeprom.step(tick, state_.image);
}

Tick Simple2R3::next_active_tick(Tick done) const {
  if (state_.touched) return done + 1;
  for (int i = 0; i < kInputCount; ++i) {
    if (input(i) != ((state_.inputs >> i) & 1)) return done + 1;
  }
  for (int i = 0; i < kAnalogCount; ++i) {
    if (adc_at(i) != state_.adc[static_cast<std::size_t>(i)]) return done + 1;
  }
  if (done < state_.first_tick && starts_by_itself()) return state_.first_tick;
  Tick next = state_.eeprom.next_active_tick();
  if (state_.execution.running) {
    next = std::min(next, done + interpreter::simple2::kSlotMs - done % interpreter::simple2::kSlotMs);
  }
  for (int number = 0; number < 2; ++number) {
    const AxisState& axis = state_.axes[static_cast<std::size_t>(number)];
    if (signals_of(number) != axis.signals.steady) return done + 1;
    next = std::min(next, simple2_r3::next_active_tick(axis, done));
    if (axis.alarm_clear_until > done) next = std::min(next, axis.alarm_clear_until);
  }
  return next;
}

bool Simple2R3::same_state(const Device& other) const {
  const auto* that = dynamic_cast<const Simple2R3*>(&other);
  return that != nullptr && that->now() == now() && that->state_ == state_;
}

bool Simple2R3::output(int terminal) const {
  return terminal >= kFirstOutput && terminal < kFirstOutput + kOutputCount &&
         output_level(terminal - kFirstOutput);
}

std::int64_t Simple2R3::pulses_this_tick(int axis) const {
  return state_.axes[static_cast<std::size_t>(axis)].pulses_this_tick;
}

double Simple2R3::speed_pps(int axis) const {
  const auto number = static_cast<std::size_t>(axis);
  const double speed = simple2_r3::speed_pps(state_.axes[number], now(), resolution_of(state_, axis));
  return state_.image[kAxisSlots[number].direction_polarity] != 0 ? -speed : speed;
}

void Simple2R3::set_encoder(int axis, std::int64_t counts) {
  state_.axes[static_cast<std::size_t>(axis)].encoder_counts = counts;
}

}  // namespace understudy::emulator::simple2_r3
