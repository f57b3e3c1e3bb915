// Choices are decisions that a manual leaves open. They are kept as data, and each row is the only place that
// states its decision: the code reads the value from the row, a bench can override it, and
// docs/fidelity/MODEL.md is generated from it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace understudy {

enum class Confidence : std::uint8_t {
  follows,   // the manual implies it elsewhere
  likely,    // the cited standard says so, or similar devices do so
  proposal,  // the manual is silent; the decision is ours
};

struct ChoiceRow {
  std::string_view id;
  std::string_view section;  // the manual's section that raises the question
  std::string_view question;
  /// Options separated by '|', the default first. If there is only one, no alternative is modelled.
  std::string_view options;
  Confidence confidence = Confidence::proposal;
  std::string_view why;
};

/// Returns the options of a row, the default first.
std::vector<std::string_view> options_of(const ChoiceRow& row);
std::string_view to_string(Confidence confidence);

struct ChoiceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns, for each row, the number of the option in effect (0 is the default). Throws ChoiceError for an
/// unknown id or option, with the expected values.
std::vector<std::uint8_t> resolve_choices(std::span<const ChoiceRow> rows,
                                          const std::map<std::string, std::string>& overrides);

/// Returns the index of a row in its table. In a constant expression an unknown id does not compile. The
/// function is not consteval, because clang 14 does not let a consteval function pass its own arguments to
/// another.
constexpr std::size_t choice_number(std::span<const ChoiceRow> rows, std::string_view id) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].id == id) return i;
  }
  throw "no such choice";
}

/// An option of a row, for comparisons in a model's code.
struct Option {
  std::size_t choice = 0;  // the index of its row
  std::uint8_t number = 0;
};

/// Returns the option. In a constant expression, an unknown row or option does not compile.
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

/// Returns the number at the beginning of an option's name, such as 256 for "256_lines".
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

/// Returns the index of a row whose options are numbers. In a constant expression, a row with another option
/// does not compile.
constexpr std::size_t numbers_row(std::span<const ChoiceRow> rows, std::string_view id) {
  const std::size_t row = choice_number(rows, id);
  const auto bars = std::ranges::count(rows[row].options, '|');
  for (std::size_t i = 0; i <= static_cast<std::size_t>(bars); ++i) (void)number_of(rows[row], i);
  return row;
}

/// The selected options of a table, for code that has access to this table only, such as a language. By
/// default, the first option of each row is selected.
template <const auto& kRows>
class OptionsOf {
 public:
  /// An option in this table. It differs from Option, whose index refers to the model's whole table.
  struct Named {
    std::size_t row = 0;
    std::uint8_t number = 0;
  };
  /// A row in this table whose options are numbers.
  struct Numbers {
    std::size_t row = 0;
  };
  static constexpr std::size_t kCount = std::size(kRows);

  OptionsOf() = default;
  constexpr OptionsOf(std::initializer_list<Named> options) {
    for (const Named& option : options) choose(option);
  }
  /// `numbers` are the selected options. When the code reads a row, it sets the row's element of `asked` to
  /// 1. `asked` must outlive this object and its copies.
  OptionsOf(std::span<const std::uint8_t> numbers, std::uint8_t* asked) : asked_(asked) {
    std::copy_n(numbers.begin(), kCount, numbers_.begin());
  }

  constexpr bool chose(const Named& option) const {
    if (asked_ != nullptr) asked_[option.row] = 1;
    return numbers_[option.row] == option.number;
  }
  constexpr void choose(const Named& option) { numbers_[option.row] = option.number; }
  /// Returns the number at the beginning of the selected option's name.
  constexpr int number(const Numbers& of) const {
    if (asked_ != nullptr) asked_[of.row] = 1;
    return number_of(kRows[of.row], numbers_[of.row]);
  }

  /// Returns the option. In a constant expression, an unknown row or option does not compile.
  static constexpr Named named(std::string_view id, std::string_view name) {
    const Option found = option_of(kRows, id, name);
    return {found.choice, found.number};
  }
  /// Returns the row. In a constant expression, a row whose options are not numbers does not compile.
  static constexpr Numbers numbers(std::string_view id) { return {numbers_row(kRows, id)}; }

 private:
  std::array<std::uint8_t, kCount> numbers_{};
  std::uint8_t* asked_ = nullptr;
};

}  // namespace understudy
