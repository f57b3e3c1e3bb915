#include "interpreter/slim/words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/parse.h"

namespace understudy::interpreter::slim {
namespace {

using Kind = Operand::Kind;

constexpr double kExactWhole = 9007199254740992.0;  // 2^53; doubles are exact for whole numbers up to this

Item wrong(Error error) { return {.error = error}; }
Item right(Operand operand) { return {.operand = std::move(operand)}; }

/// Reads only digits. A number that is too long becomes a large number.
std::optional<int> whole_number(std::string_view digits) {
  if (digits.empty()) return std::nullopt;
  int number = 0;
  for (const char c : digits) {
    if (!is_digit(c)) return std::nullopt;
    number = number > 99'999 ? number : number * 10 + (c - '0');
  }
  return number;
}

std::size_t count_digits(std::string_view text, std::size_t from) {
  std::size_t count = 0;
  while (from + count < text.size() && is_digit(text[from + count])) ++count;
  return count;
}

/// NS(i), RS(i): i is a number or an N variable.
Item parse_element(std::string_view word, Kind kind) {
  if (!word.ends_with(')')) return wrong(Error::syntax);
  const std::string_view index = without_blanks(word.substr(3, word.size() - 4));
  const bool is_variable = index.starts_with('N');
  const std::optional<int> number = whole_number(is_variable ? index.substr(1) : index);
  const bool is_negative = index.starts_with('-') && whole_number(index.substr(1)).has_value();
  if (!number) return wrong(is_negative ? Error::range : Error::syntax);
  if (*number >= (is_variable ? kVariableCount : kArrayCount)) return wrong(Error::range);
  return right({.kind = kind, .index = *number, .index_is_variable = is_variable});
}

Item parse_name(const std::string& word) {
  if (word == "AIN") return right({.kind = Kind::analog});
  if (word == "TM") return right({.kind = Kind::clock});
  if (word == "GETI") return right({.kind = Kind::get_integer});
  if (word == "GETR") return right({.kind = Kind::get_real});
  if (word.starts_with("NS(")) return parse_element(word, Kind::integer_array);
  if (word.starts_with("RS(")) return parse_element(word, Kind::real_array);

  struct Numbered {
    std::string_view letters;
    Kind kind;
    int min;
    int max;
  };
  static constexpr std::array<Numbered, 4> kNumbered{{
      {"N", Kind::integer_variable, 0, kVariableCount - 1},
      {"R", Kind::real_variable, 0, kVariableCount - 1},
      {"P", Kind::port, 1, kPortCount},
      {"EV", Kind::event, 1, kEventCount},
  }};
  for (const Numbered& form : kNumbered) {
    if (!is_numbered(word, form.letters)) continue;
    const int index = *whole_number(std::string_view(word).substr(form.letters.size()));
    if (index < form.min || index > form.max) return wrong(Error::range);
    return right({.kind = form.kind, .index = index});
  }
  // Other code checks whether the name exists and is allowed here.
  const bool is_word = !word.empty() && is_letter(word.front()) &&
                       std::ranges::all_of(word, [](char c) { return is_letter(c) || is_digit(c); });
  return is_word ? right({.kind = Kind::quantity, .text = word}) : wrong(Error::syntax);
}

// U+201C, U+201D and U+FF02.
constexpr std::array<std::string_view, 3> kWideQuotes{"\xE2\x80\x9C", "\xE2\x80\x9D", "\xEF\xBC\x82"};

/// Returns the position of the first full-width quote.
std::size_t find_wide_quote(std::string_view text) {
  std::size_t first = std::string_view::npos;
  for (const std::string_view quote : kWideQuotes) first = std::min(first, text.find(quote));
  return first;
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) c = capital(c);
  return capitals;
}

std::string take_word(std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && (is_letter(text[length]) || is_digit(text[length]))) ++length;
  std::string word = in_capitals(text.substr(0, length));
  text.remove_prefix(length);
  return word;
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> items;
  text = without_blanks(text);
  if (text.empty()) return items;
  for (std::size_t comma = text.find(','); comma != std::string_view::npos; comma = text.find(',')) {
    items.push_back(without_blanks(text.substr(0, comma)));
    text.remove_prefix(comma + 1);
  }
  items.push_back(without_blanks(text));
  return items;
}

bool is_numbered(std::string_view word, std::string_view letters) {
  return word.size() > letters.size() && word.starts_with(letters) &&
         count_digits(word, letters.size()) == word.size() - letters.size();
}

std::optional<Operand> parse_number(std::string_view text) {
  text = without_blanks(text);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  // from_chars() also accepts "inf" and "nan", so this code checks the form.
  std::size_t at = text.starts_with('-') ? 1 : 0;
  const std::size_t whole_digits = count_digits(text, at);
  at += whole_digits;
  bool is_whole = true;
  std::size_t fraction_digits = 0;
  if (at < text.size() && text[at] == '.') {
    is_whole = false;
    fraction_digits = count_digits(text, at + 1);
    at += 1 + fraction_digits;
  }
  if (whole_digits + fraction_digits == 0) return std::nullopt;
  if (at < text.size() && capital(text[at]) == 'E') {
    is_whole = false;
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    const std::size_t exponent_digits = count_digits(text, at);
    if (exponent_digits == 0) return std::nullopt;
    at += exponent_digits;
  }
  if (at != text.size()) return std::nullopt;

  Operand operand{.kind = Kind::real};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), operand.number);
  // The number is too large or too small for a double; from_chars() then does not change it.
  if (error == std::errc::result_out_of_range) {
    const std::size_t exponent = text.find_first_of("eE");
    const bool is_small = exponent != std::string_view::npos && text.substr(exponent + 1).starts_with('-');
    operand.number = is_small ? 0.0 : HUGE_VAL;
  }
  if (is_whole && std::abs(operand.number) < kExactWhole) operand.kind = Kind::integer;
  if (operand.number == 0) operand.number = 0;  // no negative zero
  return operand;
}

double rounded_real(double number) {
  constexpr double kMax = std::numeric_limits<float>::max();
  constexpr double kNext = 0x1.ffffffp127;  // halfway from kMax to 2^128
  return std::abs(number) < kNext ? std::clamp(number, -kMax, kMax) : number;
}

Item parse_item(std::string_view text) {
  if (text.empty()) return wrong(Error::syntax);
  if (std::optional<Operand> number = parse_number(text)) return right(*std::move(number));
  const std::string word = in_capitals(text);
  if (!word.starts_with('$')) return parse_name(word);
  std::string_view rest = std::string_view(word).substr(1);
  for (const char c : rest) {
    if (!is_letter(c) && !is_digit(c) && c != '_') return wrong(Error::syntax);
  }
  if (rest.empty()) return wrong(Error::syntax);
  return right({.kind = Kind::label, .text = std::string(rest)});
}

bool begins_with_quote(std::string_view text) { return text.starts_with('"') || find_wide_quote(text) == 0; }

Item parse_text(std::string_view text) {
  const bool is_ascii = text.starts_with('"');
  const std::size_t width = is_ascii ? 1 : kWideQuotes[0].size();
  text.remove_prefix(width);
  const std::size_t end = is_ascii ? text.find('"') : find_wide_quote(text);
  if (end == std::string_view::npos || end + width != text.size()) return wrong(Error::syntax);
  return right({.kind = Kind::text, .text = std::string(text.substr(0, end))});
}

}  // namespace understudy::interpreter::slim
