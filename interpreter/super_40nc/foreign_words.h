// What a listing says that is no word of it: instructions and operands of other PLCs that people bring along,
// and what is written here instead. The nearest word by its letters would often be another instruction.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/super_40nc/instruction_row.h"

namespace understudy::interpreter::super_40nc {

constexpr bool is_decimal_digit(char letter) { return letter >= '0' && letter <= '9'; }
/// Digits with a sign perhaps; nothing if 64 bits do not hold it.
std::optional<std::int64_t> decimal(std::string_view text);

/// In capitals; null if there is none.
const InstructionRow* find_mnemonic(std::string_view word);
/// The end of a complaint about one that does not exist: "; expected AD=".
std::string nearest_instruction(std::string_view written);

struct Unknown {
  std::string what;      // "'H10' is not an operand: constants are decimal"
  std::string expected;  // "K16"
};
Unknown why_not_operand(std::string_view text);

}  // namespace understudy::interpreter::super_40nc
