// Splits a line of a listing into words with their positions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace understudy {

struct Token {
  std::string_view text;
  int line = 0;
  int column = 0;  // in bytes, from 1
};

enum class Colon { is_a_letter, ends_its_token };

/// Splits at blanks and commas. A ';' begins a comment.
std::vector<Token> tokens_of(std::string_view text, int line, Colon colon = Colon::is_a_letter);

/// Converts only the letters a to z.
constexpr char upper(char letter) {
  return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}
std::string upper_case(std::string_view text);
/// Compares without regard to case.
bool is_word(std::string_view text, std::string_view word);

}  // namespace understudy
