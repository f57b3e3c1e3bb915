#include "emulator/models/super_40nc/user_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/contact_rows.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/program_machine.h"  // IWYU pragma: keep (namespace language)
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "emulator/models/super_40nc/settings.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/program.h"
#include "interpreter/super_40nc/step_code.h"
#include "interpreter/super_40nc/step_programs.h"

namespace understudy::emulator::models::super_40nc {

namespace {

using language::Instruction;
using language::Letter;
using language::Op;
using language::Operand;

constexpr std::uint32_t kUnset = 0x8000'0000;
constexpr std::int32_t kFirstCommand = 100;  // of D8020
constexpr std::uint32_t kNoCoil = 0x1'0000;  // an address that no frame can have

struct CommandRow {
  Op op;
  int most_data;
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

/// Returns Y, M or M8 at an address; unset if there is none.
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

/// Returns the instructions of a line; none if it cannot run.
std::vector<Instruction> instructions_of(std::span<const std::uint32_t> line) {
  const std::uint32_t number = line[0];
  if (number < 1 || number > kCommands.size()) return {};
  const CommandRow& command = kCommands[number - 1];
  const auto data = line.subspan(1, static_cast<std::size_t>(command.most_data));
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
    // a program needs at least one line
    if (instructions.empty() && number == 0) add({.op = Op::nop}, number);
    if (instructions.empty()) return made;
    for (const Instruction& each : instructions) add(each, number);
  }
  add({.op = Op::end}, number);
  return made;
}

void Super40nc::take_user_command(std::int32_t number) {
  if (number < kFirstCommand || !chose(option("user_table", "on"))) return;
  put(kept_d(d8::kUserCommand), 0);
  if (state_.steps.programs[0].phase != language::Phase::idle) return report(Code::axis_taken);
  const bool is_table = number == kFirstCommand;
  const auto image = std::span<const std::uint32_t>(state_.image);
  std::vector<std::uint32_t> words;
  if (is_table) {
    const auto lines =
        image.subspan(kept_at(Table::holding, kFirstUserAddress).slot, kTableLines * kWordsOfATableLine);
    words.assign(lines.begin(), lines.end());
  } else {
    const auto data = image.subspan(kept_d(d8::kUserData1).slot, kWordsOfATableLine - 1);
    words.push_back(static_cast<std::uint32_t>(number - kFirstCommand));
    words.insert(words.end(), data.begin(), data.end());
  }
  state_.table = {.runs = is_table ? UserTable::Runs::table : UserTable::Runs::command,
                  .words = std::move(words)};
  put_table_in_place();
  const language::StepState before = state_.steps.programs[0];
  const Settings settings = registers();
  const std::int32_t feed = settings.raw(kept_d(d8::kFeed));
  const std::int32_t plane = settings.raw(kept_d(d8::kPlane));
  tell(language::Event::start, language::Area::c);
  if (!is_table && before.has_modes) {  // F and RPM apply to later commands
    language::StepState& program = state_.steps.programs[0];
    program.targets = before.targets;
    program.rpm = before.rpm;
    program.waits_for_drive = before.waits_for_drive;
    put(kept_d(d8::kFeed), feed);
    put(kept_d(d8::kPlane), plane);
  }
  state_.touched = true;
  leave_table();  // if it did not start
}

void Super40nc::put_table_in_place() {
  TableProgram made = program_of_table(state_.table.words);
  codes_[0] = language::StepCode(made.program);
  table_lines_ = std::move(made.table_lines);
}

/// Restores C's own program when the table is over.
void Super40nc::leave_table() {
  if (state_.table.runs == UserTable::Runs::nothing) return;
  if (state_.steps.programs[0].phase != language::Phase::idle) return;
  state_.table = {};
  make_programs_ready();
}

std::int32_t Super40nc::table_line() const {
  if (state_.table.runs != UserTable::Runs::table) return 0;
  const int line = codes_[0].line_at(state_.steps.programs[0].step);
  return line < 0 ? 0 : table_lines_[static_cast<std::size_t>(line)];
}

}  // namespace understudy::emulator::models::super_40nc
