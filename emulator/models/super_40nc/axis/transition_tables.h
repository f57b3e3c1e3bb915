// The outline of ownership.h for coverage.
#pragma once

#include <cstddef>
#include <span>

#include "emulator/device/transition_table.h"

namespace understudy::emulator::models::super_40nc {

inline constexpr std::size_t kOwnershipTable = 0;  // the number of the only table

std::span<const TransitionTable> transition_tables();

}  // namespace understudy::emulator::models::super_40nc
