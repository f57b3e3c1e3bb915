#include <cstddef>
#include <string>

#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/instructions.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {
namespace {

void list_area(std::string& text, const std::string& head, int own_base, const AreaProgram& program) {
  text += head;
  if (program.base != own_base) text += " BASE " + std::to_string(program.base);
  text += '\n';
  int step = program.base;
  for (const Instruction& line : program.lines) {
    text += std::to_string(step) + ' ' + text_of(line) + '\n';
    step += steps_of(line);
  }
}

}  // namespace

std::string text_of(Operand operand) {
  std::string text(name_of(operand.letter));
  if (operand.is_set()) text += std::to_string(operand.number);
  return text;
}

std::string text_of(const Instruction& instruction) {
  const InstructionRow& row = row_of(instruction.op);
  std::string text(instruction.op == Op::out_tc ? "OUT" : row.mnemonic);
  int count = 0;
  for (std::size_t i = 0; i < instruction.fields.size(); ++i) {
    if (instruction.fields[i].is_set()) count = static_cast<int>(i) + 1;
  }
  if (count == 0) count = row.fields();  // "STP * * * *"
  for (int i = 0; i < count; ++i) text += ' ' + text_of(instruction.fields[static_cast<std::size_t>(i)]);
  return text;
}

std::string list(const Program& program) {
  std::string text;
  for (const AreaRow& row : kAreas) {
    if (const auto& area = program.area(row.area)) {
      list_area(text, "AREA " + std::string(row.name), row.base, *area);
    }
  }
  for (const auto& [number, file] : program.files) {
    list_area(text, "FILE " + std::to_string(number), row_of(Area::c).base, file);
  }
  return text;
}

std::string to_string(const Diagnostic& diagnostic) {
  return std::to_string(diagnostic.line) + ':' + std::to_string(diagnostic.column) + ": " +
         diagnostic.message();
}

}  // namespace understudy::interpreter::super_40nc
