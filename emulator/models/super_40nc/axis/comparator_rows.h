// The settings of the comparators (D9x31 to D9x48, D8x44 to D8x48), and the moment at which a number fulfils
// the condition of a comparator.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"

namespace understudy::emulator::models::super_40nc {

struct ComparatorRow {
  StoredRegister source, method, action, value;
};
inline constexpr std::array<ComparatorRow, kComparators> kComparatorRows{
    {{stored_x(d9x::kCp1Source), stored_x(d9x::kCp1Method), stored_x(d9x::kCp1Action), stored_d(d8x::kRcmp1)},
     {stored_x(d9x::kCp2Source), stored_x(d9x::kCp2Method), stored_x(d9x::kCp2Action), stored_d(d8x::kRcmp2)},
     {stored_x(d9x::kCp3Source), stored_x(d9x::kCp3Method), stored_x(d9x::kCp3Action), stored_d(d8x::kRcmp3)},
     {stored_x(d9x::kCp4Source), stored_x(d9x::kCp4Method), stored_x(d9x::kCp4Action), stored_d(d8x::kRcmp4)},
     {stored_x(d9x::kCp5Source), stored_x(d9x::kCp5Method), stored_x(d9x::kCp5Action),
      stored_d(d8x::kPrcmp5)}}};

/// The sources. The source of a counter is its index. COUNTER3 is compared without its sign.
enum CompareSource : Value { kCounter1, kCounter2, kCounter3, kCounter4, kRemaining, kSpeed };
enum CompareMethod : Value { kEqual = 1, kEqualUpwards, kEqualDownwards, kSetAbove, kSetBelow, kSoftLimit };
enum CompareAction : Value { kStopAtOnce = 1, kStopByRamp };

constexpr bool stops(Value action) { return action == kStopAtOnce || action == kStopByRamp; }

/// Returns true if the comparator latches the counters (D9x50: 2 and 3 are the comparators 4 and 5).
inline bool latches(const Settings& settings, int axis, std::size_t which) {
  return which >= 3 && settings.of(stored_x(d9x::kLatchOfCounters), axis) == static_cast<Value>(which) - 1;
}

/// Returns true if a number has fulfilled the condition between two values. Soft limits have no such moment.
constexpr bool is_met(Value source, Value method, std::int64_t before, std::int64_t present,
                      std::int64_t set) {
  // The remaining distance only decreases. If it increases, a new move has set it, so it has passed nothing.
  if (source == kRemaining && present > before) before = std::max(before, present - 1);
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

}  // namespace understudy::emulator::models::super_40nc
