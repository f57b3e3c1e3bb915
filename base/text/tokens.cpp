#include "base/text/tokens.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace understudy {

std::vector<Token> tokens_of(std::string_view text, int line, Colon colon) {
  text = text.substr(0, text.find(';'));
  constexpr std::string_view kBlanks = " \t\r\f\v,";
  std::vector<Token> tokens;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(kBlanks, at)) != std::string_view::npos) {
    std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    if (const std::size_t found = text.find(':', at); colon == Colon::ends_its_token && found < end)
      end = found + 1;
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
  return std::ranges::equal(text, word, {}, upper, upper);
}

}  // namespace understudy
