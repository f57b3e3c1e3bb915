#include "motion/environment.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "motion/bad_motion.h"

namespace understudy::motion {

namespace {

/// Returns 0 .. index_period - 1. Both remainders lie between -period and period, so their difference is
/// corrected without a third division.
std::int64_t index_phase(const Environment& environment, std::int64_t travel) {
  const std::int64_t period = environment.index_period;
  const std::int64_t phase = travel % period - environment.index_at % period;
  if (phase < 0) return phase < -period ? phase + period + period : phase + period;
  return phase < period ? phase : phase - period;
}

/// Returns a - b, limited to 64 bits, because a zone may end at INT64_MAX.
std::int64_t bounded_difference(std::int64_t a, std::int64_t b) {
  std::int64_t difference = 0;
  if (!__builtin_sub_overflow(a, b, &difference)) return difference;
  return a < b ? INT64_MIN : INT64_MAX;
}

}  // namespace

void Environment::add(Signal signal, std::int64_t from, std::int64_t to, std::int64_t slack) {
  if (zone_count == kMaxZones) throw BadMotion(Refusal::no_room, "environment", "at most 12 zones per axis");
  zones[zone_count++] = {.signal = signal, .from = from, .to = to, .slack = slack};
  ++version;
}

void Environment::add_outside(Signal signal, std::int64_t from, std::int64_t to, std::int64_t slack) {
  const std::int64_t below = bounded_difference(from, slack);
  const std::int64_t above = bounded_difference(to, -slack);
  if (below > INT64_MIN) add(signal, INT64_MIN, below - 1, slack);
  if (above < INT64_MAX) add(signal, above + 1, INT64_MAX, slack);
}

void Environment::set_steady(Signal signal, bool on) {
  steady = static_cast<Signals>(on ? steady | bit(signal) : steady & ~bit(signal));
  ++version;
}

Signals Environment::at(std::int64_t travel, Signals before) const {
  Signals on = steady;
  for (std::size_t i = 0; i < zone_count; ++i) {
    const Zone& zone = zones[i];
    bool is_inside = travel >= zone.from && travel <= zone.to;
    if (!is_inside && zone.slack != 0 && zone.from <= zone.to && (before & bit(zone.signal)) != 0) {
      is_inside = travel >= bounded_difference(zone.from, zone.slack) &&
                  travel <= bounded_difference(zone.to, -zone.slack);
    }
    if (is_inside) on |= bit(zone.signal);
  }
  if (index_period > 0) {
    const std::int64_t seen_at = std::clamp(travel, index_from, index_to);
    if (index_phase(*this, seen_at) < index_width) on |= bit(Signal::index);
  }
  return on;
}

std::optional<std::int64_t> Environment::steps_until_change(std::int64_t travel, int direction) const {
  std::optional<std::int64_t> nearest;
  const auto consider = [&](std::int64_t steps) {
    if (steps > 0 && steps < INT64_MAX) nearest = nearest ? std::min(*nearest, steps) : steps;
  };
  const auto consider_beyond = [&](std::int64_t last_steps) {
    if (last_steps >= 0 && last_steps < INT64_MAX) consider(last_steps + 1);
  };
  // Consider the first pulse inside the zone and the first one beyond it, from either side.
  const auto consider_ends = [&](std::int64_t from, std::int64_t to) {
    if (direction > 0) {
      consider(bounded_difference(from, travel));
      consider_beyond(bounded_difference(to, travel));
    } else {
      consider(bounded_difference(travel, to));
      consider_beyond(bounded_difference(travel, from));
    }
  };
  for (std::size_t i = 0; i < zone_count; ++i) {
    const Zone& zone = zones[i];
    if (zone.to < zone.from) continue;
    consider_ends(zone.from, zone.to);
    if (zone.slack == 0) continue;
    consider_ends(bounded_difference(zone.from, zone.slack), bounded_difference(zone.to, -zone.slack));
  }
  if (index_period > 0 && index_width > 0 && index_width < index_period) {
    // Nothing changes until the index begins to depend on the position, and nothing changes beyond the other
    // end.
    const std::int64_t begin = std::clamp(travel, index_from, index_to);
    const std::int64_t phase = index_phase(*this, begin);
    const bool is_on = phase < index_width;
    const std::int64_t steps = direction > 0 ? (is_on ? index_width : index_period) - phase
                                             : (is_on ? phase + 1 : phase - (index_width - 1));
    const std::int64_t on_the_way =
        direction > 0 ? bounded_difference(begin, travel) : bounded_difference(travel, begin);
    const std::int64_t to_its_end =
        direction > 0 ? bounded_difference(index_to, begin) : bounded_difference(begin, index_from);
    if (on_the_way >= 0 && steps <= to_its_end) consider(bounded_difference(steps, -on_the_way));
  }
  return nearest;
}

}  // namespace understudy::motion
