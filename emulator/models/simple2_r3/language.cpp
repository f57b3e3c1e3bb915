#include "emulator/models/simple2_r3/language.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/program_cells.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "emulator/device/program_parts.h"
#include "interpreter/simple2/execution/decisions.h"
#include "interpreter/simple2/instructions.h"
#include "interpreter/simple2/listing.h"
#include "interpreter/simple2/program.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

namespace lang = interpreter::simple2;

constexpr std::array<std::string_view, 2> kOperandCells{"data1", "data2"};

/// The rows of the instructions, and the operands to which they refer.
struct Instructions {
  std::array<std::array<OperandRow, kOperandCells.size()>, lang::kInstructions.size()> operands;
  std::array<InstructionRow, lang::kInstructions.size()> rows;

  Instructions() {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const lang::Instruction& row = lang::kInstructions[i];
      operands[i] = {OperandRow{.name = kOperandCells[0], .values = lang::describe(row.data1)},
                     OperandRow{.name = kOperandCells[1], .values = lang::describe(row.data2)}};
      rows[i] = {
          .opcode = row.opcode, .mnemonic = row.mnemonic, .operands = operands[i], .meaning = row.meaning};
    }
  }
};

std::string code_of(const lang::Line& line) {
  std::string code;
  for (const int cell : {line.command, line.data1, line.data2, line.flag}) code += std::to_string(cell) + ' ';
  return code;
}

class Listing final : public ProgramLanguage, public ProgramCells {
 public:
  std::string_view name() const override { return "Simple2-R3 listing"; }
  std::string_view file_ending() const override { return ".lst"; }
  std::span<const InstructionRow> instructions() const override {
    static const Instructions instructions;
    return instructions.rows;
  }
  std::span<const std::string_view> operand_cells() const override { return kOperandCells; }
  std::vector<ProgramMistake> check(std::string_view text, const DeviceSettings&) const override {
    return mistakes_of(lang::assemble(text));
  }
  std::vector<ProgramPart> parts(std::string_view text, const DeviceSettings&) const override {
    const lang::Assembly assembly = lang::assemble(text);
    if (!assembly.lines) return {};
    ProgramPart part;
    for (std::size_t i = 0; i < assembly.lines->size(); ++i) {
      const lang::Line& line = (*assembly.lines)[i];
      part.lines.push_back({.text_line = assembly.text_lines[i],
                            .code = code_of(line),
                            .decides = lang::decision_of(line.command) != lang::Decision::none});
    }
    return {part};
  }
  std::span<const ProgramControl> controls() const override {
    using By = ProgramControl::By;
    static constexpr std::array<ProgramControl, 2> kControls{
        {{"start at line {}", By::registers, "PROG_MAIN_RunTime_START={}", 0, 255},
         {"stop", By::registers, "PROG_MAIN_RunTime_END=1"}}};
    return kControls;
  }
  const ProgramCells* cells() const override { return this; }

  CellForm cell_form() const override {
    return {.row = "CMD DATA1 DATA2 JMP",
            .fewest = lang::kCellsPerLine,
            .max = lang::kCellsPerLine,
            .lowest = 0,
            .highest = 255,
            .max_rows = lang::kLineCount};
  }
  /// Returns the cells as a host would write them from 0x4000 on. Zero lines at the end are omitted.
  std::vector<CellRow> assemble(std::string_view text, const DeviceSettings&) const override {
    const lang::Assembly assembly = lang::assemble(text);
    if (!assembly.lines) throw ProgramError(mistakes_of(assembly));
    const lang::Lines& lines = *assembly.lines;
    std::size_t count = lines.size();
    while (count > 0 && lines[count - 1] == lang::Line{}) --count;
    std::vector<CellRow> rows(count);
    for (std::size_t i = 0; i < count; ++i) {
      rows[i].cells = {lines[i].command, lines[i].data1, lines[i].data2, lines[i].flag};
    }
    return rows;
  }
  std::string disassemble(const std::vector<CellRow>& rows, const DeviceSettings&) const override {
    lang::Lines lines{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto cell = [&](std::size_t number) { return static_cast<std::uint8_t>(rows[i].cells[number]); };
      lines[i] = {.command = cell(0), .data1 = cell(1), .data2 = cell(2), .flag = cell(3)};
    }
    return lang::disassemble(lines);
  }
};

}  // namespace

const ProgramLanguage& language() {
  static const Listing listing;
  return listing;
}

std::vector<ProgramMistake> mistakes_of(const lang::Assembly& assembly) {
  std::vector<ProgramMistake> mistakes;
  for (const lang::ListingError& error : assembly.errors) {
    mistakes.push_back(
        {error.line, error.column, error.field + ": " + error.what + "; expected " + error.expected});
  }
  return mistakes;
}

}  // namespace understudy::emulator::models::simple2_r3
