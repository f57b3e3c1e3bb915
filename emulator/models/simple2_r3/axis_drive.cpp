#include "emulator/models/simple2_r3/axis_drive.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "base/prefetch.h"
#include "base/simulated_time.h"
#include "emulator/models/simple2_r3/marks.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/following.h"
#include "motion/homing.h"
#include "motion/homing_tables.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

__extension__ using Wide = __int128;

int sign_of(std::int64_t value) { return value < 0 ? -1 : value > 0 ? +1 : 0; }

/// Returns the difference between two counters, which may wrap.
std::int64_t difference(std::int64_t later, std::int64_t earlier) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(earlier));
}

bool is_on(const AxisState& axis, motion::Signal signal) {
  return (axis.motor.signals & motion::bit(signal)) != 0;
}

bool alarm_forbids(const AxisState& axis) {
  return is_on(axis, motion::Signal::alarm) && axis.motor.settings.at_alarm != motion::Reaction::ignore;
}

/// Returns true if the limit on this side forbids motion.
bool limit_forbids(const AxisState& axis, int direction) {
  const motion::AxisSettings& settings = axis.motor.settings;
  if (direction > 0) {
    return is_on(axis, motion::Signal::limit_plus) && settings.at_limit_plus != motion::Reaction::ignore;
  }
  return direction < 0 && is_on(axis, motion::Signal::limit_minus) &&
         settings.at_limit_minus != motion::Reaction::ignore;
}

/// Returns the present target of velocity mode.
std::int64_t target_urpm(const AxisState& axis) {
  return limit_forbids(axis, sign_of(axis.target_urpm)) ? 0 : axis.target_urpm;
}

/// Runs one tick of velocity mode, which is two steps of 0.5 ms, and returns the number of pulses.
std::int64_t velocity_pulses(AxisState& axis, const DriveSettings& settings) {
  const std::int64_t target = final_urpm(axis, settings);
  std::int64_t pulses = 0;
  for (int half = 0; half < 2; ++half) {
    const std::int64_t step = settings.velocity_step_urpm;
    const std::int64_t speed_before = axis.speed_urpm;
    axis.speed_urpm = std::clamp(target, axis.speed_urpm - step, axis.speed_urpm + step);
    const std::int64_t speed = settings.pulses_by_speed_before ? speed_before : axis.speed_urpm;
    // Because of the speed limit, the phase is at most 6e12, plus a remainder of 1.2e11.
    axis.velocity_phase += speed * static_cast<std::int64_t>(settings.pulses_per_revolution);
    pulses += axis.velocity_phase / kVelocityPhase;
    axis.velocity_phase %= kVelocityPhase;
  }
  return pulses;
}

}  // namespace

bool runs_velocity(const AxisState& axis) {
  return axis.mode == Mode::velocity && axis.motor.task == motion::Task::coordinated;
}

std::int64_t final_urpm(const AxisState& axis, const DriveSettings& settings) {
  // The pulse limit, as a speed.
  const std::int64_t cap_urpm = kMaxPulseRate_pps * 60'000'000 / settings.pulses_per_revolution;
  return std::clamp(target_urpm(axis), -cap_urpm, cap_urpm);
}

std::int64_t step_drive(AxisState& axis, const DriveSettings& settings, Tick tick) {
  motion::Axis& motor = axis.motor;
  const std::int64_t before = motor.travel_pulses;
  if (runs_velocity(axis)) {
    motor.carry(velocity_pulses(axis, settings), tick, axis.signals);
  } else {
    if (axis.mode == Mode::sync) {
      motor.feed(difference(settings.encoder_counts, axis.encoder_followed));
      axis.encoder_followed = settings.encoder_counts;
      motion::Follower& follower = motor.follower;
      if (settings.stops_with_encoder && follower.phase == 0 && follower.gathered == 0)
        follower.period_pulses = 0;
    }
    motor.step(tick, axis.signals);
  }
  if ((motor.events & motion::bit(motion::Event::homed)) != 0) axis.homed = true;
  if (!motor.moving() && axis.command != Command::none) {
    const bool is_homed = axis.command == Command::homing && axis.homed;
    axis.cut_short = !is_homed && motor.cause != motion::Cause::arrived;
    axis.command = Command::none;
  }
  return motor.travel_pulses - before;
}

void remember_encoder(AxisState& axis, Tick tick) {
  if (axis.encoder_history[ring_place(tick - 1)] != axis.encoder_counts) axis.encoder_changed = tick;
  axis.encoder_history[ring_place(tick)] = axis.encoder_counts;
}

void prefetch(const AxisState& axis, Tick tick) {
  understudy::prefetch(&axis.motor, 2 * kCacheLine);  // what ticks during a move need
  prefetch_line(&axis.mode);
  prefetch_line(&axis.encoder_history[ring_place(tick)]);
}

Activity activity(const AxisState& axis) {
  switch (axis.mode) {
    case Mode::position: return axis.command == Command::homing ? Activity::homing : Activity::position;
    case Mode::velocity: return Activity::velocity;
    case Mode::pwm: return Activity::pwm;
    case Mode::sync: return Activity::sync;
  }
  return Activity::position;
}

int heading(const AxisState& axis) {
  const motion::Axis& motor = axis.motor;
  switch (axis.mode) {
    case Mode::position: return motor.moving() ? motor.drive.direction : 0;
    case Mode::velocity:
      if (!runs_velocity(axis)) return 0;
      return sign_of(axis.speed_urpm != 0 ? axis.speed_urpm : axis.target_urpm);
    case Mode::pwm: return 0;
    case Mode::sync: return motor.task == motion::Task::following ? sign_of(motor.follower.period_pulses) : 0;
  }
  return 0;
}

Phase phase_of(const AxisState& axis, Tick now) {
  if (alarm_forbids(axis)) return Phase::in_alarm;
  const int direction = heading(axis);
  const bool at_any_limit = limit_forbids(axis, +1) || limit_forbids(axis, -1);
  if (axis.mode == Mode::pwm) {
    return at_any_limit ? Phase::at_limit : axis.pwm_percent != 0 ? Phase::moving : Phase::standing;
  }
  if (direction == 0) return at_any_limit ? Phase::at_limit : Phase::standing;
  if (limit_forbids(axis, direction)) return Phase::at_limit;
  if (limit_forbids(axis, -direction)) return Phase::leaving;
  if (axis.mode == Mode::velocity) {
    const int wanted = sign_of(axis.target_urpm);
    if (wanted == -direction) return Phase::turning;
    return axis.target_urpm * direction < axis.speed_urpm * direction ? Phase::slowing : Phase::moving;
  }
  if (axis.mode == Mode::position && axis.motor.sample(now).acceleration_u_s2 < 0) return Phase::slowing;
  return Phase::moving;
}

void halt_velocity(AxisState& axis) {
  axis.motor.stop();
  take_off(axis, Outcome::waits);
}

void resume_velocity(AxisState& axis) {
  if (runs_velocity(axis) || target_urpm(axis) == 0) return;
  if (axis.motor.take_part() == motion::Cause::none) take_off(axis, Outcome::turns);
}

void run_velocity(AxisState& axis, std::int64_t target_mrpm) {
  if (axis.mode != Mode::velocity) {
    stop_drive(axis);
    axis.mode = Mode::velocity;
  }
  axis.target_urpm = target_mrpm * 1000;
  resume_velocity(axis);
}

void follow_encoder(AxisState& axis, const motion::Follower& by, std::int64_t counts) {
  stop_drive(axis);
  axis.motor.follow(by);
  axis.mode = Mode::sync;
  axis.encoder_followed = counts;
}

void keep_following(AxisState& axis) {
  const motion::Follower follower = axis.motor.follower;
  axis.motor.stop();
  if (axis.motor.follow(follower) == motion::Cause::none) axis.motor.follower = follower;
}

void stop_drive(AxisState& axis) {
  if (axis.command != Command::none) axis.cut_short = true;
  axis.motor.stop();
  take_off(axis, Outcome::leaves);
}

void output_pwm(AxisState& axis, std::uint8_t percent) {
  stop_drive(axis);
  axis.mode = Mode::pwm;
  axis.pwm_percent = percent;
}

std::uint8_t pwm_duty(const AxisState& axis) { return alarm_forbids(axis) ? 0 : axis.pwm_percent; }

std::int64_t counts_at(const AxisState& axis, std::int64_t raw, bool reversed) {
  const std::int64_t more = difference(raw, axis.encoder_raw);
  return difference(axis.encoder_counts, reversed ? more : difference(0, more));
}

void count_encoder(AxisState& axis, std::int64_t raw, bool reversed) {
  axis.encoder_counts = counts_at(axis, raw, reversed);
  axis.encoder_raw = raw;
}

std::int64_t remaining_pulses(const AxisState& axis) {
  const motion::Axis& motor = axis.motor;
  const bool is_move = axis.command == Command::incremental || axis.command == Command::absolute;
  if (!is_move || (motor.slowing && !motor.comes_back)) return 0;
  const bool hangs = motor.task == motion::Task::hanging;
  return (hangs ? motor.target_pulses : motor.remaining_pulses()) * motor.drive.direction;
}

void keep_target(AxisState& axis, std::int64_t pulses, Tick now) {
  motion::Axis& motor = axis.motor;
  // Distances count from the beginning of the move, in its direction.
  motor.change_distance(motor.target_pulses - pulses * motor.drive.direction, false, now);
}

motion::Follower follower_by(SyncSettings settings) {
  const auto is_too_large = [&] { return std::max(settings.numerator, settings.denominator) > INT32_MAX; };
  if (is_too_large()) {
    const std::int64_t common = std::gcd(settings.numerator, settings.denominator);
    settings.numerator /= common;
    settings.denominator /= common;
  }
  // The numbers are still too large: no real encoder has this many counts, so the ratio may be slightly off.
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
  const auto direction = static_cast<std::int8_t>(how.direction < 0 ? -1 : +1);
  motion::HomingProgram program{.speeds = {how.speed}};
  // There is no step 2, so home is found.
  program.add({.direction = direction, .marks = true, .next = 2, .if_limit = 1});
  program.add({.direction = static_cast<std::int8_t>(-direction), .marks = true});
  return program;
}

std::int64_t encoder_rpm(const AxisState& axis, Tick now, const SpeedMeter& meter) {
  const std::int64_t then = axis.encoder_history[ring_place(now - meter.window)];
  const Wide counts = Wide{axis.encoder_counts} - then;
  const std::int64_t windows_a_minute = 60'000 / meter.window;
  // Round to the nearest value; otherwise, a constant 100 RPM would be shown as 99.
  const Wide half = Wide{meter.counts_per_revolution / 2} * (counts < 0 ? -1 : 1);
  Wide rpm = (counts * windows_a_minute + half) / meter.counts_per_revolution;
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
    case Mode::velocity: return runs_velocity(axis) && (axis.speed_urpm != 0 || target_urpm(axis) != 0);
    case Mode::pwm: return pwm_duty(axis) != 0;
    case Mode::sync:
      return axis.motor.task == motion::Task::following && axis.motor.follower.period_pulses != 0;
  }
  return false;
}

Tick next_active_tick(const AxisState& axis, Tick done) {
  const motion::Axis& motor = axis.motor;
  if (motor.must_recheck || motor.events != 0 || motor.events_between != 0 || axis.pulses_this_tick != 0) {
    return done + 1;
  }
  const bool stands_in_velocity = runs_velocity(axis) && !is_moving(axis);
  if (motor.moving() && motor.task != motion::Task::hanging && !stands_in_velocity) return done + 1;
  if (axis.mode == Mode::sync) return done + 1;  // reads the encoder's counts even if it must not follow
  if (done <= axis.encoder_changed + AxisState::kSpeedWindow) return done + 1;
  return kNever;
}

}  // namespace understudy::emulator::models::simple2_r3
