// Choices: every decision that a manual leaves open, as data. A row is the decision's only home: the
// code asks for its value, a bench overrides it, and docs/fidelity/MODEL.md is made from it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator {

enum class Confidence : std::uint8_t {
  follows,   // follows from what the manual says elsewhere
  likely,    // what the cited standard or devices of this kind do
  proposal,  // the manual is silent; ours to set
};

struct ChoiceRow {
  std::string_view id;
  std::string_view section;  // where the question comes up
  std::string_view question;
  /// Options separated by '|', ours first. If there is only one, nothing else is modelled.
  std::string_view options;
  Confidence confidence = Confidence::proposal;
  std::string_view why;
};

/// The options of a row, ours first.
std::vector<std::string_view> options_of(const ChoiceRow& row);
std::string_view to_string(Confidence confidence);

struct ChoiceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// For each row, the number of the option in force (0 is ours). Throws ChoiceError for an unknown id or
/// option, naming what was expected.
std::vector<std::uint8_t> resolve_choices(std::span<const ChoiceRow> rows,
                                          const std::map<std::string, std::string>& overrides);

/// Where a row stands in its table. If there is none, that is a compile error in a constant expression; not
/// consteval, because clang 14 does not let one such function call another with its own arguments.
constexpr std::size_t choice_number(std::span<const ChoiceRow> rows, std::string_view id) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].id == id) return i;
  }
  throw "no such choice";
}

/// One option of one row, as a model's code asks for it.
struct Option {
  std::size_t choice = 0;  // its row
  std::uint8_t number = 0;
};

/// A row or an option that does not exist.
constexpr Option option_of(std::span<const ChoiceRow> rows, std::string_view id, std::string_view name) {
  const std::size_t row = choice_number(rows, id);
  std::string_view rest = rows[row].options;
  for (std::uint8_t number = 0;; ++number) {
    const std::size_t bar = rest.find('|');
    if (rest.substr(0, bar) == name) return {row, number};
    if (bar == std::string_view::npos) throw "the choice has no such option";
    rest.remove_prefix(bar + 1);
  }
}

}  // namespace understudy::emulator
