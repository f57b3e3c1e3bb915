// Reads the words of a line: blanks, capitals, names, items between commas, and individual items.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "interpreter/slim/command.h"
#include "interpreter/slim/error.h"

namespace understudy::interpreter::slim {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
constexpr bool is_letter(char c) { return capital(c) >= 'A' && capital(c) <= 'Z'; }

std::string_view without_blanks(std::string_view text);  // leading and trailing blanks
std::string in_capitals(std::string_view text);
/// Removes the leading letters and digits from the text and returns them in capitals. So JG0 and JG are
/// different words, as are HON and H.
std::string take_word(std::string_view& text);
/// Splits a text at commas into items without surrounding blanks. An empty text has no items.
std::vector<std::string_view> split_at_commas(std::string_view text);

/// Returns true if the text is `letters` followed by a number: "EV12", "N0".
bool is_numbered(std::string_view word, std::string_view letters);

/// Returns `number`, or the largest 32-bit real if the number exceeds that only by rounding: written with
/// fewer digits, the largest real can become slightly larger.
double rounded_real(double number);

struct Item {
  Error error = Error::none;
  Operand operand = {};
};
/// Parses any operand except a text or a condition. If a variable or an element does not exist, it is a range
/// error.
Item parse_item(std::string_view text);
/// Recognise and parse a text in quotes, including the full-width quotes of a Chinese keyboard.
bool begins_with_quote(std::string_view text);
Item parse_text(std::string_view text);

}  // namespace understudy::interpreter::slim
