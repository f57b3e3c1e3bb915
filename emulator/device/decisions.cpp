#include "emulator/device/decisions.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "emulator/device/transition_table.h"

namespace understudy::emulator {

Decisions::Decisions(std::size_t choices, std::span<const TransitionTable> tables)
    : asked_(choices), asked_before_(choices) {
  for (const TransitionTable& table : tables) {
    cells_.push_back({.events = table.events.size(),
                      .counts = std::vector<std::int64_t>(table.states.size() * table.events.size())});
  }
}

void Decisions::begin() {
  for (std::size_t choice = 0; choice < asked_.size(); ++choice) {
    if (asked_[choice] != 0) asked_before_[choice] = 1;
    asked_[choice] = 0;
  }
  for (Cells& cells : cells_) std::ranges::fill(cells.counts, 0);
}

}  // namespace understudy::emulator
