// The outline of transitions.h for coverage.
#pragma once

#include <cstddef>
#include <span>

#include "emulator/device/transition_table.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"

namespace understudy::emulator::models::rs_m8194h {

// The numbers of the tables.
inline constexpr std::size_t kStartTable = 0;
inline constexpr std::size_t kStopTable = 1;
inline constexpr std::size_t kDiscardTable = 2;

/// Returns the state number in the first table. The obstacles come first, followed by the activities of an
/// axis without obstacles.
constexpr std::size_t start_state(Obstacle obstacle) { return static_cast<std::size_t>(obstacle); }
constexpr std::size_t start_state(Activity activity) {
  return kObstacles + static_cast<std::size_t>(activity);
}

std::span<const TransitionTable> transition_tables();

}  // namespace understudy::emulator::models::rs_m8194h
