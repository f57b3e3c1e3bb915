#include "emulator/world/expression/tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "emulator/world/expression/number.h"

namespace understudy::emulator::world {

namespace {

constexpr std::size_t kLongestText = 2'000;  // bytes: about twenty lines of conditions

// If several signs begin with the same characters, the longest sign comes first. Some signs are not valid in
// expressions; they are recognized only for the message.
constexpr std::array<std::string_view, 33> kSigns = {
    "&&", "||", "==", "!=", "<=", ">=", "<<", ">>", "<>", "+-", "..", "+", "-", "*", "/", "%", "<",
    ">",  "&",  "^",  "|",  "!",  "~",  "(",  ")",  "?",  ":",  ",",  "=", ".", "[", "]", ";"};

constexpr std::array<std::string_view, 6> kTimeUnits = {"ns", "us", "ms", "s", "min", "h"};

struct Word {
  std::string_view spelling;
  std::string_view sign;  // the sign for which the word is an alias; empty for a number
  int number = 0;
};
constexpr std::array<Word, 7> kWords = {{{"and", "&&"},
                                         {"or", "||"},
                                         {"not", "!"},
                                         {"true", "", 1},
                                         {"on", "", 1},
                                         {"false", "", 0},
                                         {"off", "", 0}}};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool continues_name(char c) { return begins_name(c) || is_digit(c); }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }  // in UTF-8

bool is_time_unit(std::string_view text) {
  return std::find(kTimeUnits.begin(), kTimeUnits.end(), text) != kTimeUnits.end();
}
bool is_unit(std::string_view text) { return is_time_unit(text) || text == "V" || text == "mV"; }

std::size_t column_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  return 1 + static_cast<std::size_t>(
                 std::count_if(before.begin(), before.end(), [](char c) { return !continues_character(c); }));
}

// Returns the part of a long text that is around the error.
std::string_view around(std::string_view text, std::size_t offset) {
  constexpr std::size_t kShort = 70;
  constexpr std::size_t kBefore = 40;
  if (text.size() <= kShort || offset <= kBefore) return text;
  std::size_t begin = offset - kBefore;
  while (begin < offset && continues_character(text[begin])) ++begin;
  return text.substr(begin);
}

std::string quoted_around(std::string_view text, std::size_t offset) {
  const std::string_view part = around(text, offset);
  return quoted((part.size() < text.size() ? "..." : "") + on_one_line(part));
}

// Returns 2500 for "2.5" volts, or nothing for fractions of a millivolt and for voltages that are out of
// range.
std::optional<std::int64_t> millivolts(std::string_view digits, std::string_view unit) {
  const std::int64_t highest = unit == "V" ? 1'000'000 : 1'000'000'000;
  const std::size_t point = digits.find('.');
  const auto whole = parse_integer(digits.substr(0, point));
  if (!whole || *whole >= highest) return std::nullopt;
  std::int64_t value = *whole;
  std::string_view fraction = point == std::string_view::npos ? "" : digits.substr(point + 1);
  for (int place = unit == "V" ? 3 : 0; place > 0; --place) {
    value = value * 10 + (fraction.empty() ? 0 : fraction[0] - '0');
    if (!fraction.empty()) fraction.remove_prefix(1);
  }
  if (fraction.find_first_not_of('0') != std::string_view::npos) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_bits(std::string_view digits) {
  std::int64_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [parsed, error] = std::from_chars(digits.data(), end, value, 2);
  if (digits.starts_with("-") || error != std::errc{} || parsed != end) return std::nullopt;
  return value;
}

}  // namespace

std::string on_one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(line.begin(), line.end(), is_space, ' ');
  return one_line(line);
}

ExpressionError::ExpressionError(std::string_view text, std::size_t offset, const std::string& what_is_wrong)
    : std::runtime_error("column " + std::to_string(column_of(text, offset)) + " of " +
                         quoted_around(text, offset) + ": " + one_line(what_is_wrong)),
      column(column_of(text, offset)) {}

Lexer::Lexer(std::string_view text) : text_(text) {
  if (text.size() > kLongestText) {
    fail(0, "too long (" + std::to_string(text.size()) + " bytes); expected at most " +
                std::to_string(kLongestText));
  }
}

void Lexer::fail(std::size_t offset, const std::string& what_is_wrong) const {
  throw ExpressionError(text_, offset, what_is_wrong);
}

Token Lexer::next() {
  while (is_space(at(next_))) ++next_;
  Token token;
  const std::size_t begin = next_;
  if (next_ < text_.size()) {
    const char c = text_[next_];
    token = is_digit(c) ? number() : begins_name(c) || c == '[' ? name() : sign();
  }
  token.begin = begin;
  token.end = next_;
  return token;
}

// Reads a unit after a number, with or without a space in between. A word after a number can only be a unit,
// because two values are never adjacent.
std::string_view Lexer::unit_here() {
  std::size_t begin = next_;
  while (at(begin) == ' ') ++begin;
  std::size_t end = begin;
  while (continues_name(at(end))) ++end;
  const std::string_view word = text_.substr(begin, end - begin);
  if (!is_unit(word)) return {};
  next_ = end;
  return word;
}

// Reads the characters of a number, and drops '_'.
std::string Lexer::digits_and_point(Token& token) {
  const std::size_t begin = next_;
  const auto skip_digits = [this] {
    while (is_digit(at(next_)) || at(next_) == '_') ++next_;
  };
  if (at(next_) == '0' && (at(next_ + 1) == 'x' || at(next_ + 1) == 'b')) {
    token.notation = Token::Notation::based;
    while (continues_name(at(next_))) ++next_;
  } else {
    skip_digits();
    if (at(next_) == '.' && is_digit(at(next_ + 1))) {
      token.notation = Token::Notation::decimal;
      ++next_;
      skip_digits();
    }
    const bool has_sign = at(next_ + 1) == '-' || at(next_ + 1) == '+';
    if ((at(next_) == 'e' || at(next_) == 'E') && is_digit(at(next_ + (has_sign ? 2 : 1)))) {
      token.notation = Token::Notation::exponent;
      next_ += has_sign ? 3 : 2;
      skip_digits();
    }
  }
  const auto is_plain_digit = [this](std::size_t offset) {
    return std::isxdigit(static_cast<unsigned char>(at(offset))) != 0;
  };
  std::string plain;
  for (std::size_t i = begin; i < next_; ++i) {
    if (text_[i] != '_') {
      plain += text_[i];
    } else if (!is_plain_digit(i - 1) || !is_plain_digit(i + 1)) {
      fail(i, "'_' in a number; expected it between two digits only");
    }
  }
  return plain;
}

Token Lexer::number() {
  const std::size_t begin = next_;
  Token token;
  token.kind = Token::Kind::number;
  const std::string plain = digits_and_point(token);
  const std::string_view unit = token.notation == Token::Notation::based ? std::string_view{} : unit_here();
  if (continues_name(at(next_))) {
    while (continues_name(at(next_))) ++next_;
    fail(begin,
         quoted(text_.substr(begin, next_ - begin)) +
             " is not a number; expected digits, and optionally a unit: ns, us, ms, s, min, h, mV or V");
  }
  const std::string written = quoted(text_.substr(begin, next_ - begin));
  if (!unit.empty() && token.notation == Token::Notation::exponent) {
    fail(begin, written + " has an exponent and a unit; expected one of them");
  }
  if (is_time_unit(unit)) {
    const auto time = parse_duration(plain + std::string(unit));
    if (!time) fail(begin, written + " is finer than a nanosecond or longer than a century");
    token.number = time->count();
    token.unit = Unit::nanoseconds;
  } else if (!unit.empty()) {
    const auto voltage = millivolts(plain, unit);
    if (!voltage) fail(begin, written + " is finer than a millivolt or more than a million volts");
    token.number = *voltage;
    token.unit = Unit::millivolts;
  } else if (token.notation == Token::Notation::whole || token.notation == Token::Notation::based) {
    const auto whole = plain.starts_with("0b") ? parse_bits(plain.substr(2)) : parse_integer(plain);
    if (!whole) fail(begin, written + " is not a whole number of 64 bits");
    token.number = *whole;
  } else {
    double value = 0;
    const auto error = std::from_chars(plain.data(), plain.data() + plain.size(), value).ec;
    // A number that is too small to be distinguished from 0 is also refused, because its author did not mean
    // 0.
    if (error != std::errc{}) fail(begin, written + " is too large for a real number");
    token.number = value;
  }
  return token;
}

std::string Lexer::quoted_part() {
  const std::size_t bracket = next_++;
  const char quote = at(next_);
  if (quote != '"' && quote != '\'')
    fail(bracket, "'[' without a name; expected a quoted one, [\"Like This\"]");
  const std::size_t begin = ++next_;
  const std::size_t end = text_.find(quote, begin);
  if (end == std::string_view::npos) fail(begin - 1, "the quoted name is not closed");
  if (end == begin) fail(begin - 1, "an empty name");
  next_ = end + 1;
  if (at(next_) != ']') fail(next_, "expected ']' after the quoted name");
  ++next_;
  return std::string(text_.substr(begin, end - begin));
}

Token Lexer::name() {
  Token token;
  token.kind = Token::Kind::name;
  bool plain = true;  // a single word, which may be a keyword
  if (at(next_) == '[') {
    token.name = quoted_part();
    plain = false;
  } else {
    while (continues_name(at(next_))) token.name += text_[next_++];
  }
  while (at(next_) == '[' || (at(next_) == '.' && continues_name(at(next_ + 1)))) {
    plain = false;
    token.name += '.';
    if (at(next_) == '[') {
      token.name += quoted_part();
      continue;
    }
    ++next_;
    while (continues_name(at(next_))) token.name += text_[next_++];
  }
  if (at(next_) == '.' && at(next_ + 1) != '.') fail(next_, "expected a name or a bit number after '.'");
  if (!plain) return token;
  for (const Word& word : kWords) {
    if (word.spelling != token.name) continue;
    token.kind = word.sign.empty() ? Token::Kind::number : Token::Kind::sign;
    token.sign = word.sign;
    token.number = word.number;
  }
  return token;
}

Token Lexer::sign() {
  Token token;
  token.kind = Token::Kind::sign;
  for (const std::string_view sign : kSigns) {
    if (text_.substr(next_).starts_with(sign)) {
      token.sign = sign;
      next_ += sign.size();
      return token;
    }
  }
  std::size_t end = next_ + 1;
  while (end < text_.size() && continues_character(text_[end])) ++end;
  fail(next_, quoted(text_.substr(next_, end - next_)) + " cannot be part of an expression");
}

}  // namespace understudy::emulator::world
