#include "interpreter/simple2/operand_text.h"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "interpreter/simple2/instructions.h"
#include "interpreter/simple2/parameter_names.h"
#include "interpreter/simple2/program.h"
#include "interpreter/simple2/text.h"

namespace understudy::interpreter::simple2 {
namespace {

/// Operands that are numbers within a range.
struct NumberKind {
  Operand kind;
  int min;
  int max;
  std::string_view prefix = {};  // precedes the number; optional
  bool is_binary = false;
};

constexpr NumberKind kNumberKinds[] = {
    {Operand::immediate, -128, 127},
    {Operand::input, 0, 10, "DIN_"},
    {Operand::output, 0, 6, "DOUT_"},
    {Operand::output_bits, 0, 0x7F, {}, true},
    {Operand::output_mask, 0, 0x7F, {}, true},
    {Operand::percent, 0, 100},
    {Operand::loop_count, 0, 255},
    {Operand::counter, 1, 2},
    {Operand::timer, 1, 2},
    {Operand::status_bit, 0, 15},
};

const NumberKind* number_kind(Operand kind) {
  for (const NumberKind& row : kNumberKinds) {
    if (row.kind == kind) return &row;
  }
  return nullptr;
}

std::string binary(std::uint8_t value) {
  std::string text = "0b";
  for (int bit = 6; bit >= 0; --bit) text += (value >> bit & 1) != 0 ? '1' : '0';
  return text;
}

}  // namespace

std::vector<OperandField> operand_fields(const Instruction& instruction) {
  std::vector<OperandField> fields;
  if (instruction.data1 != Operand::none) fields.push_back({instruction.data1, true});
  if (instruction.data2 != Operand::none && instruction.data2 != Operand::amount_high) {
    fields.push_back({instruction.data2, false});
  }
  return fields;
}

bool amount_is_signed(const Instruction& instruction) {
  return instruction.opcode != opcode_of("Delay_mSec");
}

ParsedOperand parse_number(std::string_view text, int min, int max) {
  std::string_view digits = text;
  const bool is_negative = digits.starts_with('-');
  if (is_negative || digits.starts_with('+')) digits.remove_prefix(1);
  int base = 10;
  if (!after_prefix(digits, "0x").empty()) base = 16;
  if (!after_prefix(digits, "0b").empty()) base = 2;
  if (base != 10) digits.remove_prefix(2);

  std::uint32_t magnitude = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stopped, error] = std::from_chars(digits.data(), end, magnitude, base);
  const bool is_number = stopped == end && error != std::errc::invalid_argument;
  if (!is_number) return {.problem = quoted(text) + " is not a number"};
  const std::int64_t value = is_negative ? -std::int64_t{magnitude} : std::int64_t{magnitude};
  if (error == std::errc::result_out_of_range || value < min || value > max) {
    return {.problem = std::string(text) + " is out of range"};
  }
  return {.value = static_cast<int>(value), .problem = {}};
}

ParsedOperand parse_operand(Operand kind, std::string_view text) {
  if (kind == Operand::logic) {
    if (same_name(text, "ON") || text == "1") return {.value = 1, .problem = {}};
    if (same_name(text, "OFF") || text == "0") return {.value = 0, .problem = {}};
    return {.problem = quoted(text) + " is not a level"};
  }
  if (kind == Operand::parameter) {
    if (const auto number = parameter_number(text)) return {.value = *number, .problem = {}};
    const ParsedOperand number = parse_number(text, 0, 255);
    const bool is_name = !text.empty() && is_name_start(text.front());
    return is_name ? ParsedOperand{.problem = "no parameter is called " + quoted(text)} : number;
  }
  const NumberKind* const row = number_kind(kind);
  const std::string_view number = row->prefix.empty() ? "" : after_prefix(text, row->prefix);
  ParsedOperand parsed = parse_number(number.empty() ? text : number, row->min, row->max);
  const bool is_name = !text.empty() && is_name_start(text.front());
  if (!parsed.problem.empty() && !number.empty()) parsed.problem = quoted(text) + " does not exist";
  if (!parsed.problem.empty() && number.empty() && is_name) parsed.problem = quoted(text) + " is not valid";
  return parsed;
}

ParsedOperand parse_amount(bool is_signed, std::string_view text) {
  return is_signed ? parse_number(text, -32768, 32767) : parse_number(text, 0, 65535);
}

std::string expected_operand(Operand kind) {
  if (kind == Operand::logic) return "ON or OFF";
  if (kind == Operand::flag) return "a label, JMP1 to JMP64, or @0 to @255";
  if (kind == Operand::parameter) {
    return "MEM0 to MEM31, VAR32 to VAR63, DAT64 to DAT158, DAT167 to DAT182, a register such as Cord_A, or "
           "a "
           "number from 0 to 255";
  }
  const NumberKind* const row = number_kind(kind);
  const std::string prefix(row->prefix);
  return prefix + std::to_string(row->min) + " to " + prefix + std::to_string(row->max);
}

std::string expected_amount(bool is_signed) { return is_signed ? "-32768 to 32767" : "0 to 65535"; }

std::optional<std::string> operand_text(Operand kind, std::uint8_t cell) {
  if (kind == Operand::flag) return flag_text(cell);
  if (kind == Operand::parameter) return parameter_name(cell).value_or(std::to_string(cell));
  if (kind == Operand::logic) {
    if (cell > 1) return std::nullopt;
    return cell == 1 ? "ON" : "OFF";
  }
  const NumberKind* const row = number_kind(kind);
  const int value = row->min < 0 ? static_cast<std::int8_t>(cell) : cell;
  if (value < row->min || value > row->max) return std::nullopt;
  return row->is_binary ? binary(cell) : std::string(row->prefix) + std::to_string(value);
}

std::string flag_text(std::uint8_t cell) {
  const bool is_flag = cell >= 1 && cell <= kFlagCount;
  return (is_flag ? "JMP" : "@") + std::to_string(cell);
}

}  // namespace understudy::interpreter::simple2
