// What Simple2-R3 is told to do: moves, homing, modes, servo and STOP, and its program. Registers and program
// lines come here alike. What a command is dropped for, and what it does to the one before it, is said here.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/marks.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "interpreter/simple2/execution/execution.h"
#include "motion/axis.h"
#include "motion/following.h"
#include "motion/homing_tables.h"
#include "motion/move.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

constexpr Tick kAlarmClearTicks = 200;  // 0x1017, 0x1018

}  // namespace

motion::SpeedLaw Simple2R3::law_of(int axis, std::uint32_t speed_rpm, std::uint32_t acceleration_10ms,
                                   std::uint32_t deceleration_10ms) const {
  // Times of 0 count as 1 (appendix A): 10 ms, unless it is 1 of something smaller.
  const double least_s = chose(option("least_ramp", "1ms"))     ? 0.001
                         : chose(option("least_ramp", "500us")) ? 0.0005
                                                                : 0.01;
  const auto by_time = [&](std::uint32_t time_10ms) {
    return motion::RampLaw::by_time(time_10ms == 0 ? least_s : time_10ms / 100.0);
  };
  const double speed_pps = static_cast<double>(speed_rpm) * resolution_of(state_, axis) / 60.0;
  return {.top_speed_u_s = std::min(speed_pps, static_cast<double>(kMaxPulseRate_pps)),
          .up = by_time(acceleration_10ms),
          .down = by_time(deceleration_10ms)};
}

bool Simple2R3::is_refused_as_too_fast(int axis, std::int64_t milli_rpm) const {
  if (!chose(option("pulse_rate_cap", "command_dropped"))) return false;
  const std::int64_t size = milli_rpm < 0 ? -milli_rpm : milli_rpm;
  return size * resolution_of(state_, axis) > kMaxPulseRate_pps * 60'000;
}

/// A motion has begun.
void Simple2R3::leave_home(AxisState& axis) const {
  if (chose(option("home_bit", "any_motion"))) axis.homed = false;
}

bool Simple2R3::lacks_ready(int axis) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis)];
  return chose(option("ready_gates", "yes")) && assigned(slots.ready_assigned) && !ready(axis);
}

bool Simple2R3::lacks_servo(int axis) const {
  return !state_.axes[static_cast<std::size_t>(axis)].motor.servo_on && servo_matters(axis);
}

std::uint32_t Simple2R3::velocity_step_urpm(int axis) const {
  const std::size_t acceleration = kAxisSlots[static_cast<std::size_t>(axis)].velocity_acceleration;
  return velocity_unit_urpm_ * std::max(state_.image[acceleration], 1U);
}

bool Simple2R3::servo_matters(int axis) const {
  return !chose(option("servo_unassigned", "no_effect")) ||
         assigned(kAxisSlots[static_cast<std::size_t>(axis)].servo_output_assigned);
}

Event Simple2R3::event_by_direction(int axis, int direction, Event towards, Event away) const {
  const motion::Cause why_not = state_.axes[static_cast<std::size_t>(axis)].motor.forbidden(direction);
  const bool into = why_not == motion::Cause::limit_plus || why_not == motion::Cause::limit_minus;
  return into ? towards : away;
}

bool Simple2R3::may_begin(int axis_number, Outcome outcome, const KeptCommand& what) {
  if (replaces_kept(outcome)) forget_kept(axis_number);
  switch (outcome) {
    case Outcome::begins:
    case Outcome::changes: return true;
    case Outcome::kept:
      state_.kept[static_cast<std::size_t>(axis_number)] = what;
      if (what.command != Command::none) {
        state_.axes[static_cast<std::size_t>(axis_number)].cut_short = false;
      }
      return false;
    case Outcome::ends: stop_drive(state_.axes[static_cast<std::size_t>(axis_number)]); return false;
    case Outcome::goes_on:
    case Outcome::stops:
    case Outcome::leaves:
    case Outcome::waits:
    case Outcome::turns:
    case Outcome::slows:
    case Outcome::slows_and_waits:
    case Outcome::blocked:
    case Outcome::resumes:
    case Outcome::dropped: return false;
  }
  return false;
}

void Simple2R3::forget_kept(int axis) {
  const KeptCommand kept = std::exchange(state_.kept[static_cast<std::size_t>(axis)], {});
  // A line may wait for it.
  if (kept.command != Command::none) state_.axes[static_cast<std::size_t>(axis)].cut_short = true;
}

/// In velocity and sync mode, signed as the axis goes: 0 where a limit is in the way.
double Simple2R3::speed_of_pulses(int axis_number) const {
  const AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const double speed_pps = simple2_r3::speed_pps(axis, now(), resolution_in_velocity(axis_number));
  const bool is_free = axis.motor.forbidden(speed_pps < 0 ? -1 : +1) == motion::Cause::none;
  return is_free ? speed_pps : 0;
}

void Simple2R3::start_move(int axis_number, Command command, const MoveParameters& move) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  std::int64_t distance_pulses = move.distance_pulses;
  // Whatever the speed, a distance of 0 stops at once (appendix A).
  if (distance_pulses != 0) {
    if (lacks_ready(axis_number)) return;
    if (is_refused_as_too_fast(axis_number, std::int64_t{1000} * move.speed_rpm)) return;
    const bool counts_on =
        command == Command::incremental && chose(option("incremental_while_moving", "old_target"));
    if (counts_on) distance_pulses += remaining_pulses(axis);
  }
  refresh_signals(axis_number);
  const int direction = distance_pulses < 0 ? -1 : +1;
  const Event event = distance_pulses == 0
                          ? Event::move_nowhere
                          : event_by_direction(axis_number, direction, Event::move_towards, Event::move_away);
  const Outcome outcome = reaction(axis_number, event);
  if (!may_begin(axis_number, outcome, {.command = command, .move = move})) return;
  const double speed_pps = outcome == Outcome::changes ? speed_of_pulses(axis_number) : 0;
  stop_drive(axis);
  axis.cut_short = false;
  if (distance_pulses == 0) return;
  const motion::SpeedLaw law =
      law_of(axis_number, move.speed_rpm, move.acceleration_10ms, move.deceleration_10ms);
  const motion::Cause refused = move.speed_rpm == 0 ? axis.motor.move_at_zero_speed(direction)
                                : speed_pps != 0
                                    ? axis.motor.move_on(speed_pps, distance_pulses, law, now())
                                    : axis.motor.move(distance_pulses, law, tick_before_motion());
  if (refused != motion::Cause::none) return;
  // Its rest may be asked for.
  if (move.speed_rpm == 0) axis.motor.target_pulses = distance_pulses * direction;
  axis.command = command;
  axis.has_own_speed = move.of_the_axis;
  axis.by_trigger = move.by_trigger;
  leave_home(axis);
}

void Simple2R3::go_home(int axis_number, bool by_trigger) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis_number)];
  const std::uint32_t speed_rpm = state_.image[slots.home_speed];
  if (lacks_ready(axis_number)) return;
  if (is_refused_as_too_fast(axis_number, std::int64_t{1000} * speed_rpm)) return;
  if (chose(option("home_unassigned", "dropped")) && !assigned(slots.home_assigned)) return;
  refresh_signals(axis_number);
  if (!may_begin(axis_number, reaction(axis_number, Event::home),
                 {.command = Command::homing, .move = {.by_trigger = by_trigger}}))
    return;
  stop_drive(axis);
  axis.cut_short = false;
  axis.homed = false;
  axis.motor.signals = axis.signals.steady;
  const std::uint32_t time_10ms = state_.image[slots.home_acc_time];
  const motion::Simple2Homing how{.direction = state_.image[slots.home_direction] != 0 ? +1 : -1,
                                  .speed = law_of(axis_number, speed_rpm, time_10ms, time_10ms)};
  const motion::Cause refused =
      axis.motor.home(chose(option("homing_sequence", "stops_at_first_edge")) ? homing_to_first_edge(how)
                                                                              : motion::simple2_homing(how),
                      tick_before_motion());
  if (refused != motion::Cause::none) return;
  axis.command = Command::homing;
  axis.by_trigger = by_trigger;
}

void Simple2R3::speed_changed(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const bool runs_by_it =
      axis.has_own_speed && (axis.command == Command::incremental || axis.command == Command::absolute);
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis_number)];
  const std::uint32_t speed_rpm = state_.image[slots.speed];
  if (!runs_by_it || speed_rpm == 0 || !chose(option("speed_while_moving", "at_once"))) return;
  axis.motor.change_speed(
      law_of(axis_number, speed_rpm, state_.image[slots.acc_time], state_.image[slots.dec_time]), now());
}

void Simple2R3::preset_coordinate(int axis_number, std::int32_t pulses) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const std::int64_t more = std::int64_t{pulses} - axis.coordinate_pulses;
  axis.coordinate_pulses = pulses;
  if (axis.command == Command::absolute && chose(option("preset_while_moving", "keeps_target")))
    keep_target(axis, more, now());
}

void Simple2R3::run_velocity(int axis_number, std::int64_t milli_rpm) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  refresh_signals(axis_number);
  const bool is_refused =
      (milli_rpm != 0 && lacks_ready(axis_number)) || is_refused_as_too_fast(axis_number, milli_rpm);
  const Event event = milli_rpm == 0 ? Event::velocity_zero
                                     : event_by_direction(axis_number, milli_rpm < 0 ? -1 : +1,
                                                          Event::velocity_towards, Event::velocity_away);
  const Outcome outcome = is_refused ? Outcome::dropped : reaction(axis_number, event);
  if (replaces_kept(outcome)) forget_kept(axis_number);
  switch (outcome) {
    case Outcome::begins:
    case Outcome::changes:
      simple2_r3::run_velocity(axis, milli_rpm);
      axis.velocity_resolution = resolution_of(state_, axis_number);
      axis.velocity_step_urpm = velocity_step_urpm(axis_number);
      if (milli_rpm != 0) leave_home(axis);
      break;
    case Outcome::waits:
    case Outcome::slows_and_waits: axis.target_urpm = milli_rpm * 1000; break;
    case Outcome::slows: take_off(axis, outcome); break;
    case Outcome::goes_on:
    case Outcome::stops:
    case Outcome::leaves:
    case Outcome::turns:
    case Outcome::blocked:
    case Outcome::resumes:
    case Outcome::dropped:
    case Outcome::kept:
    case Outcome::ends: (void)may_begin(axis_number, outcome, {.mode = Mode::velocity, .value = milli_rpm});
  }
  if (is_forgotten(outcome)) {
    state_.image[kAxisSlots[static_cast<std::size_t>(axis_number)].velocity] =
        static_cast<std::uint32_t>(axis.target_urpm / 1000);
  }
}

void Simple2R3::show_velocity(int axis, std::int32_t milli_rpm) {
  if (shows_command_values())
    state_.image[kAxisSlots[static_cast<std::size_t>(axis)].velocity] = static_cast<std::uint32_t>(milli_rpm);
}

void Simple2R3::show_pwm(int axis, std::uint8_t percent) {
  if (shows_command_values()) state_.image[kAxisSlots[static_cast<std::size_t>(axis)].pwm] = percent;
}

void Simple2R3::output_pwm(int axis_number, std::uint8_t percent) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  refresh_signals(axis_number);
  const Outcome outcome = percent != 0 && lacks_ready(axis_number)
                              ? Outcome::dropped
                              : reaction(axis_number, percent == 0 ? Event::pwm_zero : Event::pwm);
  if (outcome == Outcome::waits) {
    forget_kept(axis_number);
    axis.pwm_percent = percent;
  } else if (may_begin(axis_number, outcome, {.mode = Mode::pwm, .value = percent})) {
    simple2_r3::output_pwm(axis, percent);
  }
  if (is_forgotten(outcome)) {
    state_.image[kAxisSlots[static_cast<std::size_t>(axis_number)].pwm] = axis.pwm_percent;
  }
}

std::int64_t Simple2R3::followed_count(int axis) const {
  return state_.axes[static_cast<std::size_t>(sync_follows_other_ ? 1 - axis : axis)].encoder_counts;
}

motion::Follower Simple2R3::sync_follower(int axis_number) const {
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis_number)];
  const std::int64_t resolution = resolution_of(state_, axis_number);
  const auto pps = [&](std::uint32_t rpm) {
    return std::clamp<std::int64_t>(rpm * resolution / 60, 1, kMaxPulseRate_pps);
  };
  SyncSettings sync{.numerator = state_.image[slots.sync_numerator],
                    .denominator = std::max<std::int64_t>(state_.image[slots.sync_denominator], 1),
                    .top_speed_pps = pps(state_.image[slots.sync_speed]),
                    .catches_up = chose(option("sync_lost_pulses", "caught_up"))};
  if (chose(option("sync_ratio", "revolutions"))) {
    sync.numerator *= resolution;
    sync.denominator *= std::max<std::int64_t>(state_.image[slots.encoder_resolution], 1);
  }
  // Of each 5 ms; 0 is without bound.
  const std::uint32_t slope = state_.image[slots.sync_slope];
  if (slope != 0)
    sync.slope_pps =
        chose(option("sync_slope", "pulses")) ? std::int64_t{slope} * 1000 / kSyncPeriod : pps(slope);
  return follower_by(sync);
}

void Simple2R3::sync_changed(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  if (axis.mode != Mode::sync || !chose(option("sync_settings", "at_once"))) return;
  const motion::Follower by = sync_follower(axis_number);
  motion::Follower& follower = axis.motor.follower;
  follower.numerator = by.numerator;
  follower.denominator = by.denominator;
  follower.top_speed_pps = by.top_speed_pps;
  follower.slope_pps = by.slope_pps;
  follower.left_over %= by.denominator;
}

void Simple2R3::follow_encoder(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  if (lacks_ready(axis_number)) return;
  refresh_signals(axis_number);
  if (!may_begin(axis_number, reaction(axis_number, Event::sync), {.mode = Mode::sync})) return;
  begin_following(axis_number);
  leave_home(axis);
}

void Simple2R3::begin_following(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  simple2_r3::follow_encoder(axis, sync_follower(axis_number), followed_count(axis_number));
  // Nothing comes out until its first period begins.
  if (chose(option("sync_period", "every_fifth_tick")))
    axis.motor.follower.phase = static_cast<int>((now() + 1) % kSyncPeriod);
}

void Simple2R3::carry_out_kept(int axis) {
  const KeptCommand kept = std::exchange(state_.kept[static_cast<std::size_t>(axis)], {});
  switch (kept.mode) {
    case Mode::position:
      if (kept.command == Command::homing) return go_home(axis, kept.move.by_trigger);
      if (kept.command != Command::none) start_move(axis, kept.command, kept.move);
      return;
    case Mode::velocity: return run_velocity(axis, kept.value);
    case Mode::pwm: return output_pwm(axis, static_cast<std::uint8_t>(kept.value));
    case Mode::sync: return follow_encoder(axis);
  }
}

void Simple2R3::stop(int axis_number, Stopping how) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const AxisSlots& slots = kAxisSlots[static_cast<std::size_t>(axis_number)];
  forget_kept(axis_number);
  if (chose(option("values_after_stop", "zero"))) state_.image[slots.velocity] = state_.image[slots.pwm] = 0;
  if (how == Stopping::by_register && reaction(axis_number, Event::stop) == Outcome::slows) {
    axis.motor.slow_down(now());
    if (axis.motor.moving()) return;
  }
  const Mode mode = axis.mode;
  stop_drive(axis);
  if (mode != Mode::sync && chose(transitions::kModeStays)) axis.mode = mode;
}

void Simple2R3::switch_servo(int axis_number, bool on) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  const bool stays = axis.mode == Mode::pwm && reaction(axis_number, Event::servo_off) == Outcome::goes_on;
  if (!on && !stays && servo_matters(axis_number)) stop(axis_number);
  axis.motor.switch_servo(on);
  if (on) carry_out_kept(axis_number);
}

void Simple2R3::clear_alarm(int axis_number) {
  AxisState& axis = state_.axes[static_cast<std::size_t>(axis_number)];
  if (alarm_clear(axis_number) && chose(option("aclr_again", "ignored"))) return;
  axis.alarm_latched = false;  // an input that is on says so again
  axis.alarm_clear_until = now() + 1 + kAlarmClearTicks;
}

void Simple2R3::start_program(std::uint8_t line) {
  interpreter::simple2::Execution& execution = state_.execution;
  if (execution.running && chose(option("start_while_running", "ignored"))) return;
  const interpreter::simple2::LoopState loop = execution.loop;
  interpreter::simple2::start(execution, line);
  if (chose(option("start_while_running", "jumps")))
    execution.loop = loop;  // none of a program that does not run
  find_flags_if_told();
  if (!chose(option("program_start", "clears_them"))) return;
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
  for (int axis = 0; axis < 2 && chose(option("program_end", "stops")); ++axis) stop(axis);
  for (Timer& timer : state_.timers) {
    if (chose(option("timers_at_end", "stop"))) run_timer(timer, false);
  }
}

}  // namespace understudy::emulator::models::simple2_r3
