#include "motion/axis_tick.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/pulse_drive.h"
#include "motion/tick.h"

namespace understudy::motion {

namespace {

constexpr double kTick_s = 1 / kTicksPerSecond;

/// No drive is this fast. The speed in a restored state may be, and must not keep its tick running forever.
constexpr std::int64_t kMaxInATick = 1'000'000;

Instant later(const Instant& one, const Instant& other) { return is_before(one, other) ? other : one; }

}  // namespace

AxisTick::AxisTick(Axis& axis, const Environment& environment, Tick tick, std::optional<std::int64_t> carried)
    : axis_(axis),
      here_(environment),
      tick_(tick),
      at_{.tick = tick - 1},
      until_{.tick = tick},
      travel_before_(axis.travel_pulses),
      backlash_before_(axis.backlash_sent) {
  at_end_ = axis_.events_between & events_of(Moment::end);
  axis_.events_between = static_cast<Events>(axis_.events_between & ~at_end_);
  for (std::size_t i = 0; i < kEvents; ++i) {
    const bool was_between = (axis_.events_between >> i & 1U) != 0;
    if (was_between && axis_.event_at[i].tick < tick - 1) axis_.event_at[i] = at_;
  }
  axis_.encoder_is_known = environment.encoder.is_known();
  if (axis_.encoder_is_known) {
    // Nothing has happened since the last check, unless the machine was moved or has stopped following.
    if (axis_.seen_version == environment.version)
      axis_.encoder_seen = environment.encoder.at(axis_.travel_pulses);
  }
  axis_.seen_version = environment.version;
  axis_.must_recheck = false;
  axis_.update_signals(environment, at_, 0);
  const bool is_carried = axis_.task == Task::following || (carried && axis_.task == Task::coordinated);
  if (!is_carried) return;
  carried_by_ = axis_.task;
  carried_ = carried ? *carried : axis_.follower.step();
  if (carried_ != 0 && !sets_out(carried_ < 0 ? -1 : +1, at_)) carried_ = 0;
}

/// Returns true if a profile sends pulses in this tick.
bool AxisTick::drives() const {
  return axis_.drive.drive == Drive::running && !axis_.in_backlash && axis_.drive.elapsed_s(until_) >= 0;
}

Instant AxisTick::end_of_drive() const {
  const double over_s = axis_.drive.elapsed_s(until_) - axis_.drive.profile.duration_s;
  if (!(over_s > 0)) return until_;
  return later(at_, {.tick = tick_ - 1, .after_s = std::max(0.0, kTick_s - over_s)});
}

/// Carried pulses are spread evenly over the tick, the last one at its end.
Instant AxisTick::moment_of_carried(std::int64_t pulse) const {
  if (pulse >= std::abs(carried_)) return until_;
  const double part = static_cast<double>(pulse) / static_cast<double>(std::abs(carried_));
  return later(at_, {.tick = tick_ - 1, .after_s = part * kTick_s});
}

const Instant& AxisTick::next() {
  if (next_ == What::unknown) find_next();
  if (next_ == What::again) moment_ = at_;
  return moment_;
}

void AxisTick::find_next() {
  next_ = What::nothing;
  moment_ = until_;
  PulseDrive& drive = axis_.drive;
  if (drives()) {
    axis_.watch(here_);
    const std::int64_t travel = axis_.base_pulses + drive.direction * drive.pulses_at(tick_);
    if (travel < axis_.watch_low || travel > axis_.watch_high) {
      const bool too_fast = std::abs(travel - axis_.travel_pulses) > kMaxInATick;
      const std::int64_t edge = too_fast                    ? travel
                                : travel > axis_.watch_high ? axis_.watch_high + 1
                                                            : axis_.watch_low - 1;
      next_ = What::edge;
      moment_ = drive.time_of_pulse((edge - axis_.base_pulses) * drive.direction, at_, until_);
    } else if (drive.over_at(tick_)) {
      next_ = What::drive_ends;
      moment_ = end_of_drive();
    }
  } else if (axis_.in_backlash) {
    if (drive.over_at(tick_)) {
      next_ = What::backlash_ends;
      moment_ = end_of_drive();
    }
  } else if (come_ != std::abs(carried_) && axis_.task == carried_by_) {
    axis_.watch(here_);
    const std::int64_t left = std::abs(carried_) - come_;
    const std::int64_t room =
        carried_ > 0 ? axis_.watch_high - axis_.travel_pulses : axis_.travel_pulses - axis_.watch_low;
    if (left > room) {
      next_ = What::carried_edge;
      moment_ = moment_of_carried(come_ + (left > kMaxInATick ? left : room + 1));
    }
  }
}

/// Returns how many pulses the drive has sent by `at`, in its own coordinate.
std::int64_t AxisTick::due_at(const Instant& at) {
  PulseDrive& drive = axis_.drive;
  const std::int64_t max = drive.pulses_at(tick_);
  if (!is_before(at, until_)) return max;
  return std::clamp(drive.pulses_at_moment(at), drive.sent_pulses, std::max(max, drive.sent_pulses));
}

/// Returns how many carried pulses have arrived by `at`.
std::int64_t AxisTick::come_at(const Instant& at) const {
  const double part = is_before(at, until_) ? at.after_s * kTicksPerSecond : 1;
  return static_cast<std::int64_t>(part * static_cast<double>(std::abs(carried_)) + 1e-9);
}

AxisPlace AxisTick::place_at(const Instant& at) {
  const PulseDrive& drive = axis_.drive;
  AxisPlace place{.travel_pulses = axis_.travel_pulses, .backlash_sent = axis_.backlash_sent};
  if (is_over_) return place;
  if (drives()) {
    axis_.watch(here_);
    const std::int64_t travel = axis_.base_pulses + drive.direction * due_at(at);
    place.travel_pulses = std::clamp(travel, axis_.watch_low, axis_.watch_high);
  } else if (axis_.in_backlash && drive.elapsed_s(until_) >= 0) {
    place.backlash_sent += (due_at(at) - drive.sent_pulses) * drive.direction;
  } else if (come_ != std::abs(carried_) && axis_.task == carried_by_) {
    axis_.watch(here_);
    const std::int64_t room =
        carried_ > 0 ? axis_.watch_high - axis_.travel_pulses : axis_.travel_pulses - axis_.watch_low;
    const std::int64_t pulses = std::clamp<std::int64_t>(come_at(at) - come_, 0, room);
    place.travel_pulses += carried_ < 0 ? -pulses : pulses;
  }
  return place;
}

void AxisTick::go_to(Instant at) {
  PulseDrive& drive = axis_.drive;
  const AxisPlace place = place_at(at);
  const std::int64_t pulses = place.travel_pulses - axis_.travel_pulses;
  if (drives()) {
    const std::int64_t sent_before = drive.sent_pulses;
    axis_.travel_pulses = place.travel_pulses;
    drive.sent_pulses = (axis_.travel_pulses - axis_.base_pulses) * drive.direction;
    axis_.check_speed(sent_before, at_, at);
  } else if (axis_.in_backlash) {
    const std::int64_t come = place.backlash_sent - axis_.backlash_sent;
    drive.sent_pulses += come * drive.direction;
    axis_.backlash_sent += come;
    axis_.backlash_taken_pulses += come;
  } else if (come_ != std::abs(carried_) && axis_.task == carried_by_) {
    come_ += std::abs(pulses);
    axis_.travel_pulses = axis_.base_pulses = place.travel_pulses;
  }
  at_ = at;
  axis_.know_encoder(here_);
  forget_next();
}

void AxisTick::step_events() {
  next();
  const What what = next_;
  next_ = What::unknown;
  switch (what) {
    case What::unknown: break;
    case What::again: axis_.update_signals(here_, at_, 0); break;
    case What::edge: go_to_edge(); break;
    case What::backlash_ends: end_backlash(); break;
    case What::drive_ends: end_drive(); break;
    case What::carried_edge: {
      const std::int64_t left = std::abs(carried_) - come_;
      const std::int64_t room =
          carried_ > 0 ? axis_.watch_high - axis_.travel_pulses : axis_.travel_pulses - axis_.watch_low;
      const std::int64_t pulses = left > kMaxInATick ? left : room + 1;
      come_ += pulses;
      at_ = moment_;
      const int direction = carried_ < 0 ? -1 : +1;
      go_on_carried(pulses * direction, at_);
      if (axis_.task == carried_by_ && against(direction) == Cause::none) break;
      const bool is_ended = come_ != std::abs(carried_) && axis_.task == Task::coordinated;
      come_ = std::abs(carried_);
      if (is_ended) axis_.end(against(direction), at_);
      break;
    }
    case What::nothing:
      go_to(until_);
      next_ = What::nothing;
      is_over_ = true;
      break;
  }
}

/// Goes to the first pulse beyond the watch window, at the moment when it is sent.
void AxisTick::go_to_edge() {
  PulseDrive& drive = axis_.drive;
  const std::int64_t travel = axis_.base_pulses + drive.direction * drive.pulses_at(tick_);
  const bool too_fast = std::abs(travel - axis_.travel_pulses) > kMaxInATick;
  const std::int64_t edge = too_fast                    ? travel
                            : travel > axis_.watch_high ? axis_.watch_high + 1
                                                        : axis_.watch_low - 1;
  const std::int64_t sent_before = drive.sent_pulses;
  drive.sent_pulses = (edge - axis_.base_pulses) * drive.direction;
  axis_.travel_pulses = edge;
  axis_.check_speed(sent_before, at_, moment_);
  at_ = moment_;
  axis_.update_signals(here_, at_, static_cast<int>(drive.direction));
}

/// Sends the last pulse of the backlash, and begins the motion itself at that moment.
void AxisTick::end_backlash() {
  PulseDrive& drive = axis_.drive;
  const std::int64_t come = (drive.pulses_at(tick_) - drive.sent_pulses) * drive.direction;
  axis_.backlash_sent += come;
  axis_.backlash_taken_pulses += come;
  const Profile rest = axis_.planned(axis_.law);
  const int direction = static_cast<int>(drive.direction);
  axis_.in_backlash = false;
  at_ = moment_;
  drive.start(rest, direction, at_);
}

/// Sends the last pulses of a drive. Anything that follows without a command begins at the end of the tick.
void AxisTick::end_drive() {
  PulseDrive& drive = axis_.drive;
  const std::int64_t sent_before = drive.sent_pulses;
  drive.sent_pulses = drive.pulses_at(tick_);
  axis_.travel_pulses = axis_.base_pulses + drive.direction * drive.sent_pulses;
  axis_.check_speed(sent_before, at_, until_);
  at_ = moment_;
  axis_.know_encoder(here_);
  if (axis_.comes_back) {
    const std::int64_t back = axis_.base_pulses + drive.direction * axis_.target_pulses - axis_.travel_pulses;
    axis_.drop();
    if (back == 0) {
      axis_.end(Cause::arrived, until_);
    } else if (const Cause why = axis_.begin(Task::move, back < 0 ? -1 : +1, back, axis_.law, until_);
               why != Cause::none) {
      axis_.end(why, until_);
    }
  } else if (!axis_.slowing && axis_.settings.waits_for_in_position &&
             (axis_.signals & bit(Signal::in_position)) == 0) {
    drive.stop();
    axis_.base_pulses = axis_.travel_pulses;
    axis_.settling = true;
  } else {
    axis_.end(axis_.slowing ? axis_.cause : Cause::arrived, until_);
  }
  for (const Event event : {Event::ended, Event::homed}) {
    if ((axis_.events_between & bit(event)) != 0) axis_.event_at[static_cast<std::size_t>(event)] = at_;
  }
}

/// Returns why a carried axis may not continue in a direction.
Cause AxisTick::against(int direction) const {
  // One pulse beyond a soft limit is sent, as in the drive's own motions, because it triggers the limit.
  const auto& soft_limit = direction > 0 ? axis_.settings.soft_limit_plus : axis_.settings.soft_limit_minus;
  const Cause why = axis_.forbidden(direction);
  const bool soft = why == Cause::soft_limit_plus || why == Cause::soft_limit_minus;
  if (soft && axis_.soft_limit_place() == *soft_limit) return Cause::none;
  // The axis is already slowing down to a stop.
  return axis_.slowing && why != Cause::servo_off ? Cause::none : why;
}

/// Begins to move in `direction` by carried pulses. Backlash is sent immediately, because it has no duration.
bool AxisTick::sets_out(int direction, Instant at) {
  if (const Cause why = against(direction); why != Cause::none) {
    // At a limit, a wheel has no effect; a path cannot continue.
    if (axis_.task == Task::coordinated) axis_.end(why, at);
    return false;
  }
  axis_.drive.direction = direction;
  if (!axis_.settings.slips) {
    axis_.backlash_sent += axis_.backlash_before(direction) * direction;
    axis_.backlash_taken_pulses = direction > 0 ? axis_.settings.backlash_pulses : 0;
  }
  axis_.last_direction = static_cast<std::int8_t>(direction);
  return true;
}

void AxisTick::go_on_carried(std::int64_t pulses, Instant at) {
  axis_.travel_pulses += pulses;
  axis_.base_pulses = axis_.travel_pulses;
  axis_.update_signals(here_, at, pulses < 0 ? -1 : +1);
}

void AxisTick::go_by(std::int64_t pulses, Instant at) {
  at_ = at;
  const int direction = pulses < 0 ? -1 : +1;
  if (pulses != 0 && sets_out(direction, at)) {
    const bool too_fast = pulses * direction > kMaxInATick;
    while (pulses != 0 && axis_.task == Task::coordinated && against(direction) == Cause::none) {
      axis_.watch(here_);
      const std::int64_t room =
          direction > 0 ? axis_.watch_high - axis_.travel_pulses : axis_.travel_pulses - axis_.watch_low;
      if (pulses * direction <= room) {
        axis_.travel_pulses += pulses;
        axis_.base_pulses = axis_.travel_pulses;
        pulses = 0;
        break;
      }
      const std::int64_t now = too_fast ? pulses : (room + 1) * direction;
      pulses -= now;
      go_on_carried(now, at);
    }
    if (pulses != 0 && axis_.task == Task::coordinated) axis_.end(against(direction), at);
  }
  axis_.know_encoder(here_);
  forget_next();
}

Events AxisTick::take_events() {
  const Events fresh = axis_.events_between;
  axis_.events_between = 0;
  // Events that the axis's own reversal causes happen at the end of the tick.
  at_end_ = static_cast<Events>(at_end_ | (fresh & events_of(Moment::end)));
  const auto now = static_cast<Events>(fresh & ~events_of(Moment::end));
  taken_ = static_cast<Events>(taken_ | now);
  return now;
}

void AxisTick::leave_start_to_next_tick() {
  next_tick_ = static_cast<Events>(next_tick_ | (axis_.events_between & events_of(Moment::end)));
  axis_.events_between = static_cast<Events>(axis_.events_between & ~events_of(Moment::end));
}

std::int64_t AxisTick::finish() {
  take_events();
  axis_.watch(here_);
  // A path or a wheel may reverse towards the limit at which the axis is, or may not move at first.
  const bool may_turn = axis_.task == Task::coordinated || axis_.task == Task::following;
  const bool at_a_limit =
      may_turn && (axis_.forbidden(+1) != Cause::none || axis_.forbidden(-1) != Cause::none);
  const std::int64_t pulses = axis_.travel_pulses - travel_before_ + axis_.backlash_sent - backlash_before_;
  if (pulses != 0) axis_.raise(Event::pulse, until_);
  axis_.must_recheck = axis_.must_recheck || axis_.in_backlash || at_a_limit ||
                       (axis_.settings.raises & bit(Event::pulse)) != 0 || axis_.waits_for_constant_speed();
  if (axis_.task == Task::following)
    axis_.drive.next_check = 0;  // the drive has no plan, so each of its ticks is handled here
  axis_.events = static_cast<Events>(taken_ | at_end_ | axis_.events_between);
  axis_.events_between = next_tick_;
  return axis_.inverted ? -pulses : pulses;
}

}  // namespace understudy::motion
