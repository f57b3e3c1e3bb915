// Parses the numbers and ranges of a list as people print them, in counts or in the unit with decimals.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace understudy::emulator::model_file {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// Returns the text without the blanks and quotes around it.
std::string_view bare(std::string_view text);

/// An exact decimal number: digits * 10^-places.
struct Decimal {
  std::int64_t digits = 0;
  int places = 0;
};
/// Parses "50.00", "-0,5" and "7". If `may_have_unit`, a unit may follow the number.
std::optional<Decimal> parse_decimal(std::string_view text, bool may_have_unit);
/// Returns true if a text is a number with decimal places: "50.0".
bool has_decimals(std::string_view text);
/// Returns true for a number whose comma may separate thousands instead of decimals: "65,535".
bool may_have_thousands(std::string_view text);

/// Returns a cell of numbers with the signs of ASCII in place of full-width and typographic ones, and an
/// empty text for a word that means none: "-", "n/a".
std::string plain_cell(std::string_view text);

std::int64_t power_of_ten(int exponent);

/// The value of a count: counts * step + offset.
struct Step {
  Decimal step{1, 0};
  Decimal offset{};
  std::string text{};  // the step as it is written; empty: the list does not contain one
};
/// Returns nothing if no integer number of counts has this value.
std::optional<std::int64_t> counts_of(const Decimal& value, const Step& step);
/// Returns the step at the beginning of a unit, such as in "0.01Hz".
std::optional<Step> step_of_unit(std::string_view unit);
/// Returns the step of a scale: "0.1", "x0.1", "/10". An integer N above 1 means that N counts are one unit.
std::optional<Step> step_of_scale(std::string_view scale);

/// Returns the two ends of "0..3000", "-5 to 5", "0-100" or "(0 ~ 100)", as they are written.
std::optional<std::pair<std::string, std::string>> ends_of(const std::string& range);

/// Returns digits as binary-coded decimals, or nothing if they do not fit.
std::optional<std::int64_t> as_bcd(std::int64_t number, int words);

}  // namespace understudy::emulator::model_file
