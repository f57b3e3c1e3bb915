#include "interpreter/rs_m8194h/tokens.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::interpreter::rs_m8194h {
namespace {

constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

}  // namespace

std::string to_string(const TextError& error) {
  return std::to_string(error.line) + ":" + std::to_string(error.column) + ": " + error.message;
}

std::vector<Token> tokens_of(std::string_view line_of_text, int line) {
  const std::string_view text = line_of_text.substr(0, line_of_text.find(';'));
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

std::string upper_case(std::string_view text) {
  std::string made(text);
  std::ranges::transform(made, made.begin(), upper);
  return made;
}

bool is_word(std::string_view text, std::string_view word) {
  return std::ranges::equal(text, word, [](char a, char b) { return upper(a) == upper(b); });
}

}  // namespace understudy::interpreter::rs_m8194h
