#include "motion/pulse_drive.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "motion/profile.h"
#include "motion/tick.h"

namespace understudy::motion {

namespace {

double tolerance_for(const Profile& profile) {
  return pulse_tolerance(profile.endless() ? 0 : std::abs(profile.end_position_u));
}

}  // namespace

void PulseDrive::start(const Profile& move, int move_direction, Tick first_tick) {
  start(move, move_direction, Instant{.tick = first_tick});
}

void PulseDrive::start(const Profile& move, int move_direction, Instant begin) {
  stop();
  if (move.segment_count == 0) return;
  direction = move_direction < 0 ? -1 : +1;
  continue_with(move, begin);
}

void PulseDrive::continue_with(const Profile& rest, Instant begin) {
  drive = Drive::running;
  profile = rest;
  tolerance = std::max(tolerance, tolerance_for(rest));  // pulses already sent stay sent
  begin_tick = begin.tick;
  begin_after_s = begin.after_s;
  look_up_segment(begin.tick);
}

void PulseDrive::move_at_zero_speed(int move_direction) {
  stop();
  drive = Drive::hanging;
  direction = move_direction < 0 ? -1 : +1;
}

void PulseDrive::stop() {
  // The direction does not change here, because it is used to detect a reversal.
  const std::int64_t last = direction;
  *this = PulseDrive{};
  direction = last;
}

void PulseDrive::look_up_segment(Tick tick) {
  const double t_s = elapsed_s(tick);
  if (profile.segment_count == 0 || over_at(tick)) {
    // The drive has ended: it is exactly at its end, and stays there.
    now = TickSegment{.place = profile.end_position_u + tolerance};
    next_check = kNoTick;
    return;
  }
  auto i = static_cast<std::size_t>(profile.segment_count - 1);
  while (i > 0 && t_s < profile.segments[i].begin_s) --i;
  const Segment& s = profile.segments[i];
  now = {.begin_ticks = (begin_after_s + s.begin_s) * kTicksPerSecond,
         .place = s.position_u + tolerance,
         .first = s.speed_u_s / kTicksPerSecond,
         .second = 0.5 * s.acceleration_u_s2 / (kTicksPerSecond * kTicksPerSecond),
         .third = s.jerk_u_s3 / (6 * kTicksPerSecond * kTicksPerSecond * kTicksPerSecond)};
  const bool last = i + 1 == static_cast<std::size_t>(profile.segment_count);
  const double end_s = last ? profile.duration_s : profile.segments[i + 1].begin_s;
  if (std::isinf(end_s)) {
    next_check = kNoTick;
    return;
  }
  const double ticks = (end_s + begin_after_s) * kTicksPerSecond - kTickTolerance;
  next_check = std::max(tick + 1, begin_tick + static_cast<Tick>(std::ceil(ticks)));
}

Sample PulseDrive::sample(Instant at) const {
  if (drive != Drive::running) return {.position_u = static_cast<double>(sent_pulses)};
  return profile.sample(elapsed_s(at));
}

std::int64_t PulseDrive::pulses_at_moment(Instant at) const {
  return drive == Drive::running ? whole(profile.sample(elapsed_s(at)).position_u + tolerance) : sent_pulses;
}

Instant PulseDrive::time_of_pulse(std::int64_t pulse, Instant from, Instant until) const {
  const double base_s = elapsed_s(from);
  const double reached_s = time_of(profile, static_cast<double>(pulse) - tolerance, base_s, elapsed_s(until));
  Instant at{.tick = from.tick, .after_s = from.after_s + (reached_s - base_s)};
  // Advance by whole seconds at once, because the drive of a restored state may have begun long ago.
  const double whole_s = std::floor(at.after_s);
  at.after_s -= whole_s;
  at.tick += static_cast<Tick>(whole_s * kTicksPerSecond);
  while (at.after_s >= 1 / kTicksPerSecond) {
    at.after_s -= 1 / kTicksPerSecond;
    ++at.tick;
  }
  // Rounding must not put the moment into the next tick.
  if (at.tick > until.tick || (at.tick == until.tick && at.after_s > until.after_s)) return until;
  return at;
}

}  // namespace understudy::motion
