// The five comparators of an axis (D9x31 to D9x48, D8x44 to D8x48): = (1), on the way up (2) or down (3),
// set > count (4), set < count (5), and soft limits (6). The chip stops and latches at the exact pulse for
// COUNTER1, and for COUNTER2 and COUNTER4 if they count pulses or an encoder. For other numbers, and for soft
// limits on counters other than COUNTER1, it does so at the end of a tick.
#include "emulator/models/super_40nc/axis/comparators.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "motion/axis.h"
#include "motion/counter.h"

namespace understudy::emulator::models::super_40nc {

namespace {

struct ComparatorRow {
  Kept source, method, action, value;
};
constexpr std::array<ComparatorRow, kComparators> kComparatorRows{
    {{kept_x(d9x::kCp1Source), kept_x(d9x::kCp1Method), kept_x(d9x::kCp1Action), kept_d(d8x::kRcmp1)},
     {kept_x(d9x::kCp2Source), kept_x(d9x::kCp2Method), kept_x(d9x::kCp2Action), kept_d(d8x::kRcmp2)},
     {kept_x(d9x::kCp3Source), kept_x(d9x::kCp3Method), kept_x(d9x::kCp3Action), kept_d(d8x::kRcmp3)},
     {kept_x(d9x::kCp4Source), kept_x(d9x::kCp4Method), kept_x(d9x::kCp4Action), kept_d(d8x::kRcmp4)},
     {kept_x(d9x::kCp5Source), kept_x(d9x::kCp5Method), kept_x(d9x::kCp5Action), kept_d(d8x::kPrcmp5)}}};

enum Method : Value { kEqual = 1, kEqualUpwards, kEqualDownwards, kSetAbove, kSetBelow, kSoftLimit };
constexpr Value kByRamp = 2;

bool stops(Value action) { return action == 1 || action == kByRamp; }

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

/// Returns true if a number has met the condition between two values.
bool is_met(Value method, std::int64_t before, std::int64_t present, std::int64_t set) {
  const bool upwards = before < set && set <= present;
  const bool downwards = before > set && set >= present;
  switch (method) {
    case kEqual: return upwards || downwards;
    case kEqualUpwards: return upwards;
    case kEqualDownwards: return downwards;
    case kSetAbove: return set > present && !(set > before);
    case kSetBelow: return set < present && !(set < before);
    default: return false;
  }
}

}  // namespace

/// Returns the number that a comparator compares.
std::int64_t Comparators::compared_number(int axis, std::size_t which) const {
  switch (registers().of(kComparatorRows[which].source, axis)) {
    case 0: return counter(axis, 0);
    case 1: return counter(axis, 1);
    case 2: return std::abs(std::int64_t{counter(axis, 2)});
    case 3: return counter(axis, 3);
    case 4: return remaining_pulses(axis);
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

/// Returns the comparator as the chip compares within a tick, or nothing if it is checked at the end of a
/// tick.
std::optional<motion::Comparator> Comparators::comparator_of(int axis_number, std::size_t which) const {
  const Settings settings = registers();
  const ComparatorRow& row = kComparatorRows[which];
  const Value method = settings.of(row.method, axis_number);
  motion::Comparator made{.relation = relation_of(method),
                          .value = settings.raw(row.value, axis_number) + (method == kSetBelow ? 1 : 0)};
  if (made.relation == motion::Comparator::Relation::off) return std::nullopt;
  const Value source = settings.of(row.source, axis_number);
  const AxisState& state = axis(axis_number);
  if (source == 0) {
    made.counter = state.command;
    return made;
  }
  constexpr Value kCounter2 = 1;
  constexpr Value kCounter4 = 3;
  const bool is_stopped =
      is_bit(settings.raw(kept_x(d9x::kDisableC2ToC4), axis_number), static_cast<int>(source));
  if (is_stopped || (source != kCounter2 && source != kCounter4)) return std::nullopt;
  // The source of COUNTER2 is D9x23, that of COUNTER4 D9x25: the pulses, the encoder, or something else.
  const Value from =
      settings.of(source == kCounter2 ? kept_x(d9x::kC2Source) : kept_x(d9x::kC4Source), axis_number);
  const bool by_pulses = from == (source == kCounter2 ? 1 : 0);
  const bool by_encoder =
      from == (source == kCounter2 ? 0 : 1) && !settings.is_on(kept_x(d9x::kEncoderDisable), axis_number);
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
    // D9x50: 2 and 3 are the comparators 4 and 5.
    const bool latches = which >= 3 && settings.of(kept_x(d9x::kLatchOfCounters), axis_number) ==
                                           static_cast<Value>(which) - 1;
    if ((!stops(action) && !latches) || method == 0) continue;
    if (settings.of(row.source, axis_number) == 0 && method == kSoftLimit)
      continue;  // the axis's own soft limit
    std::optional<motion::Comparator> made = comparator_of(axis_number, which);
    if (!made || next == motor.comparators.size()) {
      if (stops(action))
        state.compares_by_tick = static_cast<std::uint8_t>(state.compares_by_tick | 1U << which);
      continue;
    }
    if (latches) state.latching = static_cast<motion::Events>(1U << next);
    if (stops(action))
      made->reaction = action == 1 ? motion::Reaction::stop_at_once : motion::Reaction::slow_down;
    set_comparator(axis_number, next++, *made);
  }
  while (next < motor.comparators.size()) set_comparator(axis_number, next++, {});
  see_counters(axis_number);
}

/// Sets a comparator; setting the same one again changes nothing.
void Comparators::set_comparator(int axis, std::size_t place, motion::Comparator wanted) {
  const motion::Comparator& present = chip(axis).comparators[place];
  wanted.was_true = present.was_true;
  if (wanted.relation == motion::Comparator::Relation::off && present.relation == wanted.relation) return;
  if (wanted != present) chip(axis).set_comparator(place, wanted);
}

/// Marks the counters as seen: a written number has not passed anything.
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
  if (!chip(axis_number).moving()) return std::nullopt;
  const bool by_ramp = settings.of(row.action, axis_number) == kByRamp;
  const Value method = settings.of(row.method, axis_number);
  if (method != kSoftLimit) {
    const bool stops_it = is_met(method, before, present, settings.raw(row.value, axis_number));
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
