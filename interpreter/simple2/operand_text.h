// Operands as text in a listing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/simple2/instructions.h"
#include "interpreter/simple2/program.h"

namespace understudy::interpreter::simple2 {

/// An operand in the text: either one cell or the two cells of a 16-bit amount.
struct OperandField {
  Operand kind;
  bool is_data1;
};

/// Returns the fields that a listing writes after the mnemonic. The field of a 16-bit amount is that of its
/// low half.
std::vector<OperandField> operand_fields(const Instruction& instruction);

/// Returns true if the range of the amount in the manual is -32768 to 32767.
bool amount_is_signed(const Instruction& instruction);

struct ParsedOperand {
  int value = 0;
  std::string problem;  // empty if there is none
};

/// Parses all kinds except amounts and flags, because flags depend on labels.
ParsedOperand parse_operand(Operand kind, std::string_view text);
ParsedOperand parse_amount(bool is_signed, std::string_view text);
/// Parses an integer (decimal, 0x or 0b) within limits.
ParsedOperand parse_number(std::string_view text, int min, int max);

/// Quotes a word of a listing for messages.
inline std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

/// Describes the expected operand: "ON or OFF".
std::string expected_operand(Operand kind);
std::string expected_amount(bool is_signed);

/// Returns nothing if the cell contains a value that this kind cannot have.
std::optional<std::string> operand_text(Operand kind, std::uint8_t cell);
/// Returns "JMP7", or "@200" if the cell is not a flag.
std::string flag_text(std::uint8_t cell);

}  // namespace understudy::interpreter::simple2
