// Loads programs, and replaces them with those of a file or of the user table.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/programs/files.h"
#include "emulator/models/super_40nc/programs/program_machine.h"
#include "emulator/models/super_40nc/programs/programs.h"
#include "emulator/models/super_40nc/programs/user_table.h"
#include "emulator/models/super_40nc/rows/data_rows.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/ladder.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/program.h"
#include "interpreter/super_40nc/step_code.h"
#include "interpreter/super_40nc/step_programs.h"

namespace understudy::emulator::models::super_40nc {

namespace {

constexpr std::int32_t kFirstCommand = 100;  // the offset of commands in D8020

}  // namespace

void Programs::make_programs_ready() {
  const auto texts = state_.blocks.all().find(kPrograms);
  ready_texts_ = texts == state_.blocks.all().end() ? NamedBlocks::mapped_type{} : texts->second;
  ProgramMachine machine(*this, controls_);
  std::set<std::int32_t> labels;  // labels of earlier areas, if a label belongs to the first area
  for (const language::AreaRow& row : language::kAreas) {
    const language::AreaProgram program =
        stored_.area(kPrograms, row.name, row.area).value_or(language::AreaProgram{.base = row.base});
    if (row.area == language::Area::plc) {
      ladder_ = std::make_shared<const language::Ladder>(program, machine.layout(), options_);
      watch_.find(*ladder_);
    } else {
      codes_[language::index_of(row.area)] = language::StepCode(program, labels);
    }
    for (const language::Instruction& line : program.lines) {
      if (options_.chose(language::option("label_scope", "the_first_area_has_it")) &&
          line.op == language::Op::lab)
        labels.insert(line.fields[0].number);
    }
  }
  if (state_.table.runs != UserTable::Runs::nothing) put_table_in_place();
  stored_.show_line_counts();
  notify_watch();
}

void Programs::load_program(std::string_view text) {
  if (ground_.powered() && registers().is_on(stored_d(d9::kEditLock)) &&
      chose(option("edit_lock", "d9021_refuses_programs"))) {
    throw ProgramError(0, 0, "D9021 (C15) locks programs; expected 0");
  }
  const language::Checked checked = stored_.check(text);
  if (!checked.program) {
    const language::Diagnostic& first = checked.errors.front();
    ground_.state().error = {
        .code = first.code, .step = first.step, .other_step = first.other_step, .tick = now()};
    throw ProgramError(mistakes_of(checked));
  }
  const bool runs = state_.plc.runs;
  const bool has_plc = checked.program->area(language::Area::plc).has_value();
  if (has_plc) {  // the old program's jogs stop, even if the new program never scans
    ProgramMachine machine(*this, controls_);
    language::stop(state_.plc, machine);
  }
  for (const language::AreaRow& row : language::kAreas) {
    const bool is_replaced = checked.program->area(row.area).has_value();
    if (is_replaced && row.area != language::Area::plc) give_up_program(row.area);
  }
  stored_.store(*checked.program);
  make_programs_ready();
  if (has_plc && runs) plc_to_run();
  // Labels may belong to areas that the text does not contain.
  const language::Checked all = options_.chose(language::option("label_scope", "the_first_area_has_it"))
                                    ? stored_.check(stored_.program_text())
                                    : language::Checked{};
  const auto& warnings = all.warnings.empty() ? checked.warnings : all.warnings;
  if (!warnings.empty()) {
    const language::Diagnostic& first = warnings.front();
    ground_.report({.code = first.code, .step = first.step, .other_step = first.other_step});
  }
  ground_.touch();
}

/// Prepares an area for a new program: only the axes that the old program moves stop.
void Programs::give_up_program(language::Area area) {
  controls_.moves.stop_all_of(static_cast<Mover>(area));
  ProgramMachine machine(*this, controls_);
  language::StepPrograms(state_.steps, codes_, machine, options_).unload(area);
}

void Programs::change_file(std::int32_t number) {
  if (chose(option("file_number_range", "nearest_one"))) {
    number = std::clamp(number, 0, std::max(registers().raw(stored_d(d9::kFileCount)) - 1, 0));
    ground_.put(stored_d(d9::kFileNumber), number);
  }
  if (number < 0 || number >= registers().raw(stored_d(d9::kFileCount))) {
    ground_.put(stored_d(d9::kFileNumber), state_.file);
    report(Code::no_such_file);
    return;
  }
  if (number == state_.file) return;
  const bool c_runs = state_.steps.programs[0].phase != language::Phase::idle;
  if (c_runs && chose(option("file_change_running", "refused"))) {
    ground_.put(stored_d(d9::kFileNumber), state_.file);
    report(Code::no_such_file);
    return;
  }
  if (c_runs && chose(option("file_change_running", "resets_c"))) {
    handle(language::Event::stop, language::Area::c);
  }
  stored_.change_c(number);
  make_programs_ready();
  handle(language::Event::file_changed, language::Area::c);
  stored_.flash_written(false);
}

void Programs::restored() {
  const auto texts = state_.blocks.all().find(kPrograms);
  const bool has_texts = texts != state_.blocks.all().end();
  const bool are_ready = has_texts ? texts->second == ready_texts_ : ready_texts_.empty();
  const bool has_table = state_.table.runs != UserTable::Runs::nothing || !table_lines_.empty();
  if (!are_ready || has_table) make_programs_ready();
}

void Programs::take_user_command(std::int32_t number) {
  if (number < kFirstCommand || !chose(option("user_table", "on"))) return;
  ground_.put(stored_d(d8::kUserCommand), 0);
  if (state_.steps.programs[0].phase != language::Phase::idle) return report(Code::axis_taken);
  const bool is_table = number == kFirstCommand;
  const auto image = std::span<const std::uint32_t>(ground_.state().image);
  std::vector<std::uint32_t> words;
  if (is_table) {
    const auto lines =
        image.subspan(stored_at(Table::holding, kFirstUserAddress).slot, kTableLines * kWordsOfATableLine);
    words.assign(lines.begin(), lines.end());
  } else {
    const auto data = image.subspan(stored_d(d8::kUserData1).slot, kWordsOfATableLine - 1);
    words.push_back(static_cast<std::uint32_t>(number - kFirstCommand));
    words.insert(words.end(), data.begin(), data.end());
  }
  state_.table = {.runs = is_table ? UserTable::Runs::table : UserTable::Runs::command,
                  .words = std::move(words)};
  put_table_in_place();
  const language::StepState before = state_.steps.programs[0];
  const Settings settings = registers();
  const std::int32_t feed = settings.raw(stored_d(d8::kFeed));
  const std::int32_t plane = settings.raw(stored_d(d8::kPlane));
  handle(language::Event::start, language::Area::c);
  if (!is_table && before.has_modes) {  // F and RPM apply to later commands
    language::StepState& program = state_.steps.programs[0];
    program.targets = before.targets;
    program.rpm = before.rpm;
    program.waits_for_drive = before.waits_for_drive;
    ground_.put(stored_d(d8::kFeed), feed);
    ground_.put(stored_d(d8::kPlane), plane);
  }
  ground_.touch();
  leave_table();  // in case the table did not start
}

void Programs::put_table_in_place() {
  TableProgram made = program_of_table(state_.table.words);
  codes_[0] = language::StepCode(made.program);
  table_lines_ = std::move(made.table_lines);
}

void Programs::leave_table() {
  if (state_.table.runs == UserTable::Runs::nothing) return;
  if (state_.steps.programs[0].phase != language::Phase::idle) return;
  state_.table = {};
  make_programs_ready();
}

std::int32_t Programs::table_line() const {
  if (state_.table.runs != UserTable::Runs::table) return 0;
  const int line = codes_[0].line_at(state_.steps.programs[0].step);
  return line < 0 ? 0 : table_lines_[static_cast<std::size_t>(line)];
}

}  // namespace understudy::emulator::models::super_40nc
