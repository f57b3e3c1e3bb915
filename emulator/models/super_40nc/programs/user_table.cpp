#include "emulator/models/super_40nc/programs/user_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "emulator/models/super_40nc/programs/program_machine.h"
#include "emulator/models/super_40nc/rows/contact_rows.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/operand.h"

namespace understudy::emulator::models::super_40nc {

namespace {

using language::Instruction;
using language::Letter;
using language::Op;
using language::Operand;

constexpr std::uint32_t kUnset = 0x8000'0000;
constexpr std::uint32_t kNoCoil = 0x1'0000;  // an address that no frame can have

struct CommandRow {
  Op op;
  int max_data;
  bool needs_first = false;
  bool names_coils = false;
};
/// Commands 1 to 10.
constexpr std::array<CommandRow, 10> kCommands{{{Op::lin, 4},
                                                {Op::cw, 4},
                                                {Op::ccw, 4},
                                                {Op::drv, 4},
                                                {Op::f, 1, true},
                                                {Op::rpm, 4},
                                                {Op::tmr, 1, true},
                                                {Op::hom, 4},
                                                {Op::set, 4, true, true},
                                                {Op::rst, 4, true, true}}};

/// Returns the Y, M or M8 at an address, or an unset operand if there is none.
Operand coil_at(std::uint32_t address) {
  const auto number = static_cast<std::int32_t>(std::min(address, kNoCoil));
  Operand coil;
  if (number < kOutputCount) coil = {Letter::y, number};
  if (number >= relay_address(0) && number < relay_address(kFirstSpecialContact))
    coil = {Letter::m, number - relay_address(0)};
  if (number >= relay_address(kFirstSpecialContact))
    coil = {Letter::m, number - relay_address(kFirstSpecialContact) + kFirstSpecialContact};
  return language::block_of(coil) != nullptr ? coil : Operand{};
}

/// Returns the instructions of a line, or none if the line cannot run.
std::vector<Instruction> instructions_of(std::span<const std::uint32_t> line) {
  const std::uint32_t number = line[0];
  if (number < 1 || number > kCommands.size()) return {};
  const CommandRow& command = kCommands[number - 1];
  const auto data = line.subspan(1, static_cast<std::size_t>(command.max_data));
  if (command.needs_first && data[0] == kUnset) return {};
  std::vector<Instruction> made;
  if (!command.names_coils) made.push_back({.op = command.op});
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (data[i] == kUnset) continue;
    if (!command.names_coils) {
      made[0].fields[i] = {Letter::k, static_cast<std::int32_t>(data[i])};
      continue;
    }
    const Operand coil = coil_at(data[i]);
    if (!coil.is_set()) return {};
    Instruction switches{.op = command.op};
    switches.fields[0] = coil;
    made.push_back(switches);
  }
  return made;
}

}  // namespace

TableProgram program_of_table(std::span<const std::uint32_t> words) {
  TableProgram made;
  const auto add = [&](const Instruction& instruction, int line) {
    made.program.lines.push_back(instruction);
    made.table_lines.push_back(line);
  };
  int number = 0;
  for (; words.size() >= kWordsOfATableLine; ++number, words = words.subspan(kWordsOfATableLine)) {
    if (words[0] == 0) break;
    const std::vector<Instruction> instructions = instructions_of(words);
    // A program needs at least one line.
    if (instructions.empty() && number == 0) add({.op = Op::nop}, number);
    if (instructions.empty()) return made;
    for (const Instruction& each : instructions) add(each, number);
  }
  add({.op = Op::end}, number);
  return made;
}

}  // namespace understudy::emulator::models::super_40nc
