// Every instruction with what it does, by opcode.
#pragma once

#include <array>

#include "interpreter/simple2/execution/flow.h"
#include "interpreter/simple2/execution/motion.h"
#include "interpreter/simple2/execution/numbers.h"
#include "interpreter/simple2/execution/outputs.h"

namespace understudy::interpreter::simple2 {

using ActionTable = std::array<Action, 256>;

consteval ActionTable action_table() {
  ActionTable table{};
  std::array<bool, 256> is_filled{};  // g++'s sanitizers cannot compare with null here (GCC bug 71962)
  const auto add = [&](const auto& rows) {
    for (const ActionRow& row : rows) {
      if (is_filled[row.opcode]) throw "an instruction does two things";
      is_filled[row.opcode] = true;
      table[row.opcode] = row.action;
    }
  };
  add(kFlowActions);
  add(kOutputActions);
  add(kNumberActions);
  add(kMotionActions);
  for (const Instruction& instruction : kInstructions) {
    if (!is_filled[instruction.opcode]) throw "an instruction does nothing";
  }
  return table;
}

/// Nothing where the manual lists no instruction.
inline constexpr ActionTable kActions = action_table();

}  // namespace understudy::interpreter::simple2
