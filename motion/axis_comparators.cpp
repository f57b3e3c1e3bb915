#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/pulse_drive.h"

// Position comparison: an axis's counts pass the values of its comparators.
namespace understudy::motion {

namespace {

Event comparator_event(std::size_t number) {
  return static_cast<Event>(static_cast<unsigned>(Event::comparator_0) + number);
}

}  // namespace

bool Comparator::holds(std::int64_t travel) const {
  const std::int64_t at = counter.at(travel);
  switch (relation) {
    case Relation::off: break;
    case Relation::at_least: return at >= value;
    case Relation::below: return at < value;
    case Relation::equal:
    case Relation::equal_upwards:
    case Relation::equal_downwards: return at == value;
  }
  return false;
}

std::optional<std::int64_t> Comparator::steps_until_change(std::int64_t travel, int direction) const {
  if (relation == Relation::off) return std::nullopt;
  // Outside the range of the count, or if the range has only one value, the relation never changes: a ring
  // with only one value would have an edge at each pulse.
  const auto min = counter.min();
  const auto max = counter.max();
  if (min && (value > *max || *min == *max || (!asks_for_one_place() && value <= *min))) {
    return std::nullopt;
  }
  if (min && asks_for_one_place() && value < *min) return std::nullopt;
  std::optional<std::int64_t> nearest;
  const auto consider = [&](std::optional<std::int64_t> steps) {
    if (steps) nearest = nearest ? std::min(*nearest, *steps) : steps;
  };
  // The relation changes where the count arrives at or leaves `value`, and where the count wraps.
  consider(counter.steps_until(value, travel, direction));
  if (direction > 0 && value < INT64_MAX) consider(counter.steps_until(value + 1, travel, direction));
  if (direction < 0 && value > INT64_MIN) consider(counter.steps_until(value - 1, travel, direction));
  if (const auto turning = direction > 0 ? counter.min() : counter.max()) {
    consider(counter.steps_until(*turning, travel, direction));
  }
  return nearest;
}

void Axis::set_comparator(std::size_t number, const Comparator& comparator) {
  if (number >= comparators.size()) {
    throw BadMotion(Refusal::out_of_range, "comparator", "number must be 0 to 3");
  }
  Comparator& mine = comparators[number];
  const bool same_question = mine.relation == comparator.relation && mine.count == comparator.count;
  const bool was_true = mine.was_true;
  mine = comparator;
  // A written number can make the relation true, which is an event. If the relation is already true when the
  // comparator is set, the event comes the next time that it becomes true.
  mine.was_true =
      same_question ? was_true : mine.holds(mine.count == Count::command ? travel_pulses : encoder_pulses);
  must_recheck = true;
}

bool Axis::counts_by_encoder() const {
  const bool has_limit = settings.soft_limit_plus || settings.soft_limit_minus;
  if (settings.soft_limits_of == Count::encoder && has_limit) return true;
  return std::any_of(comparators.begin(), comparators.end(),
                     [](const Comparator& mine) { return mine.count == Count::encoder; });
}

void Axis::set_encoder(std::int64_t pulses) {
  if (pulses == encoder_pulses) return;
  encoder_pulses = pulses;
  if (encoder_is_known) return;  // the encoder was already followed within the tick
  if (counts_by_encoder()) {
    must_recheck = true;
  } else {
    encoder_seen = pulses;  // the values in between are not compared
  }
}

/// Computes the encoder count at this pulse, if the machine follows the axis.
void Axis::know_encoder(const Environment& environment) {
  if (encoder_is_known) encoder_pulses = environment.encoder.at(travel_pulses);
}

/// Moves the encoder count from its old value to the new one. The comparators check all values in between.
void Axis::follow_encoder_count(Instant at) {
  const int direction = encoder_pulses == encoder_seen ? 0 : encoder_pulses < encoder_seen ? -1 : +1;
  // A longer jump is not a motion: only its end counts.
  constexpr std::int64_t kFarthestWalk = 100'000;
  while (encoder_seen != encoder_pulses && encoder_pulses - kFarthestWalk <= encoder_seen &&
         encoder_seen <= encoder_pulses + kFarthestWalk) {
    std::int64_t steps = std::abs(encoder_pulses - encoder_seen);
    for (const Comparator& mine : comparators) {
      if (mine.count != Count::encoder) continue;
      if (const auto change = mine.steps_until_change(encoder_seen, direction))
        steps = std::min(steps, *change);
    }
    encoder_seen += steps * direction;
    compare(Count::encoder, encoder_seen, at, direction);
  }
  encoder_seen = encoder_pulses;
  compare(Count::encoder, encoder_pulses, at, direction);
}

void Axis::compare(Count count, std::int64_t value, Instant at, int direction) {
  for (std::size_t i = 0; i < comparators.size(); ++i) {
    Comparator& mine = comparators[i];
    if (mine.relation == Comparator::Relation::off || mine.count != count) continue;
    const bool holds = mine.holds(value);
    if (holds && !mine.was_true && (mine.sense() == 0 || mine.sense() == direction)) {
      events_between |= bit(comparator_event(i));
      event_at[i] = at;
      mine.was_true = true;
      react(mine.reaction, Cause::comparator, at);
    }
    mine.was_true = holds;
  }
}

}  // namespace understudy::motion
