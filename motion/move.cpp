#include "motion/move.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "motion/bad_motion.h"
#include "motion/bisection.h"
#include "motion/profile.h"
#include "motion/ramp.h"
#include "motion/short_move.h"

namespace understudy::motion {

namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();

const RampLaw& reckoned(const SpeedLaw& law) {
  return law.slow_down_reckoned_by ? *law.slow_down_reckoned_by : law.down;
}

double start_speed(const SpeedLaw& law) { return std::min(law.start_speed_u_s, law.top_speed_u_s); }

/// Returns the remaining distance at which the deceleration from `speed_u_s` begins.
double slow_down_distance(const SpeedLaw& law, double speed_u_s) {
  const double start = start_speed(law);
  const double reckoned_u = law.slow_down_at_u  ? *law.slow_down_at_u
                            : speed_u_s > start ? ramp_distance(reckoned(law), speed_u_s, start)
                                                : 0;
  return reckoned_u + law.slow_down_offset_u;
}

/// A smaller distance is a rounding error, not a distance to cover.
double rounding_of(double target_u) { return 1e-9 + 1e-14 * std::abs(target_u); }

bool slows_down_by_chip_rules(const SpeedLaw& law) {
  return law.slow_down_at_u || law.slow_down_reckoned_by || law.slow_down_offset_u != 0;
}

/// Slows down from `speed_u_s` and ends at `target_u`: the profile covers the rest at creep speed, or is cut
/// off.
void finish(Profile& profile, const SpeedLaw& law, double speed_u_s, double target_u) {
  const double start = start_speed(law);
  if (speed_u_s > start) append_ramp(profile, law.down, speed_u_s, start);
  if (slows_down_by_chip_rules(law) || speed_u_s <= start) {
    const double left = target_u - profile.end_position_u;
    if (left > rounding_of(target_u)) {
      if (start <= 0) {
        throw BadMotion(Refusal::not_positive, "move",
                        "start speed must be above 0 so that the axis can creep to the end; it is 0");
      }
      profile.append(left / start, start, 0, 0);
    } else if (left < -rounding_of(target_u)) {
      profile.cut_at(target_u);
    }
  }
  profile.end_exactly_at(target_u);
}

/// Appends a whole move, forwards or backwards.
void append_move(Profile& profile, const Profile& move, double sign) {
  for (std::int32_t i = 0; i < move.segment_count; ++i) {
    const Segment& s = move.segments[static_cast<std::size_t>(i)];
    const bool last = i + 1 == move.segment_count;
    const double end_s = last ? move.duration_s : move.segments[static_cast<std::size_t>(i) + 1].begin_s;
    profile.append(end_s - s.begin_s, sign * s.speed_u_s, sign * s.acceleration_u_s2, sign * s.jerk_u_s3);
  }
}

/// Accelerates as long as the later deceleration permits, and breaks off the ramp there.
Profile rise_and_break_off(const SpeedLaw& law, double target_u) {
  Profile profile;
  append_ramp(profile, law.up, start_speed(law), law.top_speed_u_s);
  const auto must_slow_down = [&](const Sample& here) {
    return here.position_u + slow_down_distance(law, here.speed_u_s) >= target_u;
  };
  const Sample top{.position_u = profile.end_position_u, .speed_u_s = law.top_speed_u_s};
  if (must_slow_down(top)) {
    const auto too_late = [&](double t_s) { return must_slow_down(profile.sample(t_s)); };
    profile.cut_at(profile.sample(turnover(0, profile.duration_s, too_late).before).position_u);
  }
  return profile;
}

/// Even if each quantity is valid, the ramp may take 1e400 s.
void require_doubles_hold(const Profile& profile, bool endless = false) {
  bool held = endless || (std::isfinite(profile.duration_s) && std::isfinite(profile.end_position_u));
  for (std::int32_t i = 0; i < profile.segment_count; ++i) {
    const Segment& s = profile.segments[static_cast<std::size_t>(i)];
    for (const double value : {s.begin_s, s.position_u, s.speed_u_s, s.acceleration_u_s2, s.jerk_u_s3}) {
      held = held && std::isfinite(value);
    }
  }
  if (!held)
    throw BadMotion(Refusal::out_of_range, "move", "quantities must give a profile that fits in doubles");
}

}  // namespace

void check(const SpeedLaw& law) {
  require_positive(law.top_speed_u_s, "move", "top speed");
  require_not_negative(law.start_speed_u_s, "move", "start speed");
  check(law.up);
  check(law.down);
  if (law.slow_down_reckoned_by) check(*law.slow_down_reckoned_by);
  if (law.slow_down_at_u) require_not_negative(*law.slow_down_at_u, "move", "slow-down position");
  require_finite(law.slow_down_offset_u, "move", "slow-down offset");
}

Profile plan(double distance_u, const SpeedLaw& law) {
  check(law);
  require_not_negative(distance_u, "move", "distance");
  Profile profile;
  if (distance_u == 0) return profile;

  const double start = start_speed(law);
  double top = law.top_speed_u_s;
  if (law.slow_down_at_u || law.when_short == Short::cut_ramp) {
    profile = rise_and_break_off(law, distance_u);
    top = profile.segment_count > 0 ? profile.end_speed_u_s : start;
  } else {
    const double room =
        (distance_u - law.slow_down_offset_u) * (law.when_short == Short::keep_half ? 0.5 : 1.0);
    const double whole_rise = top - start;
    const double rise = rise_within(room, start, law.up, reckoned(law), whole_rise);
    if (rise < whole_rise) {
      top = start + rise;
      // If the start speed is large, a small rise might be rounded up to more than the available room.
      if (top - start > rise) top = std::nextafter(top, start);
    }
    if (top > start) append_ramp(profile, law.up, start, top);
  }
  const double cruise = distance_u - profile.end_position_u - slow_down_distance(law, top);
  if (cruise > 0) profile.append(cruise / top, top, 0, 0);
  finish(profile, law, top, distance_u);
  require_doubles_hold(profile);
  return profile;
}

Profile plan_endless(const SpeedLaw& law) {
  check(law);
  Profile profile;
  append_ramp(profile, law.up, start_speed(law), law.top_speed_u_s);
  profile.append(kForEver, law.top_speed_u_s, 0, 0);
  require_doubles_hold(profile, true);
  return profile;
}

Profile plan_passing(double distance_u, double passing_speed_u_s, const SpeedLaw& law) {
  check(law);
  require_not_negative(distance_u, "move", "distance");
  require_positive(passing_speed_u_s, "move", "passing speed");
  const double start = start_speed(law);
  const double min = std::max(passing_speed_u_s, start);
  const auto is_too_fast = [&](double top_u_s) {
    return ramp_distance(law.up, start, top_u_s) + ramp_distance(law.down, top_u_s, min) > distance_u;
  };
  if (law.top_speed_u_s <= passing_speed_u_s || is_too_fast(min)) {
    SpeedLaw slow = law;
    slow.top_speed_u_s = passing_speed_u_s;
    return plan_endless(slow);
  }
  double top = law.top_speed_u_s;
  if (is_too_fast(top)) top = turnover(min, top, is_too_fast).before;
  Profile profile;
  append_ramp(profile, law.up, start, top);
  const double cruise = distance_u - profile.end_position_u - ramp_distance(law.down, top, min);
  if (cruise > 0) profile.append(cruise / top, top, 0, 0);
  append_ramp(profile, law.down, top, min);
  profile.append(kForEver, passing_speed_u_s, 0, 0);
  require_doubles_hold(profile, true);
  return profile;
}

namespace {

/// Speeds below the start speed are skipped without acceleration.
Sample without_jump(const Sample& now, const SpeedLaw& law) {
  const double start = start_speed(law);
  if (now.speed_u_s >= start) return now;
  return {.position_u = now.position_u, .speed_u_s = start};
}

void check_state(const Sample& now) {
  require_finite(now.position_u, "move in progress", "position");
  require_not_negative(now.speed_u_s, "move in progress", "speed");
  require_finite(now.acceleration_u_s2, "move in progress", "acceleration");
  require_finite(now.jerk_u_s3, "move in progress", "jerk");
}

void append_change(Profile& profile, const Sample& now, double to_u_s, const SpeedLaw& law) {
  append_change(
      profile, now, to_u_s, law.up, law.down,
      {.min_u_s = start_speed(law), .max_u_s = std::max({law.top_speed_u_s, now.speed_u_s, to_u_s})});
}

double speed_without_acceleration(const Sample& now, const SpeedLaw& law) {
  return speed_without_acceleration(
      now, law.up, law.down,
      {.min_u_s = start_speed(law), .max_u_s = std::max(law.top_speed_u_s, now.speed_u_s)});
}

}  // namespace

Profile change_speed(const Sample& now, double speed_u_s, const SpeedLaw& law) {
  check(law);
  check_state(now);
  require_not_negative(speed_u_s, "change of speed", "speed");
  if (speed_u_s == 0) return slow_to_stop(now, law);
  Profile profile = Profile::from(now.position_u);
  if (speed_u_s > law.start_speed_u_s) {
    append_change(profile, without_jump(now, law), speed_u_s, law);
  } else if (now.speed_u_s > law.start_speed_u_s) {
    append_change(profile, now, law.start_speed_u_s, law);
  }
  profile.append(kForEver, speed_u_s, 0, 0);
  require_doubles_hold(profile, true);
  return profile;
}

Profile slow_to_stop(const Sample& now, const SpeedLaw& law) {
  check(law);
  check_state(now);
  Profile profile = Profile::from(now.position_u);
  const double start = start_speed(law);
  if (now.speed_u_s > start) append_change(profile, now, start, law);
  require_doubles_hold(profile);
  return profile;
}

Profile change_target(const Sample& state, double target_u, const SpeedLaw& law) {
  check(law);
  check_state(state);
  require_finite(target_u, "change of target", "target");
  if (state.speed_u_s == 0) {
    // At rest: a separate move, forwards or backwards.
    Profile profile = Profile::from(state.position_u);
    const double distance = std::abs(target_u - state.position_u);
    if (distance > rounding_of(target_u)) {
      append_move(profile, plan(distance, law), target_u < state.position_u ? -1 : 1);
    }
    profile.end_exactly_at(target_u);
    require_doubles_hold(profile);
    return profile;
  }
  const Sample now = without_jump(state, law);
  const double start = start_speed(law);
  const double top = std::max(start, law.top_speed_u_s);

  // Returns the distance to `peak` and on to the point where slowing down begins.
  const auto needed = [&](double peak) {
    Profile change;
    append_change(change, now, peak, law);
    return change.end_position_u + slow_down_distance(law, peak);
  };
  const double room = target_u - now.position_u;
  // The present acceleration raises the speed at least to this value.
  const double faded = speed_without_acceleration(now, law);
  Profile stop = slow_to_stop(now, law);
  if (std::abs(stop.end_position_u - target_u) <= rounding_of(target_u)) {
    stop.end_exactly_at(target_u);
    return stop;
  }
  // With a law that assumes too short a ramp, the move does not pass a target ahead: it is cut off at the
  // target.
  if (stop.end_position_u > target_u && (room < 0 || needed(faded) > room)) {
    append_move(stop, plan(stop.end_position_u - target_u, law), -1);
    stop.end_exactly_at(target_u);
    require_doubles_hold(stop);
    return stop;
  }
  double peak = top;
  if (needed(top) > room) {
    // Slowing down after reaching `faded` takes longer than slowing down at once. So if the motion can
    // continue from `faded`, the peak is above that.
    const double low = faded < top && needed(faded) <= room ? faded : start;
    peak = turnover(low, top, [&](double middle) { return needed(middle) > room; }).before;
  }
  Profile profile = Profile::from(now.position_u);
  append_change(profile, now, peak, law);
  const double cruise = target_u - profile.end_position_u - slow_down_distance(law, peak);
  // It would take a long time to cover a rounding error.
  if (cruise > rounding_of(target_u) && peak > 0) profile.append(cruise / peak, peak, 0, 0);
  finish(profile, law, peak, target_u);
  require_doubles_hold(profile);
  return profile;
}

}  // namespace understudy::motion
