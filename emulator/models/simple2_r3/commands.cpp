#include "emulator/models/simple2_r3/commands.h"

#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/marks.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/state.h"
#include "emulator/models/simple2_r3/transitions.h"
#include "motion/axis.h"
#include "motion/following.h"
#include "motion/homing_tables.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

constexpr Tick kAlarmClearTicks = 200;  // 0x1017, 0x1018

}  // namespace

bool AxisCommands::may_begin(Outcome outcome, const KeptCommand& what) {
  if (replaces_kept(outcome)) forget_kept();
  switch (outcome) {
    case Outcome::begins:
    case Outcome::changes: return true;
    case Outcome::kept:
      kept() = what;
      if (what.command != Command::none) axis().cut_short = false;
      return false;
    case Outcome::ends: stop_drive(axis()); return false;
    case Outcome::continues:
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

void AxisCommands::start_move(Command command, const MoveParameters& move) {
  AxisState& axis = this->axis();
  std::int64_t distance_pulses = move.distance_pulses;
  // At any speed, a distance of 0 stops at once (appendix A).
  if (distance_pulses != 0) {
    if (lacks_ready()) return tell_not_ready(Event::move_away);
    if (is_refused_as_too_fast(std::int64_t{1000} * move.speed_rpm)) return tell_too_fast(Event::move_away);
    const bool counts_on =
        command == Command::incremental && chose(option("incremental_while_moving", "old_target"));
    if (counts_on) distance_pulses += remaining_pulses(axis);
  }
  refresh_signals();
  const int direction = distance_pulses < 0 ? -1 : +1;
  const Event event = distance_pulses == 0
                          ? Event::move_nowhere
                          : event_by_direction(direction, Event::move_towards, Event::move_away);
  const Outcome outcome = reaction(event);
  tell(event, outcome);
  if (!may_begin(outcome, {.command = command, .move = move})) return;
  const double speed_pps = outcome == Outcome::changes ? speed_of_pulses() : 0;
  stop_drive(axis);
  axis.cut_short = false;
  if (distance_pulses == 0) return;
  const motion::SpeedLaw law = law_of(move.speed_rpm, move.acceleration_10ms, move.deceleration_10ms);
  const motion::Cause refused = move.speed_rpm == 0 ? axis.motor.move_at_zero_speed(direction)
                                : speed_pps != 0
                                    ? axis.motor.move_on(speed_pps, distance_pulses, law, now())
                                    : axis.motor.move(distance_pulses, law, setup().tick_before_motion());
  if (refused != motion::Cause::none) return tell_refused(event);
  // remaining_pulses() needs the whole distance.
  if (move.speed_rpm == 0) axis.motor.target_pulses = distance_pulses * direction;
  axis.command = command;
  axis.has_own_speed = move.of_the_axis;
  axis.by_trigger = move.by_trigger;
  leave_home();
}

void AxisCommands::go_home(bool by_trigger) {
  AxisState& axis = this->axis();
  const std::uint32_t speed_rpm = shared(slots().home_speed);
  if (lacks_ready()) return tell_not_ready(Event::home);
  if (is_refused_as_too_fast(std::int64_t{1000} * speed_rpm)) return tell_too_fast(Event::home);
  if (chose(option("home_unassigned", "dropped")) && !signals().assigned(slots().home_assigned))
    return tell_no_home();
  refresh_signals();
  const Outcome outcome = reaction(Event::home);
  tell(Event::home, outcome);
  if (!may_begin(outcome, {.command = Command::homing, .move = {.by_trigger = by_trigger}})) return;
  stop_drive(axis);
  axis.cut_short = false;
  axis.homed = false;
  axis.motor.signals = axis.signals.steady;
  const std::uint32_t time_10ms = shared(slots().home_acc_time);
  const motion::Simple2Homing how{.direction = shared(slots().home_direction) != 0 ? +1 : -1,
                                  .speed = law_of(speed_rpm, time_10ms, time_10ms)};
  const motion::Cause refused =
      axis.motor.home(chose(option("homing_sequence", "stops_at_first_edge")) ? homing_to_first_edge(how)
                                                                              : motion::simple2_homing(how),
                      setup().tick_before_motion());
  if (refused != motion::Cause::none) return tell_refused(Event::home);
  axis.command = Command::homing;
  axis.by_trigger = by_trigger;
}

void AxisCommands::speed_changed() {
  AxisState& axis = this->axis();
  const bool runs_by_it =
      axis.has_own_speed && (axis.command == Command::incremental || axis.command == Command::absolute);
  const std::uint32_t speed_rpm = shared(slots().speed);
  if (!runs_by_it || speed_rpm == 0 || !chose(option("speed_while_moving", "at_once"))) return;
  axis.motor.change_speed(law_of(speed_rpm, shared(slots().acc_time), shared(slots().dec_time)), now());
}

void AxisCommands::preset_coordinate(std::int32_t pulses) {
  AxisState& axis = this->axis();
  const std::int64_t more = std::int64_t{pulses} - axis.coordinate_pulses;
  axis.coordinate_pulses = pulses;
  if (axis.command == Command::absolute && chose(option("preset_while_moving", "keeps_target")))
    keep_target(axis, more, now());
}

void AxisCommands::run_velocity(std::int64_t milli_rpm) {
  AxisState& axis = this->axis();
  refresh_signals();
  const bool is_unready = milli_rpm != 0 && lacks_ready();
  const bool is_refused = is_unready || is_refused_as_too_fast(milli_rpm);
  const Event event = milli_rpm == 0 ? Event::velocity_zero
                                     : event_by_direction(milli_rpm < 0 ? -1 : +1, Event::velocity_towards,
                                                          Event::velocity_away);
  const Outcome outcome = is_refused ? Outcome::dropped : reaction(event);
  is_unready ? tell_not_ready(event) : is_refused ? tell_too_fast(event) : tell(event, outcome);
  if (replaces_kept(outcome)) forget_kept();
  switch (outcome) {
    case Outcome::begins:
    case Outcome::changes:
      simple2_r3::run_velocity(axis, milli_rpm);
      axis.velocity_resolution = resolution();
      axis.velocity_step_urpm = velocity_step_urpm();
      if (milli_rpm != 0) leave_home();
      break;
    case Outcome::waits:
    case Outcome::slows_and_waits: axis.target_urpm = milli_rpm * 1000; break;
    case Outcome::slows: take_off(axis, outcome); break;
    case Outcome::continues:
    case Outcome::stops:
    case Outcome::leaves:
    case Outcome::turns:
    case Outcome::blocked:
    case Outcome::resumes:
    case Outcome::dropped:
    case Outcome::kept:
    case Outcome::ends: (void)may_begin(outcome, {.mode = Mode::velocity, .value = milli_rpm});
  }
  if (is_forgotten(outcome)) {
    shared(slots().velocity) = static_cast<std::uint32_t>(axis.target_urpm / 1000);
  }
}

void AxisCommands::show_velocity(std::int32_t milli_rpm) {
  if (shows_command_values()) shared(slots().velocity) = static_cast<std::uint32_t>(milli_rpm);
}

void AxisCommands::show_pwm(std::uint8_t percent) {
  if (shows_command_values()) shared(slots().pwm) = percent;
}

void AxisCommands::output_pwm(std::uint8_t percent) {
  AxisState& axis = this->axis();
  refresh_signals();
  const Event event = percent == 0 ? Event::pwm_zero : Event::pwm;
  const bool is_unready = percent != 0 && lacks_ready();
  const Outcome outcome = is_unready ? Outcome::dropped : reaction(event);
  is_unready ? tell_not_ready(event) : tell(event, outcome);
  if (outcome == Outcome::waits) {
    forget_kept();
    axis.pwm_percent = percent;
  } else if (may_begin(outcome, {.mode = Mode::pwm, .value = percent})) {
    simple2_r3::output_pwm(axis, percent);
  }
  if (is_forgotten(outcome)) {
    shared(slots().pwm) = axis.pwm_percent;
  }
}

void AxisCommands::sync_changed() {
  AxisState& axis = this->axis();
  if (axis.mode != Mode::sync || !chose(option("sync_settings", "at_once"))) return;
  const motion::Follower by = sync_follower();
  motion::Follower& follower = axis.motor.follower;
  follower.numerator = by.numerator;
  follower.denominator = by.denominator;
  follower.top_speed_pps = by.top_speed_pps;
  follower.slope_pps = by.slope_pps;
  follower.left_over %= by.denominator;
}

void AxisCommands::follow_encoder() {
  if (lacks_ready()) return tell_not_ready(Event::sync);
  refresh_signals();
  const Outcome outcome = reaction(Event::sync);
  tell(Event::sync, outcome);
  if (!may_begin(outcome, {.mode = Mode::sync})) return;
  begin_following();
  leave_home();
}

void AxisCommands::carry_out_kept() {
  const KeptCommand kept = std::exchange(this->kept(), {});
  switch (kept.mode) {
    case Mode::position:
      if (kept.command == Command::homing) return go_home(kept.move.by_trigger);
      if (kept.command != Command::none) start_move(kept.command, kept.move);
      return;
    case Mode::velocity: return run_velocity(kept.value);
    case Mode::pwm: return output_pwm(static_cast<std::uint8_t>(kept.value));
    case Mode::sync: return follow_encoder();
  }
}

void AxisCommands::switch_servo(bool on) {
  if (!on) return servo_off();
  axis().motor.switch_servo(true);
  carry_out_kept();
}

void AxisCommands::clear_alarm() {
  AxisState& axis = this->axis();
  if (signals().alarm_clear(number()) && chose(option("aclr_again", "ignored"))) return tell_clears_already();
  axis.alarm_latched = false;  // an input that is still on sets it again
  axis.alarm_clear_until = now() + 1 + kAlarmClearTicks;
}

}  // namespace understudy::emulator::models::simple2_r3
