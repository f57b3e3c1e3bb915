#include "emulator/devices/simple2_r3/device.h"

#include <algorithm>
#include <cstdlib>

#include "emulator/devices/simple2_r3/axis_slots.h"
#include "emulator/devices/simple2_r3/choices.h"
#include "emulator/devices/simple2_r3/model.h"
#include "motion/move.h"

namespace understudy::emulator::simple2_r3 {

namespace {

constexpr double kMaxPulseRate_pps = 100'000;  // appendix B

// A half of a 32-bit register may have been written alone, so it can be anything: 0 would divide by zero.
std::uint32_t resolution_of(const State& state, int axis) {
  return std::clamp<std::uint32_t>(state.image[kAxisSlots[static_cast<std::size_t>(axis)].resolution], 1,
                                   0x8000'0000U);
}

}  // namespace

Simple2R3::Simple2R3(const DeviceSettings& given) : Device(simple2_r3::model(), given) {
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    for (int i = 0; i < row.count; ++i) state_.image[next++] = static_cast<std::uint32_t>(row.factory);
  }
  for (AxisState& axis : state_.axes) axis.servo_on = choice(kServoAtPowerUp) == 1;
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
  line.baud = settings().baud;
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

bool Simple2R3::blocked(int axis, int direction) const {
  if (choice(kLimitReaction) == 1) return false;
  return direction > 0 ? upper_limit(axis) : lower_limit(axis);
}

bool Simple2R3::output_level(int number) const {
  for (int axis = 0; axis < 2; ++axis) {
    const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
    if (number == slots.servo_output && state_.image[slots.servo_output_assigned] != 0) {
      return state_.axes[static_cast<std::size_t>(axis)].servo_on ==
             (state_.image[slots.servo_polarity] == 1);
    }
    if (number == slots.alarm_clear_output && state_.image[slots.alarm_clear_output_assigned] != 0) {
      return alarm_clear(axis);
    }
  }
  return ((state_.written_outputs >> number) & 1) != 0;
}

void Simple2R3::start_move(int axis_number, Command command, const MoveParameters& move) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  if (!axis.servo_on) return;
  if (choice(kAlarmReaction) == 0 && alarm(axis_number)) return;
  stop(axis_number);
  if (move.distance_pulses == 0) return;
  const int direction = move.distance_pulses < 0 ? -1 : +1;
  if (blocked(axis_number, direction)) return;

  axis.command = command;
  if (move.speed_rpm == 0) {
    axis.motor.hang(direction);
    return;
  }
  // Times of 0 count as 1 (appendix A), that is 10 ms.
  const auto seconds = [](std::uint32_t time_10ms) { return std::max(time_10ms, 1U) / 100.0; };
  const double speed_pps = static_cast<double>(move.speed_rpm) * resolution_of(state_, axis_number) / 60.0;
  const motion::SpeedLaw law{
      .top_speed_u_s = std::min(speed_pps, kMaxPulseRate_pps),
      .up = motion::RampLaw::by_time(seconds(move.acceleration_10ms)),
      .down = motion::RampLaw::by_time(seconds(move.deceleration_10ms)),
  };
  axis.motor.start(motion::plan(static_cast<double>(std::abs(move.distance_pulses)), law), direction,
                   now() + 1);
}

void Simple2R3::stop(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  axis.motor.stop();
  axis.command = Command::none;
}

void Simple2R3::switch_servo(int axis, bool on) {
  if (!on) stop(axis);
  state_.axes[static_cast<std::size_t>(axis)].servo_on = on;
}

void Simple2R3::reset_to_factory() {
  constexpr std::size_t kFirstSurvivor = slot("ADC_10V_A");
  constexpr std::size_t kLastSurvivor = slot("ADC_1V_B");
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    const bool stays = !row.persistent && choice(kFactoryResetVolatile) == 1;
    for (int i = 0; i < row.count; ++i, ++next) {
      if (stays || (next >= kFirstSurvivor && next <= kLastSurvivor)) continue;
      state_.image[next] = static_cast<std::uint32_t>(row.factory);
    }
  }
  for (int axis = 0; axis < 2; ++axis) switch_servo(axis, false);
  if (choice(kFactoryResetVolatile) == 1) return;
  state_.written_outputs = 0;
  for (AxisState& axis : state_.axes) axis.alarm_clear_until = 0;
}

void Simple2R3::sample_inputs(Tick) {
  state_.inputs = 0;
  for (int i = 0; i < kInputCount; ++i) state_.inputs |= static_cast<std::uint16_t>(input(i) << i);
  state_.touched = false;
}

void Simple2R3::step_motion(Tick tick) {
  for (int number = 0; number < 2; ++number) {
    AxisState& axis = state_.axes[static_cast<std::size_t>(number)];
    axis.pulses_this_tick = 0;
    if (!axis.motor.moving()) continue;
    const bool alarmed = choice(kAlarmReaction) == 0 && alarm(number);
    if (alarmed || blocked(number, axis.motor.direction)) {
      stop(number);
      continue;
    }
    const std::int64_t commanded = axis.motor.step(tick);
    if (!axis.motor.moving()) axis.command = Command::none;
    const bool reversed = state_.image[kAxisSlots[static_cast<std::size_t>(number)].direction_polarity] != 0;
    axis.pulses_this_tick = reversed ? -commanded : commanded;
    const std::int64_t counted = quirk_coordinate_counts_physical_sense() ? axis.pulses_this_tick : commanded;
    // Wraps at 32 bits.
    axis.coordinate_pulses = static_cast<std::int32_t>(static_cast<std::uint32_t>(axis.coordinate_pulses) +
                                                       static_cast<std::uint32_t>(counted));
  }
}

void Simple2R3::update_outputs(Tick tick) {
  for (AxisState& axis : state_.axes) {
    if (tick >= axis.alarm_clear_until) axis.alarm_clear_until = 0;
  }
}

Tick Simple2R3::next_active_tick(Tick done) const {
  if (state_.touched) return done + 1;
  for (int i = 0; i < kInputCount; ++i) {
    if (input(i) != (((state_.inputs >> i) & 1) != 0)) return done + 1;
  }
  Tick next = kNever;
  for (const AxisState& axis : state_.axes) {
    next = std::min(next, axis.motor.next_active_tick(done));
    if (axis.pulses_this_tick != 0) next = std::min(next, done + 1);
    if (axis.alarm_clear_until > done) next = std::min(next, axis.alarm_clear_until);
  }
  return next;
}

bool Simple2R3::same_state(const Device& other) const {
  const auto* that = dynamic_cast<const Simple2R3*>(&other);
  return that != nullptr && that->now() == now() && that->state_ == state_;
}

bool Simple2R3::output(int terminal) const {
  return terminal >= kInputCount && output_level(terminal - kInputCount);
}

std::int64_t Simple2R3::pulses_this_tick(int axis) const {
  return state_.axes[static_cast<std::size_t>(axis)].pulses_this_tick;
}

void Simple2R3::set_encoder(int axis, std::int64_t counts) {
  state_.axes[static_cast<std::size_t>(axis)].encoder_counts = counts;
}

}  // namespace understudy::emulator::simple2_r3
