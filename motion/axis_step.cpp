#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "motion/axis.h"
#include "motion/axis_tick.h"
#include "motion/environment.h"
#include "motion/pulse_drive.h"
#include "motion/tick.h"

// The tick of an axis during which something may happen.
namespace understudy::motion {

namespace {

/// The watch window never extends beyond this distance, where it is computed again.
constexpr std::int64_t kNoEdge = std::int64_t{1} << 56;

}  // namespace

std::int64_t Axis::step_slow_path(Tick tick, const Environment& environment,
                                  std::optional<std::int64_t> pulses) {
  AxisTick part(*this, environment, tick, pulses);
  while (!part.is_over()) part.step_events();
  return part.finish();
}

/// Steps the follower, and moves the axis if no event lies in between.
bool Axis::follow_quietly(const Environment& environment, QuietTick& quiet) {
  if (!is_undisturbed(environment)) return false;
  const std::int64_t pulses = follower.step();
  quiet.followed = pulses;
  const std::int64_t travel = travel_pulses + pulses;
  if (travel < watch_low || travel > watch_high) return false;
  quiet.pulses = carry_across(pulses);
  return true;
}

/// Handles everything that depends on the position that the axis has reached.
void Axis::update_signals(const Environment& environment, Instant at, int direction) {
  know_encoder(environment);
  compare(Count::command, travel_pulses, at, direction);
  follow_encoder_count(at);
  see(environment.at(travel_pulses, signals), at);
  if (settings.soft_limit_plus && soft_limit_place() > *settings.soft_limit_plus && drive.direction > 0) {
    react(settings.at_soft_limit, Cause::soft_limit_plus, at);
  }
  if (settings.soft_limit_minus && soft_limit_place() < *settings.soft_limit_minus && drive.direction < 0) {
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
  const bool obeys_limits = !settling || !settings.waits_beside_limits;
  if (is_on(Signal::emergency)) react(settings.at_emergency, Cause::emergency, at);
  if (is_on(Signal::alarm)) react(settings.at_alarm, Cause::alarm, at);
  if (drive.direction > 0 && obeys_limits && is_on(Signal::limit_plus))
    react(settings.at_limit_plus, Cause::limit_plus, at);
  if (drive.direction < 0 && obeys_limits && is_on(Signal::limit_minus))
    react(settings.at_limit_minus, Cause::limit_minus, at);
  // A wait whose input is switched off meanwhile is over, too.
  const bool is_in_position = (now_on & bit(Signal::in_position)) != 0 || !settings.waits_for_in_position;
  if (settling && is_in_position) end(Cause::arrived, at);
}

/// Calculates how far the axis can move before update_signals() has anything to do.
void Axis::watch(const Environment& environment) {
  std::int64_t up = kNoEdge;
  std::int64_t down = kNoEdge;
  const auto consider = [](std::int64_t& nearest, std::optional<std::int64_t> steps) {
    if (steps) nearest = std::min(nearest, *steps);
  };
  if (environment.depends_on_place()) {
    consider(up, environment.steps_until_change(travel_pulses, +1));
    consider(down, environment.steps_until_change(travel_pulses, -1));
  }
  // Converts steps of the encoder's count to steps of travel.
  const auto consider_by = [&](Count count, std::int64_t& nearest, int direction,
                               std::optional<std::int64_t> steps) {
    const bool by_encoder = count == Count::encoder;
    if (steps && by_encoder) steps = environment.encoder.steps_until(travel_pulses, direction, *steps);
    consider(nearest, steps);
  };
  const int encoder_direction = environment.encoder.sense();
  for (const Comparator& mine : comparators) {
    const bool by_encoder = mine.count == Count::encoder;
    if (mine.relation == Comparator::Relation::off || (by_encoder && !encoder_is_known)) continue;
    const std::int64_t count = by_encoder ? encoder_pulses : travel_pulses;
    const int rising = by_encoder ? encoder_direction : +1;
    consider_by(mine.count, up, +1, mine.steps_until_change(count, rising));
    consider_by(mine.count, down, -1, mine.steps_until_change(count, -rising));
  }
  if (const auto place = homing_place(); place && *place != travel_pulses) {
    consider(*place > travel_pulses ? up : down, std::abs(*place - travel_pulses));
  }
  // Soft limits may be extremely far away. If the encoder counts backwards, the axis moves away from its
  // limits.
  const auto& max = settings.soft_limit_plus;
  const auto& min = settings.soft_limit_minus;
  const Count of = settings.soft_limits_of;
  const bool goes_its_way = of == Count::command || (encoder_is_known && encoder_direction > 0);
  const std::int64_t place = soft_limit_place();
  if (max && goes_its_way && place <= *max && *max < place + kNoEdge) {
    consider_by(of, up, +1, *max + 1 - place);
  }
  if (min && goes_its_way && place >= *min && *min > place - kNoEdge) {
    consider_by(of, down, -1, place + 1 - *min);
  }
  watch_high = travel_pulses + (up - 1);
  watch_low = travel_pulses - (down - 1);
}

}  // namespace understudy::motion
