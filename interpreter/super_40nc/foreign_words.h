// Explains words in a listing that are not in the language, such as instructions and operands of other PLCs,
// and suggests what to write instead. The nearest word by spelling would often be a different instruction.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/super_40nc/instruction_row.h"

namespace understudy::interpreter::super_40nc {

constexpr bool is_decimal_digit(char letter) { return letter >= '0' && letter <= '9'; }
/// Parses digits with an optional sign. Returns nothing if the number does not fit in 64 bits.
std::optional<std::int64_t> decimal(std::string_view text);

/// Finds a mnemonic, which must be in capitals. Returns null if there is no such mnemonic.
const InstructionRow* find_mnemonic(std::string_view word);
/// Returns the end of a message about an unknown instruction: "; expected AD=".
std::string nearest_instruction(std::string_view written);

struct Unknown {
  std::string what;      // "'H10' is not an operand: constants are decimal"
  std::string expected;  // "K16"
};
Unknown why_not_operand(std::string_view text);

}  // namespace understudy::interpreter::super_40nc
