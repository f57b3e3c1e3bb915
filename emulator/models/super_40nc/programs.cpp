// A SUPER-40NC's programs: stored as texts, compiled, and their events.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/shared_text.h"
#include "base/text/most_mistakes.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/contact_rows.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/files.h"
#include "emulator/models/super_40nc/language.h"
#include "emulator/models/super_40nc/manual_motions.h"
#include "emulator/models/super_40nc/marks.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/program_machine.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/plc.h"
#include "interpreter/super_40nc/program.h"
#include "interpreter/super_40nc/step_code.h"
#include "interpreter/super_40nc/step_programs.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// Writes one area as text, as it is stored.
std::string text_of_area(language::Area area, const language::AreaProgram& program) {
  language::Program alone;
  alone.areas[language::index_of(area)] = program;
  return language::list(alone);
}

std::optional<language::AreaProgram> stored_area(const TextBlocks& blocks, std::string_view kind,
                                                 std::string_view name, language::Area area,
                                                 const language::Options& options) {
  const SharedText* const text = blocks.find(kind, name);
  if (text == nullptr) return std::nullopt;
  const language::Checked checked = language::check(text->text(), options);
  return checked.program ? checked.program->area(area) : std::nullopt;
}

}  // namespace

void Super40nc::make_programs_ready() {
  const auto texts = state_.blocks.all().find(kPrograms);
  ready_texts_ = texts == state_.blocks.all().end() ? NamedBlocks::mapped_type{} : texts->second;
  ProgramMachine machine(*this);
  std::set<std::int32_t> labels;  // of earlier areas, if labels belong to the first area
  for (const language::AreaRow& row : language::kAreas) {
    const auto stored = stored_area(state_.blocks, kPrograms, row.name, row.area, options_);
    const language::AreaProgram program = stored.value_or(language::AreaProgram{.base = row.base});
    if (row.area == language::Area::plc) {
      ladder_ = std::make_shared<const language::Ladder>(program, machine.layout(), options_);
      find_what_plc_watches();
    } else {
      codes_[language::index_of(row.area)] = language::StepCode(program, labels);
    }
    for (const language::Instruction& line : program.lines) {
      if (options_.labels_are_common && line.op == language::Op::lab) labels.insert(line.fields[0].number);
    }
  }
  if (state_.table.runs != UserTable::Runs::nothing) put_table_in_place();
  show_line_counts();
}

/// Shows in D9036 to D9042 the stored lines, not the capacities, if that is chosen.
void Super40nc::show_line_counts() {
  if (!shows_line_counts()) return;
  const Kept shown[] = {kept_d(d9::kLinesOfC), kept_d(d9::kLinesOfX), kept_d(d9::kLinesOfY),
                        kept_d(d9::kLinesOfZ), kept_d(d9::kLinesOfU), kept_d(d9::kLinesOfPlc)};
  for (const language::AreaRow& row : language::kAreas) {
    const auto program = stored_area(state_.blocks, kPrograms, row.name, row.area, options_);
    std::int32_t count = 0;
    for (const language::Instruction& line : program.value_or(language::AreaProgram{}).lines) {
      count += language::steps_of(line);
    }
    put(shown[language::index_of(row.area)], count);
  }
}

/// Returns the options with D9042, the room of C and of each file.
language::Options Super40nc::options_with_room() const {
  language::Options options = options_;
  if (registers().raw(kept_d(d9::kLinesOfAFile)) > 0) options.c_capacity = room_of_c();  // 0 before power-up
  return options;
}

/// Returns true if a stored program has more lines than D9042 allows.
bool Super40nc::is_too_long(std::string_view kind, std::string_view name) const {
  const auto program = stored_area(state_.blocks, kind, name, language::Area::c, options_);
  if (!program) return false;
  std::int64_t length = 0;
  for (const language::Instruction& line : program->lines) {
    length += options_.capacity == language::Options::Capacity::lines ? 1 : language::steps_of(line);
  }
  return length > options_with_room().c_capacity;
}

std::vector<ProgramMistake> Super40nc::mistakes_in(std::string_view text) const {
  return mistakes_of(language::check(text, options_with_room()));
}

std::vector<ProgramMistake> Super40nc::warnings_about(std::string_view text) const {
  const language::Checked checked = language::check(text, options_with_room());
  std::vector<language::Diagnostic> all = checked.warnings;
  all.insert(all.end(), checked.notes.begin(), checked.notes.end());
  leave_first(all);
  std::vector<ProgramMistake> warnings;
  for (const language::Diagnostic& one : all) warnings.push_back({one.line, one.column, one.message()});
  return warnings;
}

void Super40nc::load_program(std::string_view text) {
  if (powered() && registers().is_on(kept_d(d9::kEditLock)) &&
      chose(option("edit_lock", "d9021_refuses_programs"))) {
    throw ProgramError(0, 0, "D9021 (C15) locks programs; expected 0 there");
  }
  const language::Checked checked = language::check(text, options_with_room());
  if (!checked.program) {
    const language::Diagnostic& first = checked.errors.front();
    state_.error = {.code = first.code, .step = first.step, .other_step = first.other_step, .tick = now()};
    throw ProgramError(mistakes_of(checked));
  }
  const bool runs = state_.plc.runs;
  const bool has_plc = checked.program->area(language::Area::plc).has_value();
  if (has_plc) {  // its jogs stop, even if the new program never scans
    ProgramMachine machine(*this);
    language::stop(state_.plc, machine);
  }
  for (const language::AreaRow& row : language::kAreas) {
    const auto& area = checked.program->area(row.area);
    if (!area) continue;
    if (row.area != language::Area::plc) give_up_program(row.area);
    if (row.area == language::Area::c) state_.file_is_left_out = false;
    if (area->lines.empty()) {
      state_.blocks.erase(kPrograms, row.name);
    } else {
      state_.blocks.put(kPrograms, std::string(row.name), SharedText(text_of_area(row.area, *area)));
    }
  }
  for (const auto& [number, file] : checked.program->files) {
    state_.blocks.put(kFiles, std::to_string(number), SharedText(text_of_area(language::Area::c, file)));
  }
  make_programs_ready();
  if (has_plc && runs) plc_to_run();
  // Labels may belong to areas that the text does not name.
  const language::Checked all =
      options_.labels_are_common ? language::check(program_text(), options_with_room()) : language::Checked{};
  const auto& warnings = all.warnings.empty() ? checked.warnings : all.warnings;
  if (!warnings.empty()) {
    const language::Diagnostic& first = warnings.front();
    report({.code = first.code, .step = first.step, .other_step = first.other_step});
  }
  state_.touched = true;
}

std::string Super40nc::program_text() const {
  language::Program all;
  for (const language::AreaRow& row : language::kAreas) {
    all.areas[language::index_of(row.area)] =
        stored_area(state_.blocks, kPrograms, row.name, row.area, options_);
  }
  for (const auto& [kind, entries] : state_.blocks.all()) {
    if (kind != kFiles) continue;
    for (const auto& [name, text] : entries) {
      const auto file = stored_area(state_.blocks, kFiles, name, language::Area::c, options_);
      if (file) all.files[std::stoi(name)] = *file;
    }
  }
  return language::list(all);
}

/// Prepares an area for a new program: only the axes that the old one moves stop.
void Super40nc::give_up_program(language::Area area) {
  stop_all_of(static_cast<Mover>(area));
  ProgramMachine machine(*this);
  language::StepPrograms(state_.steps, codes_, machine, options_).unload(area);
}

void Super40nc::tell(language::Event event, language::Area area) {
  ProgramMachine machine(*this);
  language::StepPrograms(state_.steps, codes_, machine, options_).take(event, area);
}

bool Super40nc::is_pausing() const {
  const auto pauses = [](const language::StepState& program) {
    const bool rests = program.phase == language::Phase::paused || program.phase == language::Phase::held;
    return rests && program.is_paused_by_key;
  };
  const auto& all = state_.steps.programs;
  const bool rests = all[0].phase == language::Phase::paused || all[0].phase == language::Phase::held;
  if (rests && chose(option("m8022_scope", "c_also_by_m8000"))) return true;
  if (!chose(option("m8022_scope", "every_program"))) return pauses(all[0]);
  return std::any_of(all.begin(), all.end(), pauses);
}

int Super40nc::shown_base(std::size_t program) const {
  const bool is_absolute = chose(option("step_numbers_relative", "absolute"));
  return is_absolute ? language::base_of(static_cast<language::Area>(program), options_) : 0;
}

std::int32_t Super40nc::shown_step(std::size_t program) const {
  const language::StepState& steps = state_.steps.programs[program];
  const bool moves = steps.phase == language::Phase::moving || steps.phase == language::Phase::homing;
  const bool shows_next = moves && chose(option("step_shown", "the_next_ones"));
  return shown_base(program) + (shows_next ? steps.next_step : steps.step);
}

void Super40nc::set_pointer(int program, std::int32_t step) {
  ProgramMachine machine(*this);
  language::StepPrograms(state_.steps, codes_, machine, options_)
      .set_step(static_cast<language::Area>(program), step);
}

/// "plc 初始": programs that do not run begin anew.
void Super40nc::plc_to_run() {
  ProgramMachine machine(*this);
  language::run(state_.plc, *ladder_, machine, options_);
  language::StepPrograms steps(state_.steps, codes_, machine, options_);
  for (const language::AreaRow& row : language::kAreas) {
    if (row.area == language::Area::plc || chose(option("run_resets_steps", "stay"))) continue;
    steps.take(language::Event::plc_run, row.area);
    steps.set_step(row.area, 0);
  }
  clear_error();
  for (AxisState& state : state_.axes) take_off(state, MarkEvent::plc_run);
}

void Super40nc::plc_to_stop() {
  ProgramMachine machine(*this);
  language::stop(state_.plc, machine);
  for (int number = 0; number < kAxisCount; ++number) handle(number, ManualEvent::plc_stop);
  if (chose(option("plc_stop_timers", "are_cleared"))) clear_timers();
  if (!chose(option("plc_stop_outputs", "off"))) return;
  const std::span outputs = std::span(state_.image).subspan(kFirstY.slot, kOutputCount);
  std::fill(outputs.begin(), outputs.end(), 0U);
}

/// Clears values and contacts of timers that are not latched.
void Super40nc::clear_timers() {
  for (int i = 0; i < kTimers; ++i) {
    put({.slot = kept_at(Table::coil, kFirstTimerContact).slot + static_cast<std::size_t>(i)}, 0);
    put({.slot = kept_at(Table::holding, kFirstTimerValue).slot + static_cast<std::size_t>(i)}, 0);
  }
}

int Super40nc::line_step(Mover mover) const {
  if (mover >= Mover::plc) return mover == Mover::plc ? plc_step_ : 0;
  const auto area = static_cast<language::Area>(mover);
  const language::StepState& program = state_.steps.programs[language::index_of(area)];
  return program.phase == language::Phase::idle ? 0 : language::base_of(area, options_) + program.step;
}

void Super40nc::program_broken(Mover mover, int axis, bool is_awaited, motion::Cause why) {
  break_program(mover, axis);
  const auto area = static_cast<language::Area>(mover);
  const language::Phase phase = state_.steps.programs[language::index_of(area)].phase;
  // A motion beside the lines also resets a running program; a program that is over is left alone.
  const bool runs_on = !is_awaited && phase != language::Phase::idle;
  const bool is_limit = why == motion::Cause::limit_plus || why == motion::Cause::limit_minus;
  const bool is_soft = why == motion::Cause::soft_limit_plus || why == motion::Cause::soft_limit_minus;
  const bool pauses =
      (is_limit && chose(option("el_resets", "pauses_at_the_line"))) ||
      (is_soft && chose(option("soft_limit_resets", "pauses_at_the_line"))) ||
      (why == motion::Cause::alarm && chose(option("alm_resets", "pauses_at_the_line"))) ||
      (why == motion::Cause::comparator && chose(option("comparator_resets", "pauses_at_the_line")));
  if (pauses && !runs_on) return tell(language::Event::limit_pauses, area);
  if (pauses) return;
  tell(runs_on ? language::Event::stop : language::Event::broken, area);
}

void Super40nc::flash_written(bool is_recipe) {
  constexpr Tick kFlashTicks = 100;
  state_.touched = true;
  if (!is_recipe || !chose(option("m8023_scope", "files_alone"))) state_.file_changed = true;
  if (chose(option("flash_time", "100_ms_without_a_scan"))) state_.flash_until = now() + 1 + kFlashTicks;
}

/// Saves the C program in memory, and loads that of another file.
void Super40nc::change_file(std::int32_t number) {
  if (chose(option("file_number_range", "nearest_one"))) {
    number = std::clamp(number, 0, std::max(registers().raw(kept_d(d9::kFileCount)) - 1, 0));
    put(kept_d(d9::kFileNumber), number);
  }
  if (number < 0 || number >= registers().raw(kept_d(d9::kFileCount))) {
    put(kept_d(d9::kFileNumber), state_.file);
    report(Code::no_such_file);
    return;
  }
  if (number == state_.file) return;
  const bool c_runs = state_.steps.programs[0].phase != language::Phase::idle;
  if (c_runs && chose(option("file_change_running", "refused"))) {
    put(kept_d(d9::kFileNumber), state_.file);
    report(Code::no_such_file);
    return;
  }
  if (c_runs && chose(option("file_change_running", "resets_c"))) {
    tell(language::Event::stop, language::Area::c);
  }
  const std::string c(language::row_of(language::Area::c).name);
  const auto copy = [&](std::string_view from, const std::string& from_name, std::string_view to,
                        const std::string& to_name) {
    const SharedText* const text = state_.blocks.find(from, from_name);
    if (text == nullptr) {
      state_.blocks.erase(to, to_name);
    } else {
      state_.blocks.put(to, to_name, *text);
    }
  };
  // A file that was too long to load stays unchanged.
  const std::string left = std::to_string(state_.file);
  if (!state_.file_is_left_out) copy(kPrograms, c, kFiles, left);
  state_.file_is_left_out = is_too_long(kFiles, std::to_string(number));
  if (state_.file_is_left_out) {
    state_.blocks.erase(kPrograms, c);
    report(Code::memory_full);
  } else {
    copy(kFiles, std::to_string(number), kPrograms, c);
  }
  state_.file = number;
  make_programs_ready();
  tell(language::Event::file_changed, language::Area::c);
  flash_written(false);
}

}  // namespace understudy::emulator::models::super_40nc
