// SUPER-40NC: every contact and register, and where its value is stored.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/models/super_40nc/rows/contact_rows.h"
#include "emulator/models/super_40nc/rows/data_rows.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/parameter_rows.h"

namespace understudy::emulator::models::super_40nc {

template <std::size_t... N>
consteval auto join(const std::array<RegisterRow, N>&... sections) {
  std::array<RegisterRow, (N + ...)> all{};
  std::size_t next = 0;
  const auto add = [&](const auto& rows) {
    for (const RegisterRow& row : rows) all[next++] = row;
  };
  (add(sections), ...);
  return all;
}

inline constexpr auto kRegisters =
    join(kElementRows, kGeneralContactRows, kAxisContactRows, kPanelContactRows, kKeptPanelContactRows,
         kDataRows, kGeneralSpecialRows, kAxisSpecialRows, kGeneralParameterRows, kAxisParameterRows);

static_assert(are_marked(kRegisters), "a register does not say what a write can do");

inline constexpr std::size_t kSlotCount = [] {
  std::size_t count = 0;
  for (const RegisterRow& row : kRegisters) count += row.is_view ? 0 : static_cast<std::size_t>(row.count);
  return count;
}();

/// Calls visit(slot, row) for every register that has a slot.
template <typename Visit>
void for_each_slot(Visit visit) {
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    for (int i = 0; i < row.count && !row.is_view; ++i) visit(next++, row);
  }
}

/// A register from the view of the code: where its value is stored, and its limits.
struct StoredRegister {
  std::size_t slot = 0;
  Value min = INT32_MIN;
  Value max = INT32_MAX;
  bool on_axes = false;  // true: the first of several registers, one per axis, with adjacent values
};

consteval StoredRegister stored_at(Table table, int address) {
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    const int beyond = address - row.address;
    const bool is_in =
        row.table == table && beyond >= 0 && beyond % row.stride == 0 && beyond / row.stride < row.count;
    if (is_in && row.is_view) throw "a view of other state";
    if (is_in) {
      StoredRegister found{.slot = next + static_cast<std::size_t>(beyond / row.stride)};
      if (row.ranged) {
        found.min = row.min;
        found.max = row.max;
      }
      found.on_axes = row.count == kAxisCount && row.number_step == 100 && beyond == 0;
      return found;
    }
    if (!row.is_view) next += static_cast<std::size_t>(row.count);
  }
  throw "no such register";
}

/// Where the special contacts M8000 to M8699 are stored. Views of other state are not stored.
inline constexpr int kFirstSpecialContact = m8::kStartOfC;
inline constexpr std::size_t kNoSlot = SIZE_MAX;
inline constexpr auto kSpecialContactSlots = [] {
  std::array<std::size_t, 700> slots{};
  slots.fill(kNoSlot);
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    for (int i = 0; i < row.count && row.table == Table::coil; ++i) {
      const int number = row.address + i * row.stride - relay_address(kFirstSpecialContact);
      if (number >= 0 && !row.is_view) {
        slots[static_cast<std::size_t>(number)] = next + static_cast<std::size_t>(i);
      }
    }
    if (!row.is_view) next += static_cast<std::size_t>(row.count);
  }
  return slots;
}();
constexpr std::size_t relay_slot(int special) {
  return kSpecialContactSlots[static_cast<std::size_t>(special - kFirstSpecialContact)];
}

/// Marks the contacts and registers that are in none of the manual's tables.
inline constexpr auto kIsUnlisted = [] {
  struct Range {
    Table table;
    // `first` and `last` for axis X; `each`: distance to the next axis, or 0 if common to all axes
    int first, last, each;
  };
  constexpr Range kRanges[] = {
      {Table::coil, 8012, 8019, 0},    {Table::coil, 8027, 8099, 0},    {Table::coil, 8159, 8191, 100},
      {Table::holding, 8009, 8018, 0}, {Table::holding, 8030, 8089, 0}, {Table::holding, 8180, 8183, 100},
      {Table::holding, 8500, 8599, 0}, {Table::holding, 9020, 9020, 0}, {Table::holding, 9022, 9024, 0},
      {Table::holding, 9027, 9027, 0}, {Table::holding, 9030, 9034, 0}, {Table::holding, 9046, 9099, 0}};
  const auto names = [&](Table table, int number) {
    for (const Range& range : kRanges) {
      if (table != range.table) continue;
      for (int axis = 0; axis < (range.each == 0 ? 1 : kAxisCount); ++axis) {
        const int beyond = axis * range.each;
        if (number >= range.first + beyond && number <= range.last + beyond) return true;
      }
    }
    return false;
  };
  std::array<bool, kSlotCount> unlisted{};
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    if (row.is_view) continue;
    const bool is_special =
        (row.table == Table::coil || row.table == Table::holding) && row.first_number >= kFirstSpecialContact;
    for (int i = 0; i < row.count; ++i, ++next) {
      unlisted[next] = is_special && names(row.table, row.first_number + i * row.number_step);
    }
  }
  return unlisted;
}();

/// These find a register by its number. An unknown number is a compile error.
consteval StoredRegister stored_d(int number) { return stored_at(Table::holding, data_address(number)); }
/// Finds D9x00 + number, for the first axis.
consteval StoredRegister stored_x(int number) { return stored_d(of_x(number)); }

inline constexpr StoredRegister kFirstX = stored_at(Table::discrete, 0);
inline constexpr StoredRegister kFirstY = stored_at(Table::coil, 0);
inline constexpr StoredRegister kFirstM = stored_at(Table::coil, relay_address(0));
inline constexpr StoredRegister kFirstD = stored_d(0);

}  // namespace understudy::emulator::models::super_40nc
