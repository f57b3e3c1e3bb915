// Records what determined a device's decisions: the choices that it looked up, and the cells of its model's
// transition tables that occurred. Only coverage reads the record. It is not part of the state: a snapshot
// does not restore it, and two devices are equal even if their records differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/choices.h"
#include "emulator/device/transition_table.h"

namespace understudy::emulator {

class Decisions {
 public:
  Decisions(std::size_t choices, std::span<const TransitionTable> tables);

  void ask(std::size_t choice) { asked_[choice] = 1; }
  /// Returns the elements to set to 1 when this choice, or a later one, is looked up. They do not move in
  /// memory.
  std::uint8_t* asked(std::size_t choice) { return &asked_[choice]; }
  void meet(std::size_t table, std::size_t state, std::size_t event) {
    Cells& cells = cells_[table];
    ++cells.counts[state * cells.events + event];
  }

  /// Starts counting. Choices that were looked up before and are not looked up again are those whose options
  /// the device stores when it is created or switched on.
  void begin();
  bool is_asked(std::size_t choice) const { return asked_[choice] != 0; }
  bool was_asked_before(std::size_t choice) const { return asked_before_[choice] != 0; }
  std::int64_t met(std::size_t table, std::size_t state, std::size_t event) const {
    return cells_[table].counts[state * cells_[table].events + event];
  }

 private:
  struct Cells {
    std::size_t events = 0;
    std::vector<std::int64_t> counts{};  // by state, then by event
  };
  // Bytes are faster than bits, and every tick may look up a choice.
  std::vector<std::uint8_t> asked_;
  std::vector<std::uint8_t> asked_before_;
  std::vector<Cells> cells_;
};

/// The selected options, by row, for code that looks them up while a device is created.
struct AskedOptions {
  std::span<const std::uint8_t> numbers;
  Decisions* decisions = nullptr;  // null: decisions are not counted

  bool chose(const Option& option) const {
    if (decisions != nullptr) decisions->ask(option.choice);
    return numbers[option.choice] == option.number;
  }
};

}  // namespace understudy::emulator
