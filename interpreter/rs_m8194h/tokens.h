// Lines of text as tokens, and what is wrong with them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace understudy::interpreter::rs_m8194h {

struct TextError {
  int line = 0;    // from 1
  int column = 0;  // in bytes, from 1
  std::string message;

  bool operator==(const TextError&) const = default;
};

/// "4:9: parameter nMode: '9' does not fit; expected 0 to 5".
std::string to_string(const TextError& error);

struct Token {
  std::string_view text;
  int line = 0;
  int column = 0;
};

/// Split at blanks and commas; a ';' begins a comment.
std::vector<Token> tokens_of(std::string_view line_of_text, int line);

std::string upper_case(std::string_view text);
/// Upper or lower case.
bool is_word(std::string_view text, std::string_view word);

}  // namespace understudy::interpreter::rs_m8194h
