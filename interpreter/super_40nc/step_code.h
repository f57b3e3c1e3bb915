// A step program made ready to run: where its steps begin, and where its jumps lead.
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
  /// Labels of `others` are not its own: jumps to them find none.
  explicit StepCode(const AreaProgram& program, const std::set<std::int32_t>& others = {});

  bool is_empty() const { return program_.lines.empty(); }
  const Instruction& line(int number) const { return program_.lines[static_cast<std::size_t>(number)]; }
  /// -1 if no instruction begins at the step, counted from the begin of the area.
  int line_at(int step) const {
    const bool is_there = step >= 0 && step < static_cast<int>(lines_.size());
    return is_there ? lines_[static_cast<std::size_t>(step)] : -1;
  }
  /// Of the first line behind a step that is in the midst of one; -1: there is none.
  int next_step(int step) const;
  /// Behind the last line.
  int length() const { return static_cast<int>(lines_.size()); }
  int step_of(int line) const { return steps_[static_cast<std::size_t>(line)]; }
  /// JMP, CJ, CJN, CAL: the step of the first such label; -1: there is none. IF: of the line behind ELSE, or
  /// of ENDI. ELSE: of ENDI.
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
