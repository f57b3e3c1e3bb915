#include "emulator/models/simple2_r3/transition_tables.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/transition_table.h"
#include "emulator/models/simple2_r3/transitions.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

std::vector<std::string> states() {
  std::vector<std::string> names;
  for (const std::string& activity : words_of<Activity, kActivities>()) {
    for (const std::string& phase : words_of<Phase, kPhases>()) names.push_back(activity + ", " + phase);
  }
  return names;
}

bool can_occur(std::size_t state, std::size_t event) {
  const auto activity = static_cast<Activity>(state / kPhases);
  const auto phase = static_cast<Phase>(state % kPhases);
  return is_phase_of(activity, phase) && can_come(phase, static_cast<Event>(event));
}

}  // namespace

std::span<const TransitionTable> transition_tables() {
  static const std::vector<TransitionTable> tables{{.name = "reactions of axes",
                                                    .states = states(),
                                                    .events = words_of<Event, kEvents>(),
                                                    .can_occur = can_occur}};
  return tables;
}

}  // namespace understudy::emulator::models::simple2_r3
