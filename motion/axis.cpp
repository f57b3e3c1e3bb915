#include "motion/axis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "motion/bad_motion.h"
#include "motion/environment.h"
#include "motion/move.h"
#include "motion/profile.h"
#include "motion/pulse_drive.h"
#include "motion/tick.h"

// The commands and reactions of an axis. The tick is in axis_step.cpp and axis_tick.cpp.
namespace understudy::motion {

namespace {

/// Beyond this, a double cannot represent every pulse.
constexpr std::int64_t kFarthestMove = std::int64_t{1} << 53;

std::int64_t size_of(std::int64_t pulses) { return pulses < 0 ? -pulses : pulses; }

void require_distance(std::int64_t distance_pulses) {
  if (distance_pulses < -kFarthestMove || distance_pulses > kFarthestMove) {
    throw BadMotion(Refusal::out_of_range, "move", "distance must be within 2^53 pulses");
  }
}

int sign_of(std::int64_t pulses) { return pulses < 0 ? -1 : +1; }

/// Returns true if the drive has not begun to move. A drive that was changed at this moment, and continues
/// with a profile that begins now, has begun.
bool not_begun(const PulseDrive& drive, Instant at) {
  return drive.elapsed_s(at) <= 0 && drive.sample(at).position_u <= 0;
}

/// Returns the drive's position. Because moments are rounded, it is corrected if it precedes a pulse that was
/// already sent.
Sample forward_sample(const PulseDrive& drive, Instant at) {
  Sample here = drive.sample(at);
  here.position_u = std::max(here.position_u, static_cast<double>(drive.sent_pulses));
  here.speed_u_s = std::max(here.speed_u_s, 0.0);
  return here;
}

/// Plans a continuation to the target that never reverses, because a drive has one direction. If the axis can
/// no longer stop at the target, it slows down as far as possible and stops there abruptly.
Profile forward_to(const Sample& here, double target_u, const SpeedLaw& law) {
  Profile rest = change_target(here, target_u, law);
  if (rest.segment_count == 0) return rest;
  const Segment& last = rest.segments[static_cast<std::size_t>(rest.segment_count - 1)];
  if (last.speed_u_s >= 0 && rest.end_speed_u_s >= 0) return rest;
  rest = slow_to_stop(here, law);
  rest.cut_at(std::max(target_u, here.position_u));
  rest.end_exactly_at(target_u);
  return rest;
}

/// Makes a stop decelerate at least as hard as the motion already does. Otherwise, a ramp by time would start
/// again from the present speed.
SpeedLaw no_gentler(const SpeedLaw& law, const Sample& here) {
  SpeedLaw stop = law;
  const double left_u_s = here.speed_u_s - law.start_speed_u_s;
  if (law.down.kind == RampLaw::Kind::time && here.acceleration_u_s2 < 0 && left_u_s > 0) {
    stop.down.duration_s = std::min(law.down.duration_s, left_u_s / -here.acceleration_u_s2);
  }
  return stop;
}

}  // namespace

Cause Axis::forbidden(int direction, Signals ignored) const {
  if (settings.needs_servo && !servo_on) return Cause::servo_off;
  const auto blocks = [&](Signal signal, Reaction reaction) {
    return (signals & ~ignored & bit(signal)) != 0 && reaction != Reaction::ignore;
  };
  if (blocks(Signal::emergency, settings.at_emergency)) return Cause::emergency;
  if (blocks(Signal::alarm, settings.at_alarm)) return Cause::alarm;
  if (direction > 0) {
    if (blocks(Signal::limit_plus, settings.at_limit_plus)) return Cause::limit_plus;
    if (settings.at_soft_limit != Reaction::ignore && settings.soft_limit_plus &&
        soft_limit_place() >= *settings.soft_limit_plus) {
      return Cause::soft_limit_plus;
    }
  } else {
    if (blocks(Signal::limit_minus, settings.at_limit_minus)) return Cause::limit_minus;
    if (settings.at_soft_limit_of_minus() != Reaction::ignore && settings.soft_limit_minus &&
        soft_limit_place() <= *settings.soft_limit_minus) {
      return Cause::soft_limit_minus;
    }
  }
  return Cause::none;
}

// ---- Beginning

Cause Axis::begin(Task what, int direction, std::int64_t distance_pulses, const SpeedLaw& speed, Instant at,
                  bool for_homing) {
  check(speed);
  // Plan before anything changes: an impossible motion must change nothing.
  const Profile profile = for_homing && homing.runs_on_by() != nullptr ? homing.plan_to_run_on()
                          : what == Task::endless
                              ? plan_endless(speed)
                              : plan(static_cast<double>(size_of(distance_pulses)), speed);
  // A stop from the maximum speed must also be possible: a reaction cannot be refused.
  (void)slow_to_stop({.speed_u_s = speed.top_speed_u_s}, speed);
  const std::int64_t untaken = backlash_before(direction);
  if (untaken > 0) require_positive(settings.backlash_speed_pps, "backlash", "speed");
  const Signals ignored = for_homing ? homing.row().ignores : Signals{0};
  if (const Cause why_not = forbidden(direction, ignored); why_not != Cause::none) return why_not;

  drop(at);
  if (!for_homing) homing.phase = -1;
  task = what;
  law = speed;
  target_pulses = what == Task::move ? size_of(distance_pulses) : 0;
  cause = Cause::none;
  if (!for_homing) events_between |= bit(Event::started);
  backlash_taken_pulses = direction > 0 ? settings.backlash_pulses - untaken : untaken;
  last_direction = static_cast<std::int8_t>(direction);
  base_pulses = travel_pulses;
  if (untaken > 0) {
    in_backlash = true;
    Profile extra;
    const auto pulses = static_cast<double>(untaken);
    extra.append(pulses / settings.backlash_speed_pps, settings.backlash_speed_pps, 0, 0);
    extra.end_exactly_at(pulses);
    drive.start(extra, direction, at);
  } else {
    drive.start(profile, direction, at);
  }
  return Cause::none;
}

/// Returns how many pulses of backlash precede a motion in `direction`: 0 before the first motion, because
/// the backlash is then unknown.
std::int64_t Axis::backlash_before(int direction) const {
  if (settings.slips) return settings.backlash_pulses;
  if (last_direction == 0) return 0;
  const std::int64_t untaken = std::clamp<std::int64_t>(backlash_taken_pulses, 0, settings.backlash_pulses);
  return direction > 0 ? settings.backlash_pulses - untaken : untaken;
}

Profile Axis::planned(const SpeedLaw& speed) const {
  if (homing.runs_on_by() != nullptr) return homing.plan_to_run_on();
  return task == Task::endless ? plan_endless(speed) : plan(static_cast<double>(target_pulses), speed);
}

/// Drops the running motion without an end event. A moment long before the present tick stands for "between
/// ticks".
void Axis::drop(Instant at) {
  if (constant_pps != 0) raise(Event::constant_ended, at);
  constant_pps = 0;
  drive.stop();
  task = Task::none;
  in_backlash = slowing = comes_back = settling = false;
  follower.phase = 0;
  base_pulses = travel_pulses;
  must_recheck = true;
}

Cause Axis::move(std::int64_t distance_pulses, const SpeedLaw& speed, Tick now) {
  require_distance(distance_pulses);
  check(speed);
  if (distance_pulses == 0) {
    homing.phase = -1;
    if (task != Task::none) end(Cause::arrived, {.tick = now});
    return Cause::none;
  }
  return begin(Task::move, sign_of(distance_pulses), distance_pulses, speed, {.tick = now + 1});
}

Cause Axis::move_on(double speed_pps, std::int64_t distance_pulses, const SpeedLaw& speed, Tick now) {
  if (speed_pps == 0 || distance_pulses == 0) return move(distance_pulses, speed, now);
  const int direction = speed_pps < 0 ? -1 : +1;
  const std::int64_t target = distance_pulses * direction;
  require_distance(distance_pulses);
  check(speed);
  const Sample here{.speed_u_s = std::abs(speed_pps)};
  const Profile to_stop = slow_to_stop(here, speed);
  if (to_stop.segment_count == 0) return move(distance_pulses, speed, now);
  // As in change_distance(): a stop within half a pulse of the target reaches it, and an impossible return is
  // refused immediately.
  const bool passes = to_stop.end_position_u > static_cast<double>(target) + 0.5;
  if (passes) plan(std::abs(std::floor(to_stop.end_position_u) - static_cast<double>(target)), speed);
  const Profile rest = passes ? to_stop : forward_to(here, static_cast<double>(target), speed);
  for (const int each : {direction, sign_of(distance_pulses)}) {
    if (const Cause why_not = forbidden(each); why_not != Cause::none) return why_not;
  }
  drop({.tick = now});
  homing.phase = -1;
  task = Task::move;
  law = speed;
  target_pulses = target;
  cause = Cause::none;
  comes_back = slowing = passes;
  events_between |= bit(Event::started);
  last_direction = static_cast<std::int8_t>(direction);
  drive.start(rest, direction, Instant{.tick = now});
  return Cause::none;
}

Cause Axis::run(int direction, const SpeedLaw& speed, Tick now) {
  return begin(Task::endless, direction < 0 ? -1 : +1, 0, speed, {.tick = now + 1});
}

Cause Axis::move_at_zero_speed(int direction) {
  if (const Cause why_not = forbidden(direction); why_not != Cause::none) return why_not;
  drop();
  homing.phase = -1;
  task = Task::hanging;
  cause = Cause::none;
  drive.move_at_zero_speed(direction);
  events_between |= bit(Event::started);
  return Cause::none;
}

Cause Axis::forbidden_anywhere() const {
  const Cause why_not = forbidden(+1);
  return why_not == Cause::servo_off || why_not == Cause::emergency || why_not == Cause::alarm ? why_not
                                                                                               : Cause::none;
}

Cause Axis::take_part() {
  if (const Cause why_not = forbidden_anywhere(); why_not != Cause::none) return why_not;
  drop();
  homing.phase = -1;
  task = Task::coordinated;
  cause = Cause::none;
  drive.direction = 0;  // until the first pulse, a limit behind the axis does not matter
  events_between |= bit(Event::started);
  return Cause::none;
}

void Axis::arrive(Instant at) {
  if (task != Task::coordinated || settling) return;
  if (settings.waits_for_in_position && (signals & bit(Signal::in_position)) == 0) {
    settling = must_recheck = true;
    return;
  }
  end(Cause::arrived, at);
}

Cause Axis::follow(const Follower& by) {
  by.check();
  if (const Cause why_not = forbidden_anywhere(); why_not != Cause::none) return why_not;
  drop();
  homing.phase = -1;
  task = Task::following;
  cause = Cause::none;
  drive.direction = 0;  // until the first pulse, a limit behind the axis does not matter
  follower = Follower{.numerator = by.numerator,
                      .denominator = by.denominator,
                      .period_ticks = by.period_ticks,
                      .top_speed_pps = by.top_speed_pps,
                      .slope_pps = by.slope_pps,
                      .catches_up = by.catches_up};
  events_between |= bit(Event::started);
  return Cause::none;
}

void Axis::feed(std::int64_t counts) {
  if (task == Task::following) follower.feed(counts);
}

// ---- Changing a running motion

void Axis::change_speed(const SpeedLaw& speed, Tick now) { change_speed(speed, Instant{.tick = now}); }

void Axis::change_speed(const SpeedLaw& speed, Instant at) {
  check(speed);
  if ((task != Task::move && task != Task::endless) || slowing || settling || homing.active()) return;
  go_on_by(speed, at);
}

void Axis::go_on_by(const SpeedLaw& speed, Instant at) {
  if (in_backlash || not_begun(drive, at)) {
    // The motion has not begun yet, so it begins with the new speed.
    const Profile whole = planned(speed);
    law = speed;
    if (!in_backlash) drive.continue_with(whole, drive.beginning());
    must_recheck = true;
    return;
  }
  const Profile rest = task == Task::endless
                           ? motion::change_speed(forward_sample(drive, at), speed.top_speed_u_s, speed)
                           : forward_to(forward_sample(drive, at), static_cast<double>(target_pulses), speed);
  law = speed;
  drive.continue_with(rest, at);
  must_recheck = true;
}

void Axis::change_distance(std::int64_t distance_pulses, bool stop_if_passed, Tick now) {
  require_distance(distance_pulses);
  if (task != Task::move || (slowing && !comes_back) || settling || homing.active()) return;
  const Instant at{.tick = now};
  if (in_backlash || not_begun(drive, at)) {
    if (distance_pulses < 0 && !stop_if_passed) {
      const Cause why = begin(Task::move, -drive.direction, distance_pulses, law, {.tick = now + 1});
      if (why != Cause::none) end(why, at);
      return;
    }
    if (distance_pulses <= 0) {
      end(stop_if_passed ? Cause::stopped : Cause::arrived, at);
      return;
    }
    const Profile whole = plan(static_cast<double>(distance_pulses), law);
    target_pulses = distance_pulses;
    if (!in_backlash) drive.continue_with(whole, drive.beginning());
    must_recheck = true;
    return;
  }
  if (stop_if_passed && distance_pulses <= drive.sent_pulses) {
    stop();
    return;
  }
  const auto target = static_cast<double>(distance_pulses);
  // An impossible return must be refused now, not when it is due.
  const auto require_return = [&](double from_u) {
    plan(std::abs(std::floor(from_u) - target), law);
    if (settings.backlash_pulses > 0) require_positive(settings.backlash_speed_pps, "backlash", "speed");
  };
  if (comes_back) {
    require_return(drive.profile.end_position_u);
    target_pulses = distance_pulses;  // the axis stops first, and then goes to the target
    return;
  }
  const Sample here = forward_sample(drive, at);
  const Profile to_stop = slow_to_stop(here, law);
  // Compare in pulses: a stop within half a pulse of the target reaches it.
  if (!stop_if_passed && to_stop.end_position_u > target + 0.5) {
    require_return(to_stop.end_position_u);
    comes_back = slowing = true;
    drive.continue_with(to_stop, at);
  } else {
    drive.continue_with(forward_to(here, target, law), at);
  }
  target_pulses = distance_pulses;
  must_recheck = true;
}

// ---- Stopping

void Axis::slow_down(Tick now, Cause why) { slow({.tick = now}, why); }

void Axis::slow(Instant at, Cause why) {
  if (homing.active()) homing_slows(why);
  if (task == Task::none || (slowing && !comes_back)) return;
  cause = why;
  comes_back = false;
  if (slowing) return;  // a motion that was about to reverse now only stops
  if (settling || in_backlash || (task != Task::move && task != Task::endless) || not_begun(drive, at)) {
    end(why, at);
    return;
  }
  const Sample here = forward_sample(drive, at);
  Profile rest = slow_to_stop(here, no_gentler(law, here));
  if (rest.segment_count == 0) {
    end(why, at);
    return;
  }
  // If a move is already slowing down, a stop must not pass the move's target.
  if (task == Task::move) {
    const auto target = static_cast<double>(target_pulses);
    rest.cut_at(std::max(target, rest.segments[0].position_u));
    // Except for rounding errors, the axis stops there along the ramp that is already running.
    constexpr double kRounding_pulses = 1e-5;
    if (std::abs(rest.end_position_u - target) < kRounding_pulses) rest.end_exactly_at(target);
  }
  slowing = true;
  drive.continue_with(rest, at);
  must_recheck = true;
}

bool Axis::resume(const SpeedLaw& speed, Tick now) {
  check(speed);
  const bool runs = task == Task::move || task == Task::endless;
  if (!runs || !slowing || comes_back || cause != Cause::stopped || homing.active()) return false;
  slowing = false;
  cause = Cause::none;
  go_on_by(speed, {.tick = now});
  return true;
}

void Axis::stop(Cause why) {
  if (task != Task::none) end(why, {.tick = 0});
}

void Axis::end(Cause why, Instant at) {
  drop(at);
  cause = why;
  if (homing.active()) {
    homing_stands(why, at);
  } else {
    raise(Event::ended, at);
  }
}

void Axis::react(Reaction reaction, Cause why, Instant at) {
  if (task == Task::none || reaction == Reaction::ignore) return;
  if (reaction == Reaction::slow_down && !in_backlash && (task == Task::move || task == Task::endless)) {
    slow(at, why);
  } else if (reaction == Reaction::slow_down && task == Task::coordinated) {
    // motion/coordinated.h slows down the path with all its axes.
    if (!slowing) cause = why;
    slowing = true;
  } else {
    end(why, at);
  }
}

void Axis::switch_servo(bool on) {
  servo_on = on;
  if (!on && settings.needs_servo && task != Task::none) end(Cause::servo_off, {.tick = 0});
}

// ---- Numbers

void check(const AxisSettings& settings) {
  require_not_negative(static_cast<double>(settings.backlash_pulses), "backlash", "pulses");
  require_finite(settings.backlash_speed_pps, "backlash", "speed");
  if (settings.backlash_pulses > 0) require_positive(settings.backlash_speed_pps, "backlash", "speed");
}

void Axis::set(const AxisSettings& changed) {
  check(changed);
  // New backlash is taken up in the last direction to the same extent as the old backlash.
  const bool is_positive = last_direction > 0;
  const std::int64_t before =
      is_positive ? settings.backlash_pulses - backlash_taken_pulses : backlash_taken_pulses;
  settings = changed;
  const std::int64_t left = std::clamp<std::int64_t>(before, 0, settings.backlash_pulses);
  backlash_taken_pulses = is_positive ? settings.backlash_pulses - left : left;
  must_recheck = true;
}

}  // namespace understudy::motion
