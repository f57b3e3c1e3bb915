// What Simple2-R3 is told to do: moves, homing, modes, servo and STOP, and its program. Registers and program
// lines come here alike. What a command is dropped for, and what it does to the one before it, is said here.
#include <algorithm>

#include "emulator/devices/simple2_r3/axis_slots.h"
#include "emulator/devices/simple2_r3/device.h"
#include "motion/homing_tables.h"

namespace understudy::emulator::simple2_r3 {

namespace {

constexpr Tick kAlarmClearTicks = 200;  // 0x1017, 0x1018

}  // namespace

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

void Simple2R3::refresh_signals(int axis) {
  state_.axes[static_cast<std::size_t>(axis)].motor.signals = signals_of(axis);
}

bool Simple2R3::is_too_fast(int axis, std::int64_t milli_rpm) const {
  const std::int64_t size = milli_rpm < 0 ? -milli_rpm : milli_rpm;
  return size * resolution_of(state_, axis) > kMaxPulseRate_pps * 60'000;
}

bool Simple2R3::lacks_ready(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return chose(kReadyNeeded) && assigned(slots.ready_assigned) && !ready(axis);
}

bool Simple2R3::is_positioning(int axis) const {
  return state_.axes[static_cast<std::size_t>(axis)].command != Command::none;
}

void Simple2R3::start_move(int axis_number, Command command, const MoveParameters& move) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  if (!axis.motor.servo_on || lacks_ready(axis_number)) return;
  if (is_positioning(axis_number) && chose(kMoveWhileMovingIgnored)) return;
  if (!chose(kAlarmIgnored) && alarm(axis_number)) return;
  if (chose(kTooFastDropped) && is_too_fast(axis_number, std::int64_t{1000} * move.speed_rpm)) return;
  std::int64_t distance_pulses = move.distance_pulses;
  if (command == Command::incremental && chose(kIncrementalFromOldTarget)) {
    distance_pulses += axis.motor.remaining_pulses() * axis.motor.drive.direction;
  }
  stop_drive(axis);
  if (distance_pulses == 0) return;
  refresh_signals(axis_number);
  const int direction = distance_pulses < 0 ? -1 : +1;
  const motion::Cause refused = move.speed_rpm == 0
                                    ? axis.motor.hang(direction)
                                    : axis.motor.move(distance_pulses,
                                                      law_of(axis_number, move.speed_rpm,
                                                             move.acceleration_10ms, move.deceleration_10ms),
                                                      tick_before_motion());
  if (refused != motion::Cause::none) return;
  axis.command = command;
  axis.has_own_speed = move.of_the_axis;
  if (chose(kHomeLeftByMotion)) axis.homed = false;
}

void Simple2R3::go_home(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis_number)];
  const std::uint32_t speed_rpm = state_.image[slots.home_speed];
  if (!axis.motor.servo_on || lacks_ready(axis_number)) return;
  if (is_positioning(axis_number) && chose(kMoveWhileMovingIgnored)) return;
  if (!chose(kAlarmIgnored) && alarm(axis_number)) return;
  if (chose(kTooFastDropped) && is_too_fast(axis_number, std::int64_t{1000} * speed_rpm)) return;
  if (chose(kHomeUnassignedDropped) && !assigned(slots.home_assigned)) return;
  stop_drive(axis);
  axis.homed = false;
  refresh_signals(axis_number);
  const std::uint32_t time_10ms = state_.image[slots.home_acc_time];
  const motion::Simple2Homing how{.way = state_.image[slots.home_direction] != 0 ? +1 : -1,
                                  .speed = law_of(axis_number, speed_rpm, time_10ms, time_10ms)};
  const motion::Cause refused =
      axis.motor.home(chose(kHomeAtFirstEdge) ? homing_to_first_edge(how) : motion::simple2_homing(how),
                      tick_before_motion());
  if (refused == motion::Cause::none) axis.command = Command::homing;
}

void Simple2R3::speed_changed(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const bool runs_by_it =
      axis.has_own_speed && (axis.command == Command::incremental || axis.command == Command::absolute);
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis_number)];
  const std::uint32_t speed_rpm = state_.image[slots.speed];
  if (!runs_by_it || speed_rpm == 0 || !chose(kSpeedAtOnce)) return;
  axis.motor.change_speed(
      law_of(axis_number, speed_rpm, state_.image[slots.acc_time], state_.image[slots.dec_time]), now());
}

void Simple2R3::preset_coordinate(int axis_number, std::int32_t pulses) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const std::int64_t more = std::int64_t{pulses} - axis.coordinate_pulses;
  axis.coordinate_pulses = pulses;
  if (axis.command == Command::absolute && chose(kPresetKeepsTarget)) keep_target(axis, more, now());
}

void Simple2R3::run_velocity(int axis_number, std::int64_t milli_rpm) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  refresh_signals(axis_number);
  const bool is_dropped = (milli_rpm != 0 && lacks_ready(axis_number)) ||
                          (is_positioning(axis_number) && chose(kModeWhileMovingIgnored)) ||
                          (chose(kTooFastDropped) && is_too_fast(axis_number, milli_rpm)) ||
                          simple2_r3::run_velocity(axis, milli_rpm) != motion::Cause::none;
  if (!is_dropped && milli_rpm != 0 && chose(kHomeLeftByMotion)) axis.homed = false;
  if (is_dropped && chose(kDroppedValueForgotten)) {
    state_.image[kAxisSlots[static_cast<std::size_t>(axis_number)].velocity] =
        static_cast<std::uint32_t>(axis.target_urpm / 1000);
  }
}

void Simple2R3::show_velocity(int axis, std::int32_t milli_rpm) {
  if (chose(kCommandValuesNotShown)) return;
  state_.image[kAxisSlots[static_cast<std::size_t>(axis)].velocity] = static_cast<std::uint32_t>(milli_rpm);
}

void Simple2R3::show_pwm(int axis, std::uint8_t percent) {
  if (!chose(kCommandValuesNotShown)) state_.image[kAxisSlots[static_cast<std::size_t>(axis)].pwm] = percent;
}

void Simple2R3::output_pwm(int axis_number, std::uint8_t percent) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  refresh_signals(axis_number);
  const bool is_dropped =
      lacks_ready(axis_number) || (is_positioning(axis_number) && chose(kModeWhileMovingIgnored)) ||
      simple2_r3::output_pwm(axis, percent, !chose(kPwmWithoutServo)) != motion::Cause::none;
  if (is_dropped && chose(kDroppedValueForgotten)) {
    state_.image[kAxisSlots[static_cast<std::size_t>(axis_number)].pwm] = axis.pwm_percent;
  }
}

void Simple2R3::follow_encoder(int axis_number) {
  if (lacks_ready(axis_number) || (is_positioning(axis_number) && chose(kModeWhileMovingIgnored))) return;
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis_number)];
  const std::int64_t resolution = resolution_of(state_, axis_number);
  const auto pps = [&](std::uint32_t rpm) {
    return std::clamp<std::int64_t>(rpm * resolution / 60, 1, kMaxPulseRate_pps);
  };
  SyncSettings sync{.numerator = state_.image[slots.sync_numerator],
                    .denominator = std::max<std::int64_t>(state_.image[slots.sync_denominator], 1),
                    .top_speed_pps = pps(state_.image[slots.sync_speed]),
                    .catches_up = chose(kSyncCatchesUp)};
  if (chose(kSyncByRevolutions)) {
    sync.numerator *= resolution;
    sync.denominator *= std::max<std::int64_t>(state_.image[slots.encoder_resolution], 1);
  }
  // Of each 5 ms; 0 is without bound.
  const std::uint32_t slope = state_.image[slots.sync_slope];
  if (slope != 0)
    sync.slope_pps = chose(kSlopeInPulses) ? std::int64_t{slope} * 1000 / kSyncPeriod : pps(slope);
  refresh_signals(axis_number);
  if (simple2_r3::follow_encoder(axis, follower_by(sync)) != motion::Cause::none) return;
  // Nothing comes out until its first period begins.
  if (chose(kSyncEveryFifthTick)) axis.motor.follower.phase = static_cast<int>((now() + 1) % kSyncPeriod);
  if (chose(kHomeLeftByMotion)) axis.homed = false;
}

void Simple2R3::stop(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis_number)];
  const Mode mode = axis.mode;
  stop_drive(axis);
  if (mode != Mode::sync && chose(kModeStaysAfterStop)) axis.mode = mode;
  if (chose(kValuesZeroAfterStop)) state_.image[slots.velocity] = state_.image[slots.pwm] = 0;
}

void Simple2R3::switch_servo(int axis_number, bool on) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const bool stays = axis.mode == Mode::pwm && chose(kPwmWithoutServo);
  if (!on && !stays) stop(axis_number);
  axis.motor.switch_servo(on);
}

void Simple2R3::clear_alarm(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  if (alarm_clear(axis_number) && chose(kAclrAgainIgnored)) return;
  axis.alarm_latched = false;  // an input that is on says so again
  axis.alarm_clear_until = now() + 1 + kAlarmClearTicks;
}

void Simple2R3::start_program(std::uint8_t line) {
  interpreter::simple2::Execution& execution = state_.execution;
  if (execution.running && chose(kStartIgnored)) return;
  const interpreter::simple2::LoopState loop = execution.loop;
  interpreter::simple2::start(execution, line);
  if (chose(kStartJumps)) execution.loop = loop;  // none of a program that does not run
  if (chose(kFlagsFoundAtStart)) state_.program.find_flags();
  if (!chose(kStartClears)) return;
  for (Timer& timer : state_.timers) timer = {};
  constexpr std::array kValues{slot("CalcREG"), slot("Counter1_Value"), slot("Counter2_Value")};
  for (const std::size_t value : kValues) state_.image[value] = 0;
  std::fill_n(state_.image.begin() + slot("PROG_VAR{}"), 32, 0U);
}

void Simple2R3::stop_program() {
  if (!state_.execution.running) return;
  interpreter::simple2::stop(state_.execution);
  program_has_ended();
}

void Simple2R3::program_has_ended() {
  for (int axis = 0; axis < 2 && chose(kEndStopsMotion); ++axis) stop(axis);
  for (Timer& timer : state_.timers) {
    if (chose(kEndStopsTimers)) timer.run(false, timer_time());
  }
}

}  // namespace understudy::emulator::simple2_r3
