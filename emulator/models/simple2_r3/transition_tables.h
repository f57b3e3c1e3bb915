// The outline of transitions.h for coverage: a state is an activity in a phase.
#pragma once

#include <cstddef>
#include <span>

#include "emulator/device/transition_table.h"
#include "emulator/models/simple2_r3/transitions.h"

namespace understudy::emulator::models::simple2_r3 {

inline constexpr std::size_t kReactions = 0;  // the number of the only table

constexpr std::size_t reaction_state(Activity activity, Phase phase) {
  return static_cast<std::size_t>(activity) * kPhases + static_cast<std::size_t>(phase);
}

std::span<const TransitionTable> transition_tables();

}  // namespace understudy::emulator::models::simple2_r3
