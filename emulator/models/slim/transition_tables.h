// The outline of rules/transitions.h and rules/pauses.h for coverage.
#pragma once

#include <cstddef>
#include <span>

#include "emulator/device/transition_table.h"
#include "emulator/models/slim/rules/transitions.h"
#include "emulator/models/slim/state.h"

namespace understudy::emulator::models::slim {

/// The number of the table that counts the errors.
inline constexpr std::size_t kErrorTable = 2;

std::span<const TransitionTable> transition_tables();

/// Records the tasks of all modules and of the program when an event occurs.
void note_tasks(const State& state, Event event);

}  // namespace understudy::emulator::models::slim
