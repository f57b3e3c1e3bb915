#include "emulator/models/super_40nc/axis/tick_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/comparator_rows.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "emulator/models/super_40nc/rows/terminals.h"
#include "motion/axis.h"
#include "motion/axis_tick.h"
#include "motion/bisection.h"
#include "motion/profile.h"
#include "motion/pulse_drive.h"
#include "motion/shared_tick.h"
#include "motion/tick.h"

namespace understudy::emulator::models::super_40nc {

namespace {

constexpr double kTick_s = 1 / motion::kTicksPerSecond;

}  // namespace

void TickEdges::begin_tick(Tick tick, bool wheel_turns) {
  tick_ = tick;
  watched_ = 0;
  for (int number = 0; number < kAxisCount; ++number) {
    const bool moves = chip(number).moving();
    const bool changes = moves || wheel_turns || counters_.counts_a_clock(number);
    const bool is_compared = axis(number).compares_by_tick != 0 && changes;
    const bool has_pin = has_chip_pins() && moves &&
                         (inputs_.span_of(number, chip_pin_of(number, kClearPin)).has_value() ||
                          inputs_.span_of(number, chip_pin_of(number, kLatchPin)).has_value());
    if (is_compared || has_pin) watched_ |= 1U << number;
  }
}

motion::Instant TickEdges::instant(double at_s) const {
  if (at_s >= kTick_s) return {.tick = tick_};
  return {.tick = tick_ - 1, .after_s = at_s};
}

double TickEdges::seconds(const motion::Instant& at) const { return at.tick >= tick_ ? kTick_s : at.after_s; }

void TickEdges::latch(const motion::SharedTick& tick, int axis_number) {
  AxisState& state = axis(axis_number);
  const auto compared = state.compared;
  counters_.take_latch(axis_number, chip(axis_number).travel_pulses, speed(axis_number, seconds(tick.now())));
  // A latch may clear counters, but not the remaining distance or the speed.
  for (std::size_t which = 0; which < kComparators; ++which) {
    if (question(axis_number, which).source >= kRemaining) state.compared[which] = compared[which];
  }
}

/// Latches according to D9x50: at the DOG's edge, or at comparators 4 and 5 if the axis itself evaluates
/// them.
void TickEdges::at_edge(motion::SharedTick& tick, std::size_t number, motion::Events events) {
  const int axis_number = static_cast<int>(number);
  constexpr Value kDog = 1;
  const motion::Events latches = registers().of(stored_x(d9x::kLatchOfCounters), axis_number) == kDog
                                     ? motion::bit(motion::Event::mark_on)
                                     : axis(axis_number).latching;
  if ((events & latches) == 0) return;
  counters_.count_until(axis_number, seconds(tick.now()));
  latch(tick, axis_number);
}

// ---- numbers between edges

TickEdges::Question TickEdges::question(int axis, std::size_t which) const {
  const Settings settings = registers();
  const ComparatorRow& row = kComparatorRows[which];
  return {.axis = axis,
          .which = which,
          .source = settings.of(row.source, axis),
          .method = settings.of(row.method, axis),
          .set = settings.raw(row.value, axis)};
}

bool TickEdges::is_answered(const Question& of, std::int64_t before, std::int64_t present) const {
  if (of.method != kSoftLimit) return is_met(of.source, of.method, before, present, of.set);
  const motion::Axis& motor = chip(of.axis);
  const bool reacts = !motor.moving() || motor.slowing || axes_.path.slowing_for != motion::Cause::none;
  if (reacts) return false;  // the comparator was already reported
  const int direction = motor.last_direction;
  return of.which == 0 ? direction > 0 && present > of.set
                       : of.which == 1 && direction < 0 && present < of.set;
}

/// Returns false if no comparator can trigger between two moments. Until the next edge, each counter keeps
/// its direction, so no number changes by more than the sum of all of them.
bool TickEdges::may_be_answered(const Question& of, const Sample& from, const Sample& to) const {
  const std::int64_t max =
      std::abs(to.place.travel_pulses - from.place.travel_pulses) +
      std::abs(to.since.backlash - from.since.backlash) + std::abs(to.since.encoder - from.since.encoder) +
      std::abs(to.since.wheel - from.since.wheel) + std::abs(to.since.clock - from.since.clock);
  constexpr std::int64_t kWraps = 1 << 15;  // COUNTER3 has 16 bits
  if (of.source == kCounter3 && from.number + max >= kWraps) return true;
  switch (of.method) {
    case kSetAbove: return from.number - max < of.set;
    case kSetBelow: return from.number + max > of.set;
    case kSoftLimit: return of.which == 0 ? from.number + max > of.set : from.number - max < of.set;
    default: return from.number - max <= of.set && of.set <= from.number + max;
  }
}

std::int64_t TickEdges::speed(int axis_number, double at_s) const {
  const motion::Axis& motor = chip(axis_number);
  const bool has_profile = motor.drive.drive == motion::Drive::running && !is_on_path(axis_number);
  if (!has_profile) return chip_speed(axis_number);  // the speed in the whole tick
  const double speed_pps = std::abs(motor.drive.sample(instant(at_s)).speed_u_s);
  return std::llround(speed_pps / axis(axis_number).step_pps);
}

std::int64_t TickEdges::number(const Question& of, const Sample& sample) const {
  const AxisState& state = axis(of.axis);
  const Settings settings = registers();
  const motion::Axis& motor = chip(of.axis);
  switch (of.source) {
    case kCounter1: {
      const bool with_backlash = is_bit(settings.raw(stored_x(d9x::kCountCorrect), of.axis), 0);
      return state.command.at(sample.place.travel_pulses) + (with_backlash ? sample.since.backlash : 0);
    }
    case kRemaining: {
      const bool has_target = state.rest.kind == RestKind::path || state.holder == Activity::rest;
      if (has_target) return std::abs(state.rest.travel - sample.place.travel_pulses);
      return motor.remaining_pulses() - std::abs(sample.place.travel_pulses - motor.travel_pulses);
    }
    case kSpeed: return speed(of.axis, sample.at_s);
    default: break;
  }
  const auto which = static_cast<int>(of.source);
  const std::int64_t present = counter(of.axis, which);
  const std::int64_t counts =
      counters_.counts_now(of.axis, which) ? counts_of(settings, of.axis, which, sample.since) : 0;
  if (of.source == kCounter3) return std::abs(std::int64_t{static_cast<std::int16_t>(present + counts)});
  return wrapped(present + counts);
}

TickEdges::Sample TickEdges::sample(motion::SharedTick& tick, const Question& of, double at_s) const {
  Sample sample{.at_s = at_s, .place = tick.place_ahead(static_cast<std::size_t>(of.axis), instant(at_s))};
  sample.since = counters_.counted_until(of.axis, at_s, sample.place);
  sample.number = number(of, sample);
  return sample;
}

/// Bisects the time between two moments to find the first change that triggers the comparator.
std::optional<double> TickEdges::first_answer(motion::SharedTick& tick, const Question& of,
                                              const Sample& from, const Sample& to) const {
  if (!may_be_answered(of, from, to)) return std::nullopt;
  const std::int64_t changes = std::abs(to.place.travel_pulses - from.place.travel_pulses) +
                               std::abs(to.since.backlash - from.since.backlash) +
                               std::abs(to.since.wheel - from.since.wheel) +
                               std::abs(to.since.clock - from.since.clock);
  constexpr double kAtOnce_s = 1e-13;
  if (changes <= 1 || to.at_s - from.at_s < kAtOnce_s) {
    if (!is_answered(of, from.number, to.number)) return std::nullopt;
    if (changes > 1) return to.at_s;
    const auto has_changed = [&](double at_s) { return sample(tick, of, at_s).number != from.number; };
    return motion::turnover(from.at_s, to.at_s, has_changed).after;
  }
  const Sample middle = sample(tick, of, from.at_s + (to.at_s - from.at_s) / 2);
  if (const auto found = first_answer(tick, of, from, middle)) return found;
  return first_answer(tick, of, middle, to);
}

/// Within a segment of its profile, a speed either only rises or only falls.
std::optional<double> TickEdges::first_speed(motion::SharedTick& tick, const Question& of, const Sample& from,
                                             const Sample& to) const {
  const motion::PulseDrive& drive = chip(of.axis).drive;
  Sample begin = from;
  for (std::int32_t part = 0; part <= drive.profile.segment_count; ++part) {
    const bool is_last = part == drive.profile.segment_count;
    const double at_s = is_last ? to.at_s
                                : kTick_s - (drive.elapsed_s(tick_) -
                                             drive.profile.segments[static_cast<std::size_t>(part)].begin_s);
    if (at_s <= begin.at_s || at_s > to.at_s) continue;
    const Sample end = is_last ? to : sample(tick, of, at_s);
    if (is_answered(of, begin.number, end.number)) {
      const auto is_present = [&](double between_s) {
        return is_answered(of, begin.number, sample(tick, of, between_s).number);
      };
      return motion::turnover(begin.at_s, end.at_s, is_present).after;
    }
    begin = end;
  }
  return std::nullopt;
}

std::optional<double> TickEdges::next_comparison(motion::SharedTick& tick, const Question& of, double from_s,
                                                 double to_s) const {
  const Sample from = sample(tick, of, from_s);
  if (is_answered(of, axis(of.axis).compared[of.which], from.number)) return from_s;
  const Sample to = sample(tick, of, to_s);
  return of.source == kSpeed ? first_speed(tick, of, from, to) : first_answer(tick, of, from, to);
}

/// If a switch of the machine is connected to a pin, returns when its level changes next.
std::optional<double> TickEdges::next_flip(motion::SharedTick& tick, int axis, ChipPin pin, double from_s,
                                           double to_s) const {
  const auto span = inputs_.span_of(axis, chip_pin_of(axis, pin));
  if (!span) return std::nullopt;
  const auto n = static_cast<std::size_t>(axis);
  const auto travel_at = [&](double at_s) { return tick.place_ahead(n, instant(at_s)).travel_pulses; };
  const std::int64_t begin = travel_at(from_s);
  const std::int64_t end = travel_at(to_s);
  const bool is_inside = pin_seen(axis, pin) == span->level_inside;
  // The first place in this direction that has the other level.
  std::int64_t place = 0;
  if (is_inside) {
    const bool has_left = begin > span->last + span->slack || begin < span->first - span->slack;
    place = has_left ? begin : end >= begin ? span->last + span->slack + 1 : span->first - span->slack - 1;
  } else {
    const bool has_come = begin >= span->first && begin <= span->last;
    place = has_come ? begin : end >= begin ? span->first : span->last;
    if (end >= begin ? begin > span->last : begin < span->first) return std::nullopt;  // passed
  }
  if (place == begin) return from_s;
  if (end >= begin ? end < place : end > place) return std::nullopt;
  const auto is_present = [&](double at_s) {
    return end >= begin ? travel_at(at_s) >= place : travel_at(at_s) <= place;
  };
  return motion::turnover(from_s, to_s, is_present).after;
}

std::optional<motion::Instant> TickEdges::next_moment(motion::SharedTick& tick,
                                                      const motion::Instant& until) {
  const double from_s = tick.now().tick < tick_ ? tick.now().after_s : kTick_s;
  double to_s = seconds(until);
  bool is_found = false;
  const auto consider = [&](std::optional<double> at_s, const Found& what) {
    if (!at_s || (is_found && *at_s >= to_s)) return;
    is_found = true;
    to_s = *at_s;
    found_ = what;
  };
  for (int number = 0; number < kAxisCount; ++number) {
    if ((watched_ >> number & 1U) == 0) continue;
    for (std::size_t which = 0; which < kComparators; ++which) {
      if ((axis(number).compares_by_tick >> which & 1U) == 0) continue;
      consider(next_comparison(tick, question(number, which), from_s, to_s),
               {.axis = number, .comparator = which});
    }
    if (!has_chip_pins()) continue;
    for (const ChipPin pin : {kClearPin, kLatchPin}) {
      consider(next_flip(tick, number, pin, from_s, to_s), {.axis = number, .pin = pin});
    }
  }
  if (!is_found) return std::nullopt;
  return instant(to_s);
}

void TickEdges::at_moment(motion::SharedTick& tick) {
  const int number = found_.axis;
  const double at_s = seconds(tick.now());
  tick.bring(static_cast<std::size_t>(number));
  counters_.count_until(number, at_s);
  if (found_.comparator) return compare(tick, question(number, *found_.comparator));
  if (is_held_cleared(number, kCounter1)) pins_.clear_by_pin(number);  // the counters were held at 0
  pins_.pin_changes(number, found_.pin, !pin_seen(number, found_.pin), speed(number, at_s));
}

void TickEdges::compare(motion::SharedTick& tick, const Question& of) {
  AxisState& state = axis(of.axis);
  state.compared[of.which] = sample(tick, of, seconds(tick.now())).number;
  const Settings settings = registers();
  if (latches(settings, of.axis, of.which)) {
    state.latch_was_on = true;
    latch(tick, of.axis);
  }
  const Value action = settings.of(kComparatorRows[of.which].action, of.axis);
  if (!stops(action) || !chip(of.axis).moving()) return;
  const motion::Cause why = of.method != kSoftLimit ? motion::Cause::comparator
                            : of.which == 0         ? motion::Cause::soft_limit_plus
                                                    : motion::Cause::soft_limit_minus;
  stop(tick, of.axis, action == kStopByRamp, why);
}

/// Stops an axis, or the path that carries it.
void TickEdges::stop(motion::SharedTick& tick, int axis, bool by_ramp, motion::Cause why) {
  ground_.touch();
  if (by_ramp && is_on_path(axis)) return tick.slow_path(why, axes_.path.run.speed());
  by_ramp ? chip(axis).slow_down(tick.now(), why) : chip(axis).stop(why, tick.now());
}

}  // namespace understudy::emulator::models::super_40nc
