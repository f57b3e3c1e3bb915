#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "interpreter/simple2/instructions.h"
#include "interpreter/simple2/listing.h"
#include "interpreter/simple2/operand_text.h"
#include "interpreter/simple2/program.h"

namespace understudy::interpreter::simple2 {
namespace {

constexpr std::size_t kLabelWidth = 8;
/// `.at` replaces gaps of at least this many lines of zeros.
constexpr int kLongGap = 4;

std::string padded(std::string text) {
  text.resize(std::max(text.size(), kLabelWidth), ' ');
  return text;
}

/// Returns "Loop JMP1 3", or nothing if this form cannot express a cell.
std::optional<std::string> instruction_text(const Line& line) {
  const Instruction* const instruction = find_instruction(line.command);
  if (instruction == nullptr) return std::nullopt;
  if (instruction->data1 == Operand::none && line.data1 != 0) return std::nullopt;
  if (instruction->data2 == Operand::none && line.data2 != 0) return std::nullopt;

  std::string text(instruction->mnemonic);
  if (instruction->data1 == Operand::amount_low) {
    const int amount = line.data1 | line.data2 << 8;
    const bool is_signed = amount_is_signed(*instruction);
    return text + ' ' + std::to_string(is_signed ? static_cast<std::int16_t>(amount) : amount);
  }
  for (const OperandField& field : operand_fields(*instruction)) {
    const auto operand = operand_text(field.kind, field.is_data1 ? line.data1 : line.data2);
    if (!operand) return std::nullopt;
    text += ' ' + *operand;
  }
  return text;
}

std::string cells_text(const Line& line) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string text = ".line 0x";
  text += kDigits[line.command / 16];
  text += kDigits[line.command % 16];
  for (const int cell : {line.data1, line.data2, line.flag}) text += ' ' + std::to_string(cell);
  const Instruction* const instruction = find_instruction(line.command);
  if (instruction != nullptr) text += "  ; " + std::string(instruction->mnemonic);
  return text;
}

/// Labels the line to which the flag leads. Other lines with the same flag only show their cell.
std::string mark_text(const Program& program, int number) {
  const std::uint8_t flag = program.line(number).flag;
  if (flag == 0) return {};
  const bool has_it = program.line_with_flag(flag) == number;
  return has_it ? flag_text(flag) + ':' : '@' + std::to_string(flag);
}

}  // namespace

std::string disassemble(const Lines& lines) {
  const Program program(lines);
  std::string text;
  int next = 0;  // the next line that the text would fill
  for (int number = 0; number < kLineCount; ++number) {
    const Line& line = program.line(number);
    if (line == Line{}) continue;
    if (number - next >= kLongGap) {
      text += padded({}) + ".at " + std::to_string(number) + '\n';
      next = number;
    }
    for (; next < number; ++next) text += padded({}) + "NOP\n";
    const auto instruction = instruction_text(line);
    text += instruction ? padded(mark_text(program, number)) + *instruction : padded({}) + cells_text(line);
    text += '\n';
    next = number + 1;
  }
  return text;
}

}  // namespace understudy::interpreter::simple2
