#include "emulator/models/super_40nc/programs/files.h"

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
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/listing.h"
#include "interpreter/super_40nc/options.h"

namespace understudy::emulator::models::super_40nc {

namespace language = interpreter::super_40nc;

namespace {

constexpr std::size_t kLongestLine = 17;  // "D500 -2147483648\n"

std::string why_not_recipe_name(const std::string& name) {
  const bool is_number = name.size() == 2 && name.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? "" : "is not a recipe; expected 00 to 99";
}

struct RecipeLine {
  int number = 0;  // the number of the register
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
             ": is not a register of a recipe; expected one such as D500 12";
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
  // The most tolerant options apply, regardless of the choices.
  language::Options options;
  options.choose(language::option("cj_without_group", "takes_the_last_result"));
  options.choose(language::option("capacity_unit", "lines"));
  options.choose(language::option("missing_end", "as_if_it_had_one"));
  options.choose(language::option("unset_fields", "line_is_skipped"));
  options.choose(language::option("zrst_swapped", "all_between"));
  const language::Checked checked = language::check(text, options);
  if (checked.program) return "";
  const language::Diagnostic& first = checked.errors.front();
  return "line " + std::to_string(first.line) + ": " + first.message();
}

constexpr std::size_t kLongestListing = 100'000;  // for 1,500 steps
constexpr std::size_t kMaxFiles = 30'000;

constexpr std::array<BlockKind, 3> kBlocks{{{.name = kPrograms,
                                             .max = language::kAreas.size(),
                                             .longest = kLongestListing,
                                             .why_not_called = why_not_program_name,
                                             .why_not_text = why_not_listing},
                                            {.name = kFiles,
                                             .max = kMaxFiles,
                                             .longest = kLongestListing,
                                             .why_not_called = why_not_file_name,
                                             .why_not_text = why_not_listing},
                                            {.name = kRecipes,
                                             .max = kRecipeCount,
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

}  // namespace understudy::emulator::models::super_40nc
