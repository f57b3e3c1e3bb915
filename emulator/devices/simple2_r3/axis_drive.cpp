#include "emulator/devices/simple2_r3/axis_drive.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "emulator/prefetch.h"

namespace understudy::emulator::simple2_r3 {

namespace {

__extension__ using Wide = __int128;

/// The pulses of one tick of velocity mode: two steps of 0.5 ms.
std::int64_t velocity_pulses(AxisState& axis, const DriveSettings& settings) {
  // The pulse limit, as a speed.
  const std::int64_t cap_urpm = kMaxPulseRate_pps * 60'000'000 / settings.pulses_per_revolution;
  const std::int64_t target = std::clamp(axis.target_urpm, -cap_urpm, cap_urpm);
  std::int64_t pulses = 0;
  for (int half = 0; half < 2; ++half) {
    const std::int64_t step = settings.velocity_step_urpm;
    const std::int64_t speed_before = axis.speed_urpm;
    axis.speed_urpm = std::clamp(target, axis.speed_urpm - step, axis.speed_urpm + step);
    const std::int64_t speed = settings.pulses_by_speed_before ? speed_before : axis.speed_urpm;
    // At most 6e12 by the cap, and 1.2e11 left over.
    axis.velocity_phase += speed * static_cast<std::int64_t>(settings.pulses_per_revolution);
    pulses += axis.velocity_phase / kVelocityPhase;
    axis.velocity_phase %= kVelocityPhase;
  }
  return pulses;
}

std::size_t ring_place(Tick tick) {
  constexpr Tick kPlaces = AxisState::kSpeedWindow + 1;
  return static_cast<std::size_t>((tick + kPlaces) % kPlaces);
}

bool runs_velocity(const AxisState& axis) {
  return axis.mode == Mode::velocity && axis.motor.task == motion::Task::coordinated;
}

}  // namespace

std::int64_t step_drive(AxisState& axis, const DriveSettings& settings, Tick tick) {
  motion::Axis& motor = axis.motor;
  const std::int64_t before = motor.travel_pulses;
  if (runs_velocity(axis)) {
    motor.carry(velocity_pulses(axis, settings), tick, axis.signals);
    if (!runs_velocity(axis)) axis.speed_urpm = 0;  // a limit or an alarm
  } else {
    if (axis.mode == Mode::sync) {
      const std::int64_t counts = axis.encoder_counts - axis.encoder_followed;
      motor.feed(settings.encoder_reversed ? -counts : counts);
      axis.encoder_followed = axis.encoder_counts;
    }
    motor.step(tick, axis.signals);
  }
  if ((motor.events & motion::bit(motion::Event::homed)) != 0) axis.homed = true;
  if (!motor.moving()) axis.command = Command::none;
  return motor.travel_pulses - before;
}

void remember_encoder(AxisState& axis, Tick tick) {
  if (axis.encoder_history[ring_place(tick - 1)] != axis.encoder_counts) axis.encoder_changed = tick;
  axis.encoder_history[ring_place(tick)] = axis.encoder_counts;
}

void prefetch(const AxisState& axis, Tick tick) {
  emulator::prefetch(&axis.motor, 128);  // all that the middle of a move needs
  emulator::prefetch(axis.motor.task);
  emulator::prefetch(axis.signals);
  emulator::prefetch(&axis.mode, 128);
  emulator::prefetch(axis.encoder_history[ring_place(tick)]);
  emulator::prefetch(axis.encoder_changed);
}

motion::Cause run_velocity(AxisState& axis, std::int64_t target_mrpm) {
  if (target_mrpm != 0) {
    const motion::Cause why_not = axis.motor.forbidden(target_mrpm < 0 ? -1 : +1);
    if (why_not != motion::Cause::none) return why_not;
  }
  if (!runs_velocity(axis)) {
    if (const motion::Cause why_not = axis.motor.take_part(); why_not != motion::Cause::none) return why_not;
    axis.speed_urpm = 0;
    axis.velocity_phase = 0;
  }
  axis.mode = Mode::velocity;
  axis.pwm_percent = 0;
  axis.command = Command::none;
  axis.target_urpm = target_mrpm * 1000;
  return motion::Cause::none;
}

motion::Cause follow_encoder(AxisState& axis, const motion::Follower& by) {
  if (const motion::Cause why_not = axis.motor.follow(by); why_not != motion::Cause::none) return why_not;
  axis.mode = Mode::sync;
  axis.pwm_percent = 0;
  axis.command = Command::none;
  axis.encoder_followed = axis.encoder_counts;
  return motion::Cause::none;
}

void stop_drive(AxisState& axis) {
  axis.motor.stop();
  axis.mode = Mode::position;
  axis.command = Command::none;
  axis.speed_urpm = axis.target_urpm = axis.velocity_phase = 0;
  axis.pwm_percent = 0;
}

motion::Cause output_pwm(AxisState& axis, std::uint8_t percent, bool needs_servo) {
  // Either way: no pulse comes out, so limits do not matter.
  const bool pulses_need_servo = std::exchange(axis.motor.settings.needs_servo, needs_servo);
  const motion::Cause why_not = axis.motor.forbidden_anywhere();
  axis.motor.settings.needs_servo = pulses_need_servo;
  if (why_not != motion::Cause::none) return why_not;
  stop_drive(axis);
  axis.mode = Mode::pwm;
  axis.pwm_percent = percent;
  return motion::Cause::none;
}

void keep_target(AxisState& axis, std::int64_t pulses, Tick now) {
  motion::Axis& motor = axis.motor;
  // Distances count from where the move began, in its direction.
  motor.change_distance(motor.target_pulses - pulses * motor.drive.direction, false, now);
}

motion::Follower follower_by(SyncSettings settings) {
  const auto is_too_large = [&] { return std::max(settings.numerator, settings.denominator) > INT32_MAX; };
  if (is_too_large()) {
    const std::int64_t common = std::gcd(settings.numerator, settings.denominator);
    settings.numerator /= common;
    settings.denominator /= common;
  }
  // Still so: nobody's encoder has that many counts, and the ratio may be a little off.
  while (is_too_large()) {
    settings.numerator /= 2;
    settings.denominator = std::max<std::int64_t>(settings.denominator / 2, 1);
  }
  return {.numerator = settings.numerator,
          .denominator = settings.denominator,
          .period_ticks = kSyncPeriod,
          .top_speed_pps = settings.top_speed_pps,
          .slope_pps = settings.slope_pps,
          .catches_up = settings.catches_up};
}

motion::HomingProgram homing_to_first_edge(const motion::Simple2Homing& how) {
  if (how.speed.top_speed_u_s == 0) return motion::simple2_homing(how);
  const auto way = static_cast<std::int8_t>(how.way < 0 ? -1 : +1);
  motion::HomingProgram program{.speeds = {how.speed}};
  program.add({.way = way, .marks = true, .next = 2, .if_limit = 1});  // 2 is below the last: found
  program.add({.way = static_cast<std::int8_t>(-way), .marks = true});
  return program;
}

std::int64_t encoder_rpm(const AxisState& axis, Tick now, const SpeedMeter& meter) {
  const std::int64_t then = axis.encoder_history[ring_place(now - meter.window)];
  const Wide counts = Wide{axis.encoder_counts} - then;
  const std::int64_t windows_a_minute = 60'000 / meter.window;
  // To the nearest: whole counts would show a steady 100 RPM as 99 otherwise.
  const Wide half = Wide{meter.counts_per_revolution / 2} * (counts < 0 ? -1 : 1);
  Wide rpm = (counts * windows_a_minute + half) / meter.counts_per_revolution;
  if (meter.reversed) rpm = -rpm;
  if (meter.wraps) return static_cast<std::int16_t>(static_cast<std::uint16_t>(rpm));
  return static_cast<std::int64_t>(std::clamp<Wide>(rpm, INT16_MIN, INT16_MAX));
}

double speed_pps(const AxisState& axis, Tick now, std::uint32_t pulses_per_revolution) {
  const motion::Axis& motor = axis.motor;
  if (runs_velocity(axis)) return static_cast<double>(axis.speed_urpm) * pulses_per_revolution / 60e6;
  if (motor.task == motion::Task::following) {
    return static_cast<double>(motor.follower.period_pulses) * 1000 / motor.follower.period_ticks;
  }
  return motor.drive.moving() ? motor.drive.direction * motor.sample(now).speed_u_s : 0;
}

bool is_moving(const AxisState& axis) {
  switch (axis.mode) {
    case Mode::position: return axis.motor.moving();
    case Mode::velocity: return runs_velocity(axis) && (axis.speed_urpm != 0 || axis.target_urpm != 0);
    case Mode::pwm: return axis.pwm_percent != 0;
    case Mode::sync:
      return axis.motor.task == motion::Task::following && axis.motor.follower.period_pulses != 0;
  }
  return false;
}

Tick next_active_tick(const AxisState& axis, Tick done) {
  const motion::Axis& motor = axis.motor;
  if (motor.attentive || motor.events != 0 || motor.events_between != 0 || axis.pulses_this_tick != 0) {
    return done + 1;
  }
  const bool stands_in_velocity = runs_velocity(axis) && !is_moving(axis);
  if (motor.moving() && motor.task != motion::Task::hanging && !stands_in_velocity) return done + 1;
  if (done <= axis.encoder_changed + AxisState::kSpeedWindow) return done + 1;
  return kNever;
}

}  // namespace understudy::emulator::simple2_r3
