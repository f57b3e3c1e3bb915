#include "emulator/models/super_40nc/programs/stored_programs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/shared_text.h"
#include "base/text/most_mistakes.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/programs/files.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"
#include "interpreter/super_40nc/structure.h"

namespace understudy::emulator::models::super_40nc {

namespace language = interpreter::super_40nc;

namespace {

/// Returns an area as text, in the form in which it is stored.
std::string text_of_area(language::Area area, const language::AreaProgram& program) {
  language::Program alone;
  alone.areas[language::index_of(area)] = program;
  return language::list(alone);
}

}  // namespace

std::vector<ProgramMistake> mistakes_of(const language::Checked& checked) {
  std::vector<ProgramMistake> mistakes;
  for (const language::Diagnostic& error : checked.errors) {
    mistakes.push_back({error.line, error.column, error.message()});
  }
  return mistakes;
}

void StoredPrograms::show_line_counts() {
  if (!shows_line_counts()) return;
  const StoredRegister shown[] = {stored_d(d9::kLinesOfC), stored_d(d9::kLinesOfX),
                                  stored_d(d9::kLinesOfY), stored_d(d9::kLinesOfZ),
                                  stored_d(d9::kLinesOfU), stored_d(d9::kLinesOfPlc)};
  for (const language::AreaRow& row : language::kAreas) {
    const auto program = area(kPrograms, row.name, row.area);
    std::int32_t count = 0;
    for (const language::Instruction& line : program.value_or(language::AreaProgram{}).lines) {
      count += language::steps_of(line);
    }
    ground_.put(shown[language::index_of(row.area)], count);
  }
}

/// Returns the options, including the capacity of C and of each file.
language::Options StoredPrograms::options_with_room() const {
  language::Options options = options_;
  if (registers().raw(stored_d(d9::kLinesOfAFile)) > 0)
    options.c_capacity = room_of_c();  // 0 before power-up
  return options;
}

bool StoredPrograms::is_too_long(std::string_view kind, std::string_view name) const {
  const auto program = area(kind, name, language::Area::c);
  if (!program) return false;
  std::int64_t length = 0;
  for (const language::Instruction& line : program->lines) {
    length += options_.chose(language::option("capacity_unit", "lines")) ? 1 : language::steps_of(line);
  }
  return length > options_with_room().c_capacity;
}

language::Checked StoredPrograms::check(std::string_view text) const {
  return language::check(text, options_with_room());
}

std::optional<language::AreaProgram> StoredPrograms::area(std::string_view kind, std::string_view name,
                                                          Area area) const {
  const SharedText* const text = state_.blocks.find(kind, name);
  if (text == nullptr) return std::nullopt;
  const language::Checked checked = language::check(text->text(), options_);
  return checked.program ? checked.program->area(area) : std::nullopt;
}

void StoredPrograms::store(const language::Program& program) {
  for (const language::AreaRow& row : language::kAreas) {
    const auto& area = program.area(row.area);
    if (!area) continue;
    if (row.area == language::Area::c) state_.file_is_left_out = false;
    if (area->lines.empty()) {
      state_.blocks.erase(kPrograms, row.name);
    } else {
      state_.blocks.put(kPrograms, std::string(row.name), SharedText(text_of_area(row.area, *area)));
    }
  }
  for (const auto& [number, file] : program.files) {
    state_.blocks.put(kFiles, std::to_string(number), SharedText(text_of_area(language::Area::c, file)));
  }
}

/// Copies a text. If the text does not exist, erases the target.
void StoredPrograms::copy(std::string_view from, const std::string& from_name, std::string_view to,
                          const std::string& to_name) {
  const SharedText* const text = state_.blocks.find(from, from_name);
  if (text == nullptr) {
    state_.blocks.erase(to, to_name);
  } else {
    state_.blocks.put(to, to_name, *text);
  }
}

void StoredPrograms::change_c(std::int32_t number) {
  const std::string c(language::row_of(language::Area::c).name);
  // A file that was too long to load does not change.
  if (!state_.file_is_left_out) copy(kPrograms, c, kFiles, std::to_string(state_.file));
  state_.file_is_left_out = is_too_long(kFiles, std::to_string(number));
  if (state_.file_is_left_out) {
    state_.blocks.erase(kPrograms, c);
    report(Code::memory_full);
  } else {
    copy(kFiles, std::to_string(number), kPrograms, c);
  }
  state_.file = number;
}

std::vector<ProgramMistake> StoredPrograms::mistakes_in(std::string_view text) const {
  return mistakes_of(check(text));
}

std::vector<ProgramPart> StoredPrograms::parts_of(std::string_view text) const {
  const language::Checked checked = check(text);
  std::vector<ProgramPart> parts;
  if (!checked.program) return parts;
  const auto add = [&](const std::string& name, Area area, const language::AreaProgram& program,
                       const std::vector<int>& text_lines) {
    ProgramPart& part =
        parts.emplace_back(ProgramPart{.number = static_cast<int>(area), .name = name, .lines = {}});
    for (std::size_t i = 0; i < program.lines.size(); ++i) {
      const language::Instruction& line = program.lines[i];
      // A NOP in the PLC is skipped during compilation.
      const bool is_left_out = area == Area::plc && line.op == language::Op::nop;
      part.lines.push_back({.text_line = is_left_out ? 0 : text_lines[i],
                            .code = language::text_of(line),
                            .decides = language::decides(line.op)});
    }
  };
  for (const language::AreaRow& row : language::kAreas) {
    const std::size_t index = language::index_of(row.area);
    const auto& program = checked.program->areas[index];
    if (program) add(std::string(row.name), row.area, *program, checked.area_lines[index]);
  }
  for (const auto& [number, program] : checked.program->files) {
    add("FILE " + std::to_string(number), Area::c, program, checked.file_lines.at(number));
  }
  return parts;
}

std::vector<ProgramMistake> StoredPrograms::warnings_about(std::string_view text) const {
  const language::Checked checked = check(text);
  std::vector<language::Diagnostic> all = checked.warnings;
  all.insert(all.end(), checked.notes.begin(), checked.notes.end());
  leave_first(all);
  std::vector<ProgramMistake> warnings;
  for (const language::Diagnostic& one : all) warnings.push_back({one.line, one.column, one.message()});
  return warnings;
}

std::string StoredPrograms::program_text() const {
  language::Program all;
  for (const language::AreaRow& row : language::kAreas) {
    all.areas[language::index_of(row.area)] = area(kPrograms, row.name, row.area);
  }
  for (const auto& [kind, entries] : state_.blocks.all()) {
    if (kind != kFiles) continue;
    for (const auto& [name, text] : entries) {
      const auto file = area(kFiles, name, language::Area::c);
      if (file) all.files[std::stoi(name)] = *file;
    }
  }
  return language::list(all);
}

void StoredPrograms::flash_written(bool is_recipe) {
  constexpr Tick kFlashTicks = 100;
  ground_.touch();
  if (!is_recipe || !chose(option("m8023_scope", "files_alone"))) state_.file_changed = true;
  if (chose(option("flash_time", "100_ms_without_a_scan"))) state_.flash_until = now() + 1 + kFlashTicks;
}

/// Returns the first register of a recipe, which extends to D999. Three places in the manual contain three
/// different ranges.
int StoredPrograms::first_of_recipe() const {
  if (chose(option("recipe_range", "d800_to_d999"))) return 800;
  return chose(option("recipe_range", "d900_to_d999")) ? 900 : kFirstOfRecipe;
}

/// Loads a recipe into its registers. A recipe that was never stored consists of zeros.
void StoredPrograms::take_recipe(std::int32_t number) {
  const int first = first_of_recipe();
  const auto count = static_cast<std::size_t>(kLastOfRecipe - first) + 1;
  const std::size_t slot = stored_d(kFirstOfRecipe).slot + (kRecipeRegisters - count);
  const SharedText* const stored = state_.blocks.find(kRecipes, recipe_name(number));
  std::array<std::uint32_t, kRecipeRegisters> fresh{};
  if (stored != nullptr) read_recipe(stored->text(), fresh, first);
  for (std::size_t i = 0; i < count; ++i) {
    ground_.put({.slot = slot + i}, static_cast<std::int32_t>(fresh[i]));
  }
}

void StoredPrograms::read_files_again() {
  const std::string number = std::to_string(state_.file);
  const SharedText* const c = state_.blocks.find(kFiles, number);
  if (c != nullptr && !is_too_long(kFiles, number)) {
    state_.blocks.put(kPrograms, "C", SharedText(*c));
  }
  if (state_.blocks.find(kRecipes, recipe_name(state_.recipe)) != nullptr) take_recipe(state_.recipe);
}

void StoredPrograms::change_recipe(std::int32_t number) {
  if (number < 0 || number >= kRecipeCount) {
    ground_.put(stored_d(d9::kRecipeNumber), state_.recipe);
    report(Code::no_such_file);
    return;
  }
  if (number == state_.recipe) return;
  const int first = first_of_recipe();
  const auto count = static_cast<std::size_t>(kLastOfRecipe - first) + 1;
  const std::size_t slot = stored_d(kFirstOfRecipe).slot + (kRecipeRegisters - count);
  const std::string text = recipe_text(std::span(ground_.state().image).subspan(slot, count), first);
  if (text.empty()) {
    state_.blocks.erase(kRecipes, recipe_name(state_.recipe));
  } else {
    state_.blocks.put(kRecipes, recipe_name(state_.recipe), SharedText(text));
  }
  take_recipe(number);
  state_.recipe = number;
  flash_written(true);
}

void StoredPrograms::show_capacities() {
  constexpr std::int32_t kAllSteps = 30000;
  const auto lines = static_cast<std::int32_t>(registers().of(stored_d(d9::kLinesOfAFile)));
  constexpr std::int32_t kLinesOfAPage = 256;
  if (chose(option("flash_pages", "lines_by_256"))) {
    ground_.put(stored_d(d9::kPagesOfAFile), (lines + kLinesOfAPage - 1) / kLinesOfAPage);
  }
  if (chose(option("file_layout", "always_20_files"))) return;
  if (!shows_line_counts()) ground_.put(stored_d(d9::kLinesOfC), room_of_c());
  ground_.put(stored_d(d9::kFileCount), kAllSteps / lines);
}

/// Returns the capacity of C and of each file, in steps or (depending on a choice) in lines.
std::int32_t StoredPrograms::room_of_c() const {
  constexpr std::int32_t kStepsOfC = 1500;
  if (chose(option("file_layout", "always_20_files"))) return kStepsOfC;
  return std::min(static_cast<std::int32_t>(registers().of(stored_d(d9::kLinesOfAFile))), kStepsOfC);
}

}  // namespace understudy::emulator::models::super_40nc
