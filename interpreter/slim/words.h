// The words of a line: blanks, capitals, names, items between commas, and what one item is by itself.
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

std::string_view without_blanks(std::string_view text);  // in front and behind
std::string in_capitals(std::string_view text);
/// Takes the letters and digits that the text begins with, in capitals. This is what makes JG0 another word
/// than JG, and HON another than H.
std::string take_word(std::string_view& text);
/// Items between commas, without blanks around them; none for an empty text.
std::vector<std::string_view> split_at_commas(std::string_view text);

/// Whether the text is `letters` and a number behind it: "EV12", "N0".
bool is_numbered(std::string_view word, std::string_view letters);

/// The largest 32-bit real is written with fewer digits than it has, and then a little larger: that is meant.
double rounded_real(double number);

struct Item {
  Error error = Error::none;
  Operand operand = {};
};
/// Any operand but a text or a condition. A variable or an element that does not exist is a range error.
Item parse_item(std::string_view text);
/// A text in quotes, which may be the full-width ones of a Chinese keyboard.
bool begins_with_quote(std::string_view text);
Item parse_text(std::string_view text);

}  // namespace understudy::interpreter::slim
