// Parses text into an Expression in one pass: each rule of the grammar is a function that writes the code for
// its text. The precedence is that of C. Parentheses are required where the precedence of C is surprising (`a
// & 4 == 4`, `a < b < c`, `not a == b`).
#pragma once

#include <string>
#include <string_view>

#include "emulator/world/expression/code_writer.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/term.h"
#include "emulator/world/expression/tokens.h"

namespace understudy::emulator::world {

/// All member functions throw ExpressionError. `text` and `names` must outlive the parser.
class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, const NameResolver& names);

  /// Reads up to the end of the expression.
  Term expression();
  /// If `sign` is next, skips it and returns true.
  bool skip(std::string_view sign);
  /// Reads "1%" or "0.5%" as millionths of a percent and returns true. If something else is next, reads
  /// nothing.
  bool percentage(std::int64_t& millionths);
  bool at_end() const { return token_.kind == Token::Kind::end; }
  void expect_end() const;
  /// Returns the position of the next token.
  std::size_t offset() const { return token_.begin; }
  /// Returns the code that was written since the last call.
  Expression take() { return code_.take(); }

 private:
  Term level(Level level);
  Term logical(const BinaryRow& row, std::size_t offset);
  Term comparison(const BinaryRow& row, std::size_t offset, const Term& left);
  Term unary();
  Term primary();
  Term name();
  Term call(const std::string& function, std::size_t offset);
  bool is_next(std::string_view sign) const {
    return token_.kind == Token::Kind::sign && token_.sign == sign;
  }
  void expect(std::string_view sign);
  void nest();
  [[noreturn]] void fail_here(const std::string& expected) const;
  [[noreturn]] void fail(std::size_t offset, const std::string& what_is_wrong) const;

  std::string_view text_;
  const NameResolver& names_;
  Lexer lexer_;
  Token token_;  // the next token
  CodeWriter code_;
  int nesting_ = 0;  // the depth of nested parentheses, signs and choices
};

}  // namespace understudy::emulator::world
