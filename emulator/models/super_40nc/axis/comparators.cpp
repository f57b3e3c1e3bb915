// The five comparators of an axis (D9x31 to D9x48, D8x44 to D8x48): = (1), upwards (2), downwards (3), set >
// count (4), set < count (5), and soft limits (6). The axis itself compares COUNTER1, and COUNTER2 and
// COUNTER4 if they count pulses or an encoder, but at most four comparators. tick_edges.h compares everything
// else. Both react at the exact pulse. Only what cannot be predicted is checked at the end of a tick: an
// encoder that does not follow the axis.
#include "emulator/models/super_40nc/axis/comparators.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/comparator_rows.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "motion/axis.h"
#include "motion/counter.h"

namespace understudy::emulator::models::super_40nc {

namespace {

motion::Comparator::Relation relation_of(Value method) {
  using Relation = motion::Comparator::Relation;
  switch (method) {
    case kEqual: return Relation::equal;
    case kEqualUpwards: return Relation::equal_upwards;
    case kEqualDownwards: return Relation::equal_downwards;
    case kSetAbove: return Relation::below;
    case kSetBelow: return Relation::at_least;
    default: return Relation::off;
  }
}

}  // namespace

/// Returns the number that a comparator compares.
std::int64_t Comparators::compared_number(int axis, std::size_t which) const {
  switch (registers().of(kComparatorRows[which].source, axis)) {
    case kCounter1: return counter(axis, 0);
    case kCounter2: return counter(axis, 1);
    case kCounter3: return std::abs(std::int64_t{counter(axis, 2)});
    case kCounter4: return counter(axis, 3);
    case kRemaining: return remaining_pulses(axis);
    default: return chip_speed(axis);
  }
}

bool Comparators::comparator_holds(int axis, int number) const {
  const ComparatorRow& row = kComparatorRows[static_cast<std::size_t>(number)];
  const Settings settings = registers();
  const Value method = settings.of(row.method, axis);
  if (method == 0) return false;
  const std::int32_t value = settings.raw(row.value, axis);
  const std::int64_t present = compared_number(axis, static_cast<std::size_t>(number));
  const int direction = chip(axis).last_direction;
  switch (method) {
    case kEqual: return present == value;
    case kEqualUpwards: return present == value && direction > 0;
    case kEqualDownwards: return present == value && direction < 0;
    case kSetAbove: return value > present;
    case kSetBelow: return value < present;
    case kSoftLimit: return number == 0 ? present > value : number == 1 && present < value;
    default: return false;
  }
}

/// Returns the comparator in the form that the axis uses, or nothing if the axis cannot evaluate it.
std::optional<motion::Comparator> Comparators::comparator_of(int axis_number, std::size_t which) const {
  const Settings settings = registers();
  const ComparatorRow& row = kComparatorRows[which];
  const Value method = settings.of(row.method, axis_number);
  motion::Comparator made{.relation = relation_of(method),
                          .value = settings.raw(row.value, axis_number) + (method == kSetBelow ? 1 : 0)};
  if (made.relation == motion::Comparator::Relation::off) return std::nullopt;
  const Value source = settings.of(row.source, axis_number);
  const AxisState& state = axis(axis_number);
  if (source == kCounter1) {
    made.counter = state.command;
    return made;
  }
  const bool is_stopped =
      is_bit(settings.raw(stored_x(d9x::kDisableC2ToC4), axis_number), static_cast<int>(source) - 1);
  if (is_stopped || (source != kCounter2 && source != kCounter4)) return std::nullopt;
  // The source of COUNTER2 is D9x23, and that of COUNTER4 is D9x25: the pulses, the encoder, or something
  // else.
  const Value from =
      settings.of(source == kCounter2 ? stored_x(d9x::kC2Source) : stored_x(d9x::kC4Source), axis_number);
  const bool by_pulses = from == (source == kCounter2 ? 1 : 0);
  const bool by_encoder =
      from == (source == kCounter2 ? 0 : 1) && !settings.is_on(stored_x(d9x::kEncoderDisable), axis_number);
  if (!by_pulses && !by_encoder) return std::nullopt;
  const motion::Axis& motor = chip(axis_number);
  made.count = by_encoder ? motion::Count::encoder : motion::Count::command;
  made.counter.range = motion::Counter::Range::bits32;
  made.counter.set(counter(axis_number, static_cast<int>(source)),
                   by_encoder ? motor.encoder_pulses : motor.travel_pulses);
  return made;
}

void Comparators::set_comparators(int axis_number) {
  const Settings settings = registers();
  motion::Axis& motor = chip(axis_number);
  AxisState& state = axis(axis_number);
  std::size_t next = 0;
  state.compares_by_tick = 0;
  state.latching = 0;
  for (std::size_t which = 0; which < kComparators; ++which) {
    const ComparatorRow& row = kComparatorRows[which];
    const Value method = settings.of(row.method, axis_number);
    const Value action = settings.of(row.action, axis_number);
    const bool is_latch = latches(settings, axis_number, which);
    if ((!stops(action) && !is_latch) || method == 0) continue;
    const Value source = settings.of(row.source, axis_number);
    if (source == kCounter1 && method == kSoftLimit) continue;  // the axis's own soft limit
    if (source <= kCounter4 && is_held_cleared(axis_number, static_cast<int>(source))) continue;
    std::optional<motion::Comparator> made = comparator_of(axis_number, which);
    if (!made || next == motor.comparators.size()) {
      state.compares_by_tick = static_cast<std::uint8_t>(state.compares_by_tick | 1U << which);
      continue;
    }
    if (is_latch) state.latching = static_cast<motion::Events>(1U << next);
    if (stops(action))
      made->reaction = action == kStopAtOnce ? motion::Reaction::stop_at_once : motion::Reaction::slow_down;
    set_comparator(axis_number, next++, *made);
  }
  while (next < motor.comparators.size()) set_comparator(axis_number, next++, {});
  see_counters(axis_number);
}

/// Sets a comparator. Setting an equal one again changes nothing.
void Comparators::set_comparator(int axis, std::size_t place, motion::Comparator wanted) {
  const motion::Comparator& present = chip(axis).comparators[place];
  wanted.was_true = present.was_true;
  if (wanted.relation == motion::Comparator::Relation::off && present.relation == wanted.relation) return;
  if (wanted != present) chip(axis).set_comparator(place, wanted);
}

/// Marks the counters as seen, because a written number has not passed anything.
void Comparators::see_counters(int axis_number) {
  AxisState& state = axis(axis_number);
  for (std::size_t which = 0; which < kComparators; ++which) {
    if ((state.compares_by_tick >> which & 1U) == 0) continue;
    state.compared[which] = compared_number(axis_number, which);
  }
}

std::optional<ComparatorStop> Comparators::compare(int axis_number, std::size_t which) {
  AxisState& state = axis(axis_number);
  if ((state.compares_by_tick >> which & 1U) == 0) return std::nullopt;
  const Settings settings = registers();
  const ComparatorRow& row = kComparatorRows[which];
  const std::int64_t before = state.compared[which];
  const std::int64_t present = compared_number(axis_number, which);
  state.compared[which] = present;
  const Value action = settings.of(row.action, axis_number);
  if (!chip(axis_number).moving() || !stops(action)) return std::nullopt;
  const bool by_ramp = action == kStopByRamp;
  const Value method = settings.of(row.method, axis_number);
  if (method != kSoftLimit) {
    const Value source = settings.of(row.source, axis_number);
    const bool stops_it = is_met(source, method, before, present, settings.raw(row.value, axis_number));
    return stops_it ? std::optional(ComparatorStop{by_ramp, motion::Cause::comparator}) : std::nullopt;
  }
  const int direction = which == 0 ? +1 : -1;
  if (which > 1 || chip(axis_number).last_direction != direction ||
      !comparator_holds(axis_number, static_cast<int>(which))) {
    return std::nullopt;
  }
  return ComparatorStop{by_ramp,
                        direction > 0 ? motion::Cause::soft_limit_plus : motion::Cause::soft_limit_minus};
}

}  // namespace understudy::emulator::models::super_40nc
