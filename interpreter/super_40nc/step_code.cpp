#include "interpreter/super_40nc/step_code.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {

StepCode::StepCode(const AreaProgram& program, const std::set<std::int32_t>& others) : program_(program) {
  for (const Instruction& line : program_.lines) {
    steps_.push_back(static_cast<int>(lines_.size()));
    lines_.push_back(static_cast<int>(steps_.size()) - 1);
    lines_.resize(lines_.size() + static_cast<std::size_t>(steps_of(line)) - 1, -1);
  }
  targets_.assign(program_.lines.size(), -1);
  find_labels(others);
  find_blocks();
}

int StepCode::next_step(int step) const {
  for (int at = step; at >= 0 && at < length(); ++at) {
    if (line_at(at) >= 0) return at;
  }
  return -1;
}

void StepCode::find_labels(const std::set<std::int32_t>& others) {
  std::map<std::int32_t, int> labels;
  for (std::size_t i = 0; i < program_.lines.size(); ++i) {
    const std::int32_t number = program_.lines[i].fields[0].number;
    if (program_.lines[i].op == Op::lab && !others.contains(number)) labels.emplace(number, steps_[i]);
  }
  for (std::size_t i = 0; i < program_.lines.size(); ++i) {
    const Instruction& line = program_.lines[i];
    if (line.op != Op::jmp && line.op != Op::cj && line.op != Op::cjn && line.op != Op::cal) continue;
    if (const auto label = labels.find(line.fields[0].number); label != labels.end())
      targets_[i] = label->second;
  }
}

void StepCode::find_blocks() {
  std::vector<std::size_t> open;  // each open IF, or its ELSE
  for (std::size_t i = 0; i < program_.lines.size(); ++i) {
    const Op op = program_.lines[i].op;
    if (op == Op::if_) open.push_back(i);
    if ((op != Op::else_ && op != Op::endi) || open.empty()) continue;
    targets_[open.back()] = op == Op::else_ ? steps_[i] + 1 : steps_[i];
    if (op == Op::else_) {
      open.back() = i;
    } else {
      open.pop_back();
    }
  }
}

}  // namespace understudy::interpreter::super_40nc
