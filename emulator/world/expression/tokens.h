// Splits an expression into tokens: numbers with their units, names, operators.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "emulator/world/expression/number.h"

namespace understudy::emulator::world {

/// Returns an expression as it was written, but on one line.
std::string on_one_line(std::string_view text);

/// The message is one line: "column 17 of 'feeder.STATUS ==': unexpected end; expected a name, a number or
/// '('".
struct ExpressionError : std::runtime_error {
  ExpressionError(std::string_view text, std::size_t offset, const std::string& what_is_wrong);
  std::size_t column = 0;  // in characters, counted from 1
};

struct Token {
  enum class Kind : std::uint8_t { end, number, name, sign } kind = Kind::end;
  std::size_t begin = 0;  // in the text, in bytes
  std::size_t end = 0;
  std::string_view sign = {};  // also "&&" for `and`
  enum class Notation : std::uint8_t { whole, based, decimal, exponent } notation = Notation::whole;
  Number number = {};
  Unit unit = Unit::none;
  std::string name = {};  // feeder["Logic Position X"].4 as "feeder.Logic Position X.4"
};

class Lexer {
 public:
  /// The text must outlive the lexer. Throws ExpressionError if it is too long.
  explicit Lexer(std::string_view text);
  /// Returns the next token. At the end, it returns a token of kind `end` every time. Throws ExpressionError.
  Token next();

 private:
  Token number();
  std::string digits_and_point(Token& token);
  Token name();
  Token sign();
  char at(std::size_t offset) const { return offset < text_.size() ? text_[offset] : '\0'; }
  std::string quoted_part();
  std::string_view unit_here();
  [[noreturn]] void fail(std::size_t offset, const std::string& what_is_wrong) const;

  std::string_view text_;
  std::size_t next_ = 0;
};

}  // namespace understudy::emulator::world
