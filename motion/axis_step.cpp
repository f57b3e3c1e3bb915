#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <utility>

#include "motion/axis.h"
#include "motion/pulse_drive.h"
#include "motion/surroundings.h"
#include "motion/tick.h"

// The tick of an axis, where something can happen in it.
namespace understudy::motion {

namespace {

/// Nothing is watched for farther off than this: it is looked for again there.
constexpr std::int64_t kNoEdge = std::int64_t{1} << 56;

/// No drive is that fast; a state from outside may say so, and must not keep its tick for ever.
constexpr std::int64_t kMostInATick = 1'000'000;

}  // namespace

std::int64_t Axis::step_with_care(Tick tick, const Surroundings& here) {
  std::int64_t followed = 0;
  const bool only_follows = task == Task::following && is_undisturbed(here);
  if (only_follows) {
    followed = follower.step();
    const std::int64_t travel = travel_pulses + followed;
    if (travel >= watch_low && travel <= watch_high) return carry_across(followed);
  }
  const std::int64_t travel_before = travel_pulses;
  const std::int64_t backlash_before = backlash_sent;
  Instant at{.tick = tick - 1};
  seen_version = here.version;
  attentive = false;
  meet(here, at, 0);
  follow_encoder_count(at);

  if (task == Task::following) {
    go_by(only_follows ? followed : follower.step(), {.tick = tick}, here);
  } else if (task == Task::coordinated) {
    go_by(carried_pulses, {.tick = tick}, here);
    carried_pulses = 0;
  } else if (task != Task::hanging) {
    bool turned = false;  // within the tick, for homing: the backlash begins in it, too
    do {
      if (in_backlash) at = take_up_backlash(tick);
      turned = !in_backlash && drive.moving();
      if (turned) run_until(tick, at, here);
      turned = turned && in_backlash;
    } while (turned);
  }
  watch(here);
  // A path or a wheel may turn towards the limit that the axis stands on, or stands still at first.
  const bool may_turn = task == Task::coordinated || task == Task::following;
  const bool at_a_limit = may_turn && (forbidden(+1) != Cause::none || forbidden(-1) != Cause::none);
  const std::int64_t pulses = travel_pulses - travel_before + backlash_sent - backlash_before;
  if (pulses != 0) raise(Event::pulse, {.tick = tick});
  attentive = attentive || in_backlash || at_a_limit || (settings.raises & bit(Event::pulse)) != 0 ||
              waits_for_constant_speed();
  if (task == Task::following) drive.next_look = 0;  // it has no plan: each of its ticks comes here
  events = events_between;
  events_between = 0;
  Instant& ended_at = event_at[static_cast<std::size_t>(Event::constant_ended)];
  const bool was_between = (events & bit(Event::constant_ended)) != 0 && ended_at.tick < tick - 1;
  if (was_between) ended_at = {.tick = tick - 1};
  return inverted ? -pulses : pulses;
}

/// Sends the part of the backlash that is due, and begins the motion itself when that is over. Returns that
/// moment.
Instant Axis::take_up_backlash(Tick tick) {
  const std::int64_t sent = drive.pulses_at(tick);
  backlash_sent += (sent - drive.sent_pulses) * drive.direction;
  play_pulses += (sent - drive.sent_pulses) * drive.direction;
  drive.sent_pulses = sent;
  const Instant until{.tick = tick};
  if (!drive.over_at(tick)) return until;
  // The motion begins at the very moment, and so has run for a part of this tick.
  const double over_s = std::max(0.0, drive.elapsed_s(until) - drive.profile.duration_s);
  Instant at{.tick = tick - 1, .after_s = 1 / kTicksPerSecond - over_s};
  if (over_s <= 0) at = until;
  const Profile rest = planned(law);
  const int way = drive.direction;
  in_backlash = false;
  drive.start(rest, way, at);
  return at;
}

void Axis::run_until(Tick tick, Instant at, const Surroundings& here) {
  const Instant until{.tick = tick};
  while (drive.moving() && !in_backlash) {
    watch(here);
    const std::int64_t travel = base_pulses + drive.direction * drive.pulses_at(tick);
    const std::int64_t sent_before = drive.sent_pulses;
    if (travel >= watch_low && travel <= watch_high) {
      drive.sent_pulses = drive.pulses_at(tick);
      travel_pulses = travel;
      look_at_speed(sent_before, at, until);
      break;
    }
    // On to the first pulse beyond what was watched, at the moment it is sent.
    const bool too_fast = std::abs(travel - travel_pulses) > kMostInATick;
    const std::int64_t edge = too_fast ? travel : travel > watch_high ? watch_high + 1 : watch_low - 1;
    const std::int64_t pulse = (edge - base_pulses) * drive.direction;
    const Instant from = std::exchange(at, drive.time_of_pulse(pulse, at, until));
    drive.sent_pulses = pulse;
    travel_pulses = edge;
    look_at_speed(sent_before, from, at);
    meet(here, at, drive.direction);
  }
  if (drive.moving() && !in_backlash && drive.over_at(tick)) {
    if (comes_back) {
      const std::int64_t back = base_pulses + drive.direction * target_pulses - travel_pulses;
      drop();
      if (back == 0) {
        end(Cause::arrived, until);
      } else if (const Cause why = begin(Task::move, back < 0 ? -1 : +1, back, law, until);
                 why != Cause::none) {
        end(why, until);
      }
    } else if (!slowing && settings.waits_for_in_position && (signals & bit(Signal::in_position)) == 0) {
      drive.stop();
      base_pulses = travel_pulses;
      settling = true;
    } else {
      end(slowing ? cause : Cause::arrived, until);
    }
  }
}

/// Goes by pulses that come from elsewhere. Backlash comes out at once: there is no time of its own for it.
void Axis::go_by(std::int64_t wanted, Instant at, const Surroundings& here) {
  const Task carried_by = task;
  if (wanted == 0) return;
  const int way = wanted < 0 ? -1 : +1;
  const auto against = [&] {
    // The one pulse beyond a soft limit is sent, as by the drive's motions: it is what triggers.
    const auto& soft_limit = way > 0 ? settings.soft_limit_plus : settings.soft_limit_minus;
    const Cause why = forbidden(way);
    const bool soft = why == Cause::soft_limit_plus || why == Cause::soft_limit_minus;
    if (soft && travel_pulses == *soft_limit) return Cause::none;
    // On its way to a standstill by then.
    return slowing && why != Cause::servo_off ? Cause::none : why;
  };
  if (against() != Cause::none) {
    // Against a limit a wheel turns in vain; a path cannot go on.
    if (task == Task::coordinated) end(against(), at);
    return;
  }
  drive.direction = way;
  if (!settings.slips) {
    backlash_sent += play_before(way) * way;
    play_pulses = way > 0 ? settings.backlash_pulses : 0;
  }
  last_direction = static_cast<std::int8_t>(way);
  const bool too_fast = wanted * way > kMostInATick;
  while (wanted != 0 && task == carried_by && against() == Cause::none) {
    watch(here);
    const std::int64_t room = way > 0 ? watch_high - travel_pulses : travel_pulses - watch_low;
    const std::int64_t now = too_fast ? wanted * way : std::min(wanted * way, room + 1);
    travel_pulses += now * way;
    base_pulses = travel_pulses;
    wanted -= now * way;
    meet(here, at, way);
  }
  if (wanted != 0 && task == Task::coordinated) end(against(), at);
}

/// Everything that depends on the place, at the place the axis has come to.
void Axis::meet(const Surroundings& here, Instant at, int way) {
  compare(Count::command, travel_pulses, at, way);
  see(here.at(travel_pulses, signals), at);
  if (settings.soft_limit_plus && travel_pulses > *settings.soft_limit_plus && drive.direction > 0) {
    react(settings.at_soft_limit, Cause::soft_limit_plus, at);
  }
  if (settings.soft_limit_minus && travel_pulses < *settings.soft_limit_minus && drive.direction < 0) {
    react(settings.at_soft_limit_of_minus(), Cause::soft_limit_minus, at);
  }
  if (homing.active()) homing_comes_to_its_place(at);
}

void Axis::see(Signals now_on, Instant at) {
  const auto changed = static_cast<Signals>(signals ^ now_on);
  signals = now_on;
  if ((changed & bit(Signal::mark)) != 0) {
    const Event edge = (now_on & bit(Signal::mark)) != 0 ? Event::mark_on : Event::mark_off;
    events_between |= bit(edge);
    event_at[static_cast<std::size_t>(edge)] = at;
    const bool is_on = edge == Event::mark_on;
    react(is_on ? settings.at_mark_on : settings.at_mark_off, Cause::stopped, at);
  }
  if (homing.active() && changed != 0) homing_sees(changed, at);
  const auto is_on = [&](Signal signal) { return (now_on & bit(signal)) != 0 && !homing_takes(signal); };
  const bool heeds_limits = !settling || !settings.waits_beside_limits;
  if (is_on(Signal::emergency)) react(settings.at_emergency, Cause::emergency, at);
  if (is_on(Signal::alarm)) react(settings.at_alarm, Cause::alarm, at);
  if (drive.direction > 0 && heeds_limits && is_on(Signal::limit_plus))
    react(settings.at_limit_plus, Cause::limit_plus, at);
  if (drive.direction < 0 && heeds_limits && is_on(Signal::limit_minus))
    react(settings.at_limit_minus, Cause::limit_minus, at);
  if (settling && (now_on & bit(Signal::in_position)) != 0) end(Cause::arrived, at);
}

/// How far the axis may go before meet() has anything to do.
void Axis::watch(const Surroundings& here) {
  std::int64_t up = kNoEdge;
  std::int64_t down = kNoEdge;
  const auto consider = [](std::int64_t& nearest, std::optional<std::int64_t> steps) {
    if (steps) nearest = std::min(nearest, *steps);
  };
  if (here.depends_on_place()) {
    consider(up, here.steps_until_change(travel_pulses, +1));
    consider(down, here.steps_until_change(travel_pulses, -1));
  }
  for (const Comparator& mine : comparators) {
    if (mine.relation == Comparator::Relation::off || mine.count != Count::command) continue;
    consider(up, mine.steps_until_change(travel_pulses, +1));
    consider(down, mine.steps_until_change(travel_pulses, -1));
  }
  if (const auto place = homing_place(); place && *place != travel_pulses) {
    consider(*place > travel_pulses ? up : down, std::abs(*place - travel_pulses));
  }
  // Soft limits may be far out of reach, up to the last number there is.
  const auto& most = settings.soft_limit_plus;
  const auto& least = settings.soft_limit_minus;
  if (most && travel_pulses <= *most && *most < travel_pulses + kNoEdge) {
    consider(up, *most + 1 - travel_pulses);
  }
  if (least && travel_pulses >= *least && *least > travel_pulses - kNoEdge) {
    consider(down, travel_pulses + 1 - *least);
  }
  watch_high = travel_pulses + (up - 1);
  watch_low = travel_pulses - (down - 1);
}

}  // namespace understudy::motion
