// Image slots that several files use, found by the names of their registers.
#pragma once

#include <array>
#include <cstddef>

#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/registers.h"

namespace understudy::emulator::models::simple2_r3 {

inline constexpr std::size_t kPassword = slot("NEW_PWD");
/// The columns of the program. From each of these slots on, there is one slot per line.
inline constexpr std::array<std::size_t, 4> kColumns{slot("MAIN_LINE{}_CMD"), slot("MAIN_LINE{}_DATA1"),
                                                     slot("MAIN_LINE{}_DATA2"), slot("MAIN_LINE{}_JMP")};

/// Calls `visit(slot, row)` for every register.
template <typename Visit>
void for_each_slot(Visit visit) {
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    for (int i = 0; i < row.count; ++i) visit(next++, row);
  }
}

}  // namespace understudy::emulator::models::simple2_r3
