#include "emulator/models/rs_m8194h/drives/transition_tables.h"

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "emulator/device/transition_table.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

std::vector<std::string> start_states() {
  std::vector<std::string> names = words_of<Obstacle, kObstacles>();
  for (std::string& activity : words_of<Activity, kActivities>()) names.push_back(std::move(activity));
  return names;
}

/// Returns false for obstacles that do not affect that starter. In this case, the axis's activity decides.
bool can_start_meet(std::size_t state, std::size_t starter) {
  if (state >= kObstacles) return true;
  const ObstacleRow& row = kObstacleRows[state];
  return (static_cast<Starter>(starter) == Starter::command ? row.command : row.external) != Start::starts;
}

}  // namespace

std::span<const TransitionTable> transition_tables() {
  static const std::vector<TransitionTable> tables{
      {.name = "starts of drives",
       .states = start_states(),
       .events = {"command", "external"},
       .can_occur = can_start_meet},
      // In the order of kStopRows.
      {.name = "stops of axes",
       .states = words_of<Activity, kActivities>(),
       .events = {"STOP_SLOWLY", "STOP_SUDDENLY", "VSTOP_SLOWLY", "VSTOP_SUDDENLY", "EMERGENCY_STOP 0",
                  "EMERGENCY_STOP 1"}},
      {.name = "what is left of motions",
       .states = words_of<Mark, kMarks>(),
       .events = words_of<DiscardEvent, kDiscardEvents>()},
      {.name = "errors",
       .states = words_of<ErrorBit, kErrors>(),
       .events = {"occurred"},
       .can_occur = [](std::size_t bit, std::size_t /*event*/) {
         return static_cast<ErrorBit>(bit) != ErrorBit::reserved;
       }}};
  return tables;
}

}  // namespace understudy::emulator::models::rs_m8194h
