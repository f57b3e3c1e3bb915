// A compiled step program: where its steps begin, and the targets of its jumps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {

class StepCode {
 public:
  StepCode() = default;
  /// The labels in `others` belong to other areas, so jumps to them have no target.
  explicit StepCode(const AreaProgram& program, const std::set<std::int32_t>& others = {});

  bool is_empty() const { return program_.lines.empty(); }
  const Instruction& line(int number) const { return program_.lines[static_cast<std::size_t>(number)]; }
  /// Returns the line that begins at a step, counted from the beginning of the area, or -1 if no line begins
  /// there.
  int line_at(int step) const {
    const bool is_present = step >= 0 && step < static_cast<int>(lines_.size());
    return is_present ? lines_[static_cast<std::size_t>(step)] : -1;
  }
  /// Returns the step of the first line after a step inside a line, or -1 if there is none.
  int next_step(int step) const;
  /// Returns the step after the last line.
  int length() const { return static_cast<int>(lines_.size()); }
  int line_count() const { return static_cast<int>(steps_.size()); }
  int step_of(int line) const { return steps_[static_cast<std::size_t>(line)]; }
  /// Returns the target step of a line. JMP, CJ, CJN, CAL: the first such label, or -1 if there is none. IF:
  /// the line after ELSE, or ENDI. ELSE: ENDI.
  int target_of(int line) const { return targets_[static_cast<std::size_t>(line)]; }

 private:
  void find_labels(const std::set<std::int32_t>& others);
  void find_blocks();

  AreaProgram program_;
  std::vector<int> lines_;    // by step
  std::vector<int> steps_;    // by line
  std::vector<int> targets_;  // by line
};

}  // namespace understudy::interpreter::super_40nc
