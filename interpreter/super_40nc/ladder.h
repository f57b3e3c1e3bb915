// A compiled PLC program: its lines, decoded into small steps that refer to cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/numbers.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {

/// The action of a step.
enum class Act : std::uint8_t {
  load,  // a contact that begins a block, or is in series or in parallel
  series,
  parallel,
  load_edge,  // the same with a memory: ON during the scan of an edge
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
  general,  // any other instruction, executed from its line
  end,
};

/// Where a step finds a value or a contact.
enum class Bank : std::uint8_t { cells, constants, special };

inline constexpr std::uint16_t kNoLine = UINT16_MAX;  // the end of a program without END

struct LadderStep {
  Act act = Act::end;
  Bank bank_a = Bank::cells;
  Bank bank_b = Bank::cells;
  std::uint8_t flags = 0;  // kInverted and others; the Relations of a comparison
  std::uint16_t line = kNoLine;
  std::uint16_t memory = 0;  // for edges
  std::uint32_t a = 0;       // a cell, an index into the constants, or a special number
  std::uint32_t b = 0;
  std::uint32_t c = 0;  // the cell to write
};
inline constexpr std::uint8_t kInverted = 1;
inline constexpr std::uint8_t kFalling = 2;
inline constexpr std::uint8_t kRetentive = 4;    // the written cell is retentive
inline constexpr std::uint8_t kValueIsRead = 8;  // for timers: another instruction depends on the value

class Ladder {
 public:
  Ladder() = default;
  Ladder(const AreaProgram& program, const CellLayout& layout, const Options& options);

  bool is_empty() const { return steps_.size() <= 1; }
  const std::vector<LadderStep>& steps() const { return steps_; }
  const std::vector<std::uint32_t>& constants() const { return constants_; }
  const Instruction& line(std::size_t number) const { return program_.lines[number]; }
  /// Returns the step number of a line, counted as in D8095.
  int step_of(std::size_t line) const { return step_numbers_[line]; }
  /// Returns how many memories the edges, timers and counters need.
  std::size_t memory_count() const { return memory_count_; }
  const std::vector<std::uint32_t>& timers() const { return timers_; }  // indices of steps

  /// Returns everything that a scan may read, without duplicates. If none of it has changed since a scan that
  /// changed nothing, another scan will not change anything. Special contacts and registers may be
  /// computed, so the device must check those itself.
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
