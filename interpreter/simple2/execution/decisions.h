// The decisions of instructions, for observers of a program.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "interpreter/simple2/execution/step.h"
#include "interpreter/simple2/instructions.h"

namespace understudy::interpreter::simple2 {

enum class Decision : std::uint8_t {
  none,
  jump,       // jumps to its flag, or not
  condition,  // continues with the next line, or skips it
  wait,       // ends at once, or waits
};

/// Determines the decision from the mnemonic, because the manual names instructions after their function.
constexpr Decision decision_of(std::string_view mnemonic) {
  if (mnemonic.starts_with("Wait_")) return Decision::wait;
  if (mnemonic.starts_with("Jump_") || mnemonic == "Loop") return Decision::jump;
  if (mnemonic == "VAR_GT_0" || mnemonic == "VAR_GE_0") return Decision::jump;
  for (const std::string_view comparison : {"EQ", "GT", "LT"}) {
    const bool compares = mnemonic.starts_with("VAR_") && mnemonic.ends_with(comparison);
    if (compares) return Decision::condition;
  }
  return Decision::none;
}

inline constexpr std::array<Decision, 256> kDecisions = [] {
  std::array<Decision, 256> all{};
  for (const Instruction& row : kInstructions) all[row.opcode] = decision_of(row.mnemonic);
  return all;
}();

constexpr Decision decision_of(std::uint8_t opcode) { return kDecisions[opcode]; }

/// Returns nothing if the instruction does not decide, or if the program has ended instead.
constexpr std::optional<bool> outcome_of(Decision decision, Then then) {
  const bool ends = then >= Then::end;
  if (decision == Decision::none || ends) return std::nullopt;
  if (decision == Decision::jump) return then == Then::flag;
  return decision == Decision::condition ? then == Then::next_line : then != Then::same_line;
}

}  // namespace understudy::interpreter::simple2
