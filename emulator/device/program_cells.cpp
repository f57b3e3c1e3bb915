#include "emulator/device/program_cells.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/text/lines.h"
#include "base/text/one_line.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator {

namespace {

std::string in_words(std::size_t number) {
  constexpr std::array<std::string_view, 13> kWords{"no",   "one",    "two",   "three", "four",
                                                    "five", "six",    "seven", "eight", "nine",
                                                    "ten",  "eleven", "twelve"};
  return number < kWords.size() ? std::string(kWords[number]) : std::to_string(number);
}

std::optional<std::int64_t> cell_of(std::string_view word, const CellForm& form) {
  std::int64_t cell = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), cell);
  const bool is_number = error == std::errc{} && end == word.data() + word.size();
  if (!is_number || cell < form.lowest || cell > form.highest) return std::nullopt;
  return cell;
}

struct PlacedWord {
  std::string_view text;
  int column = 0;
};

std::vector<PlacedWord> words_of(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r\f\v";
  std::vector<PlacedWord> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(kBlanks, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back({line.substr(at, end - at), static_cast<int>(at) + 1});
    at = end;
  }
  return words;
}

std::vector<std::int64_t> read_row(const std::vector<PlacedWord>& words, int line, const CellForm& form) {
  const std::string expected = "; expected " + std::string(form.row);
  std::vector<std::int64_t> cells;
  for (const PlacedWord& word : words) {
    if (cells.size() == form.max)
      throw ProgramError(line, word.column, "more than " + in_words(form.max) + " cells" + expected);
    const auto cell = cell_of(word.text, form);
    if (!cell) {
      throw ProgramError(line, word.column,
                         quoted(word.text) + " is not a cell; expected " + std::to_string(form.lowest) +
                             " to " + std::to_string(form.highest));
    }
    cells.push_back(*cell);
  }
  if (cells.size() < form.fewest) {
    const auto behind = words.back().column + static_cast<int>(words.back().text.size());
    throw ProgramError(line, behind, "fewer than " + in_words(form.fewest) + " cells" + expected);
  }
  return cells;
}

}  // namespace

std::string to_text(const std::vector<CellRow>& rows) {
  std::string text;
  for (const CellRow& row : rows) {
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      text += (i > 0 ? " " : "") + std::to_string(row.cells[i]);
    text += "\n";
  }
  return text;
}

std::vector<CellRow> read_cells(std::string_view text, const CellForm& form) {
  std::vector<CellRow> rows;
  for (const TextLine line : TextLines(text)) {
    const std::vector<PlacedWord> words = words_of(line.text);
    if (words.empty()) continue;
    CellRow row{.cells = read_row(words, line.number, form), .line = line.number};
    if (rows.size() == form.max_rows) {
      throw ProgramError(line.number, words.front().column,
                         "one line too many; expected at most " + std::to_string(form.max_rows));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace understudy::emulator
