// A PLC program made ready to run: its lines decoded once into small steps that name cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/numbers.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {

/// What a step does.
enum class Act : std::uint8_t {
  load,  // contacts: into a block of its own, in series, in parallel
  series,
  parallel,
  load_edge,  // the same, with a memory: ON for the scan of an edge
  series_edge,
  parallel_edge,
  load_comparison,
  series_comparison,
  parallel_comparison,
  join_series,
  join_parallel,
  branch,
  branch_again,
  branch_last,
  invert,
  out,
  set,
  reset,
  timer,
  counter,
  move,
  add,
  subtract,
  general,  // all others: by the line
  end,
};

/// Where a step finds a value or contact.
enum class Bank : std::uint8_t { cells, constants, special };

struct LadderStep {
  Act act = Act::end;
  Bank bank_a = Bank::cells;
  Bank bank_b = Bank::cells;
  std::uint8_t flags = 0;  // kInverted, kFalling, kKept; of a comparison: its Relations
  std::uint16_t line = 0;
  std::uint16_t memory = 0;  // of an edge
  std::uint32_t a = 0;       // cell, index into the constants, or number of a special one
  std::uint32_t b = 0;
  std::uint32_t c = 0;  // cell that is written
};
inline constexpr std::uint8_t kInverted = 1;
inline constexpr std::uint8_t kFalling = 2;
inline constexpr std::uint8_t kKept = 4;         // what is written survives power-off
inline constexpr std::uint8_t kValueIsRead = 8;  // of a timer: something else depends on its value

class Ladder {
 public:
  Ladder() = default;
  Ladder(const AreaProgram& program, const CellLayout& layout, const Options& options);

  bool is_empty() const { return steps_.size() <= 1; }
  const std::vector<LadderStep>& steps() const { return steps_; }
  const std::vector<std::uint32_t>& constants() const { return constants_; }
  const Instruction& line(std::size_t number) const { return program_.lines[number]; }
  /// The step of a line as D8095 counts.
  int step_of(std::size_t line) const { return step_numbers_[line]; }
  /// Of edges, timers and counters.
  std::size_t memory_count() const { return memory_count_; }
  const std::vector<std::uint32_t>& timers() const { return timers_; }  // indices of steps

  /// Everything that a scan may look at, each once: when none of it has changed since a scan that changed
  /// nothing, a scan would change nothing. Special ones may be computed, so the device has to know them.
  const std::vector<Operand>& reads() const { return reads_; }

 private:
  friend class LadderMaker;

  AreaProgram program_;
  std::vector<LadderStep> steps_{LadderStep{}};
  std::vector<std::uint32_t> constants_;
  std::vector<int> step_numbers_;
  std::size_t memory_count_ = 0;
  std::vector<std::uint32_t> timers_;
  std::vector<Operand> reads_;
};

}  // namespace understudy::interpreter::super_40nc
