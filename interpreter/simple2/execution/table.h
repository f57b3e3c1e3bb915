// Every instruction with its action, by opcode.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/complete_table.h"
#include "interpreter/simple2/execution/flow.h"
#include "interpreter/simple2/execution/motion.h"
#include "interpreter/simple2/execution/numbers.h"
#include "interpreter/simple2/execution/outputs.h"

namespace understudy::interpreter::simple2 {

inline constexpr auto kOpcodes = [] {
  std::array<std::uint8_t, kInstructions.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = kInstructions[i].opcode;
  return all;
}();

/// The action of each opcode; null if the manual does not define the opcode.
inline constexpr CompleteTable<std::uint8_t, Action> kActions(kOpcodes, kFlowActions, kOutputActions,
                                                              kNumberActions, kMotionActions);

}  // namespace understudy::interpreter::simple2
