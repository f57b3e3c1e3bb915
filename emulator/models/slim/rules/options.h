// SLIM: the code looks up the options of choices.h with these, as in `chose(option("thrust", "runs_at_vj"))`.
// An unknown row or option is a compile error. For options that are numbers it looks up the row:
// `number(numbers("history_length"))`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "emulator/models/slim/rules/choices.h"

namespace understudy::emulator::models::slim {

consteval Option option(std::string_view id, std::string_view name) { return option_of(kChoices, id, name); }

/// Returns the number that an option of a row begins with: 256 of "256_lines".
constexpr int number_of(const ChoiceRow& row, std::size_t option_number) {
  std::string_view rest = row.options;
  for (; option_number > 0; --option_number) rest.remove_prefix(rest.find('|') + 1);
  if (rest.empty() || rest.front() < '0' || rest.front() > '9') throw "the option has no number";
  int number = 0;
  for (const char c : rest) {
    if (c < '0' || c > '9') break;
    number = 10 * number + (c - '0');
  }
  return number;
}

/// Returns a row whose options are numbers; it is a compile error if one of them is not.
consteval std::size_t numbers(std::string_view id) {
  const std::size_t row = choice_number(kChoices, id);
  const auto bars = std::ranges::count(kChoices[row].options, '|');
  for (std::size_t i = 0; i <= static_cast<std::size_t>(bars); ++i) (void)number_of(kChoices[row], i);
  return row;
}

}  // namespace understudy::emulator::models::slim
