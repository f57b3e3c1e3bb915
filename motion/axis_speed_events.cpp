#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "motion/axis.h"
#include "motion/profile.h"
#include "motion/pulse_drive.h"
#include "motion/tick.h"

// C-STA and C-END: events at the pulses where constant speed begins and ends.
namespace understudy::motion {

namespace {

constexpr Events kConstant = bit(Event::constant_started) | bit(Event::constant_ended);

/// New plans have the same speed, except for rounding errors.
bool same_speed(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(a, b); }

double constant_speed(const Segment& segment) {
  const bool is_constant = segment.acceleration_u_s2 == 0 && segment.jerk_u_s3 == 0;
  return is_constant && segment.speed_u_s > 0 ? segment.speed_u_s : 0;
}

/// Returns the last pulse sent before the profile is at `place_u`. A pulse exactly at that place belongs to
/// the next segment.
std::int64_t last_pulse_before(double place_u, double tolerance) {
  constexpr double kMax = 9e18;
  if (!(place_u < kMax)) return INT64_MAX;
  return static_cast<std::int64_t>(std::ceil(place_u - tolerance)) - 1;
}

}  // namespace

void Axis::raise(Event event, Instant at) {
  const bool is_asked_for = event < Event::pulse || (settings.raises & bit(event)) != 0;
  if (!is_asked_for) return;
  events_between |= bit(event);
  event_at[static_cast<std::size_t>(event)] = at;
}

/// Finds the first and the last pulse at constant speed between the two moments, among the pulses after
/// `sent_before`. Homing does not raise these events.
void Axis::check_speed(std::int64_t sent_before, Instant from, Instant until) {
  if ((settings.raises & kConstant) == 0 || homing.active() || drive.sent_pulses <= sent_before) return;
  const Profile& profile = drive.profile;
  const auto changes_to = [&](double speed_pps, std::int64_t pulse) {
    if (same_speed(speed_pps, constant_pps)) return;
    const Instant at = drive.time_of_pulse(pulse, from, until);
    if (constant_pps != 0) raise(Event::constant_ended, at);
    if (speed_pps != 0) raise(Event::constant_started, at);
    constant_pps = speed_pps;
  };
  std::int64_t pulse = sent_before + 1;
  for (std::int32_t i = 0; i < profile.segment_count && pulse <= drive.sent_pulses; ++i) {
    const auto number = static_cast<std::size_t>(i);
    const bool is_last = i + 1 == profile.segment_count;
    const std::int64_t last_of_it =
        is_last ? INT64_MAX : last_pulse_before(profile.segments[number + 1].position_u, drive.tolerance);
    if (last_of_it < pulse) continue;
    changes_to(constant_speed(profile.segments[number]), pulse);
    pulse = last_of_it == INT64_MAX ? INT64_MAX : last_of_it + 1;
  }
  const bool was_the_last =
      !profile.endless() && drive.sent_pulses > last_pulse_before(profile.end_position_u, drive.tolerance);
  if (was_the_last) changes_to(0, drive.sent_pulses);
}

/// Returns true if the next pulse may raise an event although it lies in the middle of a segment.
bool Axis::waits_for_constant_speed() const {
  if ((settings.raises & kConstant) == 0 || !drive.moving() || in_backlash || homing.active()) return false;
  const bool is_constant = drive.now.second == 0 && drive.now.third == 0 && drive.now.first > 0;
  return !same_speed(is_constant ? drive.now.first * kTicksPerSecond : 0, constant_pps);
}

}  // namespace understudy::motion
