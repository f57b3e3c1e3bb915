#include "emulator/models/super_40nc/files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "base/state/shared_text.h"
#include "base/text/lines.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/registers.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/options.h"

namespace understudy::emulator::models::super_40nc {

namespace language = interpreter::super_40nc;

namespace {

constexpr std::size_t kRecipeRegisters = kLastOfRecipe - kFirstOfRecipe + 1;
constexpr std::size_t kLongestLine = 17;  // "D500 -2147483648\n"

std::string why_not_recipe_name(const std::string& name) {
  const bool is_number = name.size() == 2 && name.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? "" : "is not a recipe; expected 00 to 99";
}

struct RecipeLine {
  int number = 0;  // of the register
  std::int32_t value = 0;
};

template <typename Number>
bool parse(std::string_view text, Number& number) {
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && parsed == end;
}

std::optional<RecipeLine> parse_line(std::string_view line) {
  const std::size_t space = line.find(' ');
  if (line.empty() || line[0] != 'D' || space == std::string_view::npos) return std::nullopt;
  RecipeLine parsed;
  if (!parse(line.substr(1, space - 1), parsed.number) || !parse(line.substr(space + 1), parsed.value) ||
      parsed.number < kFirstOfRecipe || parsed.number > kLastOfRecipe) {
    return std::nullopt;
  }
  return parsed;
}

std::string why_not_recipe(const std::string& text) {
  for (const TextLine line : TextLines(text)) {
    if (!parse_line(line.text)) {
      return "line " + std::to_string(line.number) +
             ": is not a register of a recipe; expected such as D500 12";
    }
  }
  return "";
}

std::string why_not_program_name(const std::string& name) {
  const bool is_area = std::any_of(language::kAreas.begin(), language::kAreas.end(),
                                   [&](const language::AreaRow& row) { return row.name == name; });
  return is_area ? "" : "is not an area; expected C, X, Y, Z, U or PLC";
}

std::string why_not_file_name(const std::string& name) {
  int number = 0;
  const bool is_number = parse(std::string_view(name), number) && std::to_string(number) == name;
  return is_number && number >= 0 && number <= language::kGreatestFile ? ""
                                                                       : "is not a file; expected 0 to 29999";
}

std::string why_not_listing(const std::string& text) {
  // Use the most tolerant options, whatever is chosen.
  language::Options options;
  options.loose_groups = language::Options::LooseGroups::take_last_result;
  options.capacity = language::Options::Capacity::lines;
  options.end_may_be_missing = options.unset_lines_are_skipped = true;
  options.swapped = language::Options::Swapped::clears_all;
  const language::Checked checked = language::check(text, options);
  if (checked.program) return "";
  const language::Diagnostic& first = checked.errors.front();
  return "line " + std::to_string(first.line) + ": " + first.message();
}

constexpr std::size_t kLongestListing = 100'000;  // for 1,500 steps
constexpr std::size_t kMaxFiles = 30'000;

constexpr std::array<BlockKind, 3> kBlocks{{{.name = kPrograms,
                                             .most = language::kAreas.size(),
                                             .longest = kLongestListing,
                                             .why_not_called = why_not_program_name,
                                             .why_not_text = why_not_listing},
                                            {.name = kFiles,
                                             .most = kMaxFiles,
                                             .longest = kLongestListing,
                                             .why_not_called = why_not_file_name,
                                             .why_not_text = why_not_listing},
                                            {.name = kRecipes,
                                             .most = kRecipeCount,
                                             .longest = kRecipeRegisters * kLongestLine,
                                             .why_not_called = why_not_recipe_name,
                                             .why_not_text = why_not_recipe}}};

}  // namespace

std::span<const BlockKind> block_kinds() { return kBlocks; }

std::string recipe_name(std::int32_t number) { return std::to_string(100 + number).substr(1); }

std::string recipe_text(std::span<const std::uint32_t> values, int first) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == 0) continue;
    text += "D" + std::to_string(first + static_cast<int>(i)) + " " +
            std::to_string(static_cast<std::int32_t>(values[i])) + "\n";
  }
  return text;
}

void read_recipe(std::string_view text, std::span<std::uint32_t> values, int first) {
  std::fill(values.begin(), values.end(), 0U);
  for (const TextLine line : TextLines(text)) {
    const auto parsed = parse_line(line.text);
    if (parsed && parsed->number >= first) {
      values[static_cast<std::size_t>(parsed->number - first)] = static_cast<std::uint32_t>(parsed->value);
    }
  }
}

/// Returns the first register of a recipe, which extends to D999; three texts of the manual have three
/// ranges.
int Super40nc::first_of_recipe() const {
  if (chose(option("recipe_range", "d800_to_d999"))) return 800;
  return chose(option("recipe_range", "d900_to_d999")) ? 900 : kFirstOfRecipe;
}

/// Loads a recipe into its registers; a recipe that was never stored is all 0.
void Super40nc::take_recipe(std::int32_t number) {
  const int first = first_of_recipe();
  const auto count = static_cast<std::size_t>(kLastOfRecipe - first) + 1;
  const std::size_t slot = kept_d(kFirstOfRecipe).slot + (kRecipeRegisters - count);
  const SharedText* const stored = state_.blocks.find(kRecipes, recipe_name(number));
  std::array<std::uint32_t, kRecipeRegisters> fresh{};
  if (stored != nullptr) read_recipe(stored->text(), fresh, first);
  for (std::size_t i = 0; i < count; ++i) {
    put({.slot = slot + i}, static_cast<std::int32_t>(fresh[i]));
  }
}

/// Reads the stored file and recipe again at power-up, if that is chosen.
void Super40nc::read_files_again() {
  const std::string number = std::to_string(state_.file);
  const SharedText* const c = state_.blocks.find(kFiles, number);
  if (c != nullptr && !is_too_long(kFiles, number)) {
    state_.blocks.put(kPrograms, "C", SharedText(*c));
  }
  if (state_.blocks.find(kRecipes, recipe_name(state_.recipe)) != nullptr) take_recipe(state_.recipe);
}

void Super40nc::change_recipe(std::int32_t number) {
  if (number < 0 || number >= kRecipeCount) {
    put(kept_d(d9::kRecipeNumber), state_.recipe);
    report(Code::no_such_file);
    return;
  }
  if (number == state_.recipe) return;
  const int first = first_of_recipe();
  const auto count = static_cast<std::size_t>(kLastOfRecipe - first) + 1;
  const std::size_t slot = kept_d(kFirstOfRecipe).slot + (kRecipeRegisters - count);
  const std::string text = recipe_text(std::span(state_.image).subspan(slot, count), first);
  if (text.empty()) {
    state_.blocks.erase(kRecipes, recipe_name(state_.recipe));
  } else {
    state_.blocks.put(kRecipes, recipe_name(state_.recipe), SharedText(text));
  }
  take_recipe(number);
  state_.recipe = number;
  flash_written(true);
}

void Super40nc::show_capacities() {
  constexpr std::int32_t kAllSteps = 30000;
  const auto lines = static_cast<std::int32_t>(registers().of(kept_d(d9::kLinesOfAFile)));
  constexpr std::int32_t kLinesOfAPage = 256;
  if (chose(option("flash_pages", "lines_by_256"))) {
    put(kept_d(d9::kPagesOfAFile), (lines + kLinesOfAPage - 1) / kLinesOfAPage);
  }
  if (chose(option("file_layout", "always_20_files"))) return;
  if (!shows_line_counts()) put(kept_d(d9::kLinesOfC), room_of_c());
  put(kept_d(d9::kFileCount), kAllSteps / lines);
}

/// Returns the room of C and of each file, in steps.
std::int32_t Super40nc::room_of_c() const {
  constexpr std::int32_t kStepsOfC = 1500;
  if (chose(option("file_layout", "always_20_files"))) return kStepsOfC;
  return std::min(static_cast<std::int32_t>(registers().of(kept_d(d9::kLinesOfAFile))), kStepsOfC);
}

}  // namespace understudy::emulator::models::super_40nc
