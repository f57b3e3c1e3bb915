// The words of a line of a listing, and where each stands.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/parse_integer.h"

namespace understudy::interpreter::super_40nc {

struct Token {
  std::string_view text;
  int line = 0;
  int column = 0;
};

constexpr bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }
constexpr char upper(char letter) {
  return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}
inline std::string upper_case(std::string_view text) {
  std::string made(text);
  std::transform(made.begin(), made.end(), made.begin(), upper);
  return made;
}
inline std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

inline std::vector<Token> tokens_of(std::string_view text, int line) {
  text = text.substr(0, text.find(';'));
  constexpr std::string_view kBlanks = " \t\r\f\v,";
  std::vector<Token> tokens;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(kBlanks, at)) != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    tokens.push_back({text.substr(at, end - at), line, static_cast<int>(at) + 1});
    at = end;
  }
  return tokens;
}

/// Digits with a sign perhaps; nothing if 64 bits do not hold it.
inline std::optional<std::int64_t> decimal(std::string_view text) {
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), is_digit)) return {};
  return parse_integer(text);
}

}  // namespace understudy::interpreter::super_40nc
