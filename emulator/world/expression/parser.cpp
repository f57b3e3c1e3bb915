#include "emulator/world/expression/parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/term.h"

namespace understudy::emulator::world {

namespace {

constexpr int kDeepestNesting = 64;

// A sign that people write by mistake, and the corresponding message.
struct Hint {
  std::string_view sign;
  std::string_view text;
};
constexpr std::array<Hint, 4> kHints = {{
    {"=", "'=' is not an operator; expected '==' to compare"},
    {"<>", "'<>' is not an operator; expected '!='"},
    {"+-",
     "'+-' is not allowed here; expected it once, after '==' or '!=' and a value, as in x == 3050 +- 2"},
    {"..", "a range is not allowed here; expected low <= x && x <= high"},
}};

struct ExpressionFunctionRow {
  std::string_view name;
  Operator operation;
  bool folds;  // accepts two or more arguments, and combines them pair by pair
};
constexpr std::array<ExpressionFunctionRow, 3> kExpressionFunctions = {
    {{"abs", Operator::absolute, false}, {"max", Operator::maximum, true}, {"min", Operator::minimum, true}}};

/// Returns our word for a word that other languages use for on or off, or an empty text for any other word.
std::string_view switch_word(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kWords = {
      {{"yes", "on"}, {"Yes", "on"}, {"YES", "on"}, {"no", "off"}, {"No", "off"}, {"NO", "off"}}};
  for (const auto& [foreign, ours] : kWords) {
    if (foreign == word) return ours;
  }
  return {};
}

// Returns the next higher precedence level.
Level above(Level level) { return static_cast<Level>(static_cast<int>(level) + 1); }

}  // namespace

ExpressionParser::ExpressionParser(std::string_view text, const NameResolver& names)
    : text_(text), names_(names), lexer_(text) {
  code_.set_text(text);
  token_ = lexer_.next();
}

void ExpressionParser::fail(std::size_t offset, const std::string& what_is_wrong) const {
  throw ExpressionError(text_, offset, what_is_wrong);
}

void ExpressionParser::fail_here(const std::string& expected) const {
  for (const Hint& hint : kHints) {
    if (is_next(hint.sign)) fail(offset(), std::string(hint.text));
  }
  const std::string found = at_end() ? "end" : quoted(text_.substr(token_.begin, token_.end - token_.begin));
  fail(offset(), "unexpected " + found + "; expected " + expected);
}

bool ExpressionParser::skip(std::string_view sign) {
  if (!is_next(sign)) return false;
  token_ = lexer_.next();
  return true;
}

void ExpressionParser::expect(std::string_view sign) {
  if (!skip(sign)) fail_here("'" + std::string(sign) + "'");
}

void ExpressionParser::expect_end() const {
  if (!at_end()) fail_here("an operator or the end");
}

void ExpressionParser::nest() {
  if (++nesting_ > kDeepestNesting) {
    fail(offset(), "nested too deeply; expected at most " + std::to_string(kDeepestNesting) + " levels");
  }
}

// --- the grammar, from the loosest rule to the tightest ------------------------------------------

Term ExpressionParser::expression() {
  nest();
  Term term = level(Level::either);
  const std::size_t question = offset();
  if (skip("?")) {
    const std::size_t if_false = code_.emit_jump(Instruction::Kind::choose, question);
    const Term chosen = expression();
    const std::size_t colon = offset();
    expect(":");
    const std::size_t done = code_.emit_jump(Instruction::Kind::skip, colon);
    code_.land(if_false);
    code_.drop_value();
    const Term other = expression();
    code_.land(done);
    try {
      term = either_of(chosen, other, ":");
    } catch (const MisfitError& error) {
      fail(colon, error.what());
    }
  }
  --nesting_;
  return term;
}

Term ExpressionParser::level(Level level) {
  if (level == Level::unary) return unary();
  Term left = this->level(above(level));
  while (token_.kind == Token::Kind::sign) {
    const BinaryRow* const row = find_binary(token_.sign, level);
    if (row == nullptr) break;
    const std::size_t offset = token_.begin;
    token_ = lexer_.next();
    try {
      if (level == Level::either || level == Level::both) {
        left = logical(*row, offset);
      } else if (level == Level::comparison) {
        left = comparison(*row, offset, left);
      } else {
        left = combined(*row, left, this->level(above(level)));
        code_.emit(Instruction::Kind::binary, offset, row->operation);
      }
    } catch (const MisfitError& error) {
      fail(offset, error.what());
    }
  }
  return left;
}

Term ExpressionParser::logical(const BinaryRow& row, std::size_t offset) {
  const bool is_or = row.operation == Operator::logical_or;
  const std::size_t decided =
      code_.emit_jump(is_or ? Instruction::Kind::skip_if_true : Instruction::Kind::skip_if_false, offset);
  level(above(row.level));
  code_.emit(Instruction::Kind::truth, offset);
  code_.land(decided);
  return {};
}

Term ExpressionParser::comparison(const BinaryRow& row, std::size_t offset, const Term& left) {
  const Term right = level(above(row.level));
  const Term compared = combined(row, left, right);
  const std::size_t tolerance_offset = this->offset();
  const bool is_equality = row.operation == Operator::equal || row.operation == Operator::not_equal;
  if (!is_equality || !skip("+-")) {
    code_.emit(Instruction::Kind::binary, offset, row.operation);
    return compared;
  }
  if (std::int64_t millionths = 0; percentage(millionths)) {
    code_.emit_within_share(millionths, tolerance_offset);
  } else {
    const Term tolerance = level(above(row.level));
    try {
      check_units(left.is_zero ? right : left, tolerance, "+-");
    } catch (const MisfitError& error) {
      fail(tolerance_offset, error.what());
    }
    code_.emit(Instruction::Kind::within, tolerance_offset);
  }
  if (row.operation == Operator::not_equal) {
    code_.emit(Instruction::Kind::unary, offset, Operator::logical_not);
  }
  return compared;
}

bool ExpressionParser::percentage(std::int64_t& millionths) {
  // There is no blank between a number and a percent sign, unlike before a remainder operator.
  const bool is_percentage = token_.kind == Token::Kind::number && text_.substr(token_.end).starts_with('%');
  if (!is_percentage) return false;
  if (token_.unit != Unit::none) fail(offset(), "'%' after " + kind_of(token_.unit) + "; expected a number");
  constexpr std::int64_t kMax = 1'000'000;
  if (token_.number > kMax) fail(offset(), "expected a tolerance of at most a million percent");
  // Rounding removes the error of the real number, because six decimal places times a million are a whole
  // number.
  millionths = std::llround(token_.number.real() * static_cast<double>(kPercent));
  token_ = lexer_.next();
  expect("%");
  return true;
}

Term ExpressionParser::unary() {
  const std::size_t begin = offset();
  Operator operation = Operator::negate;
  if (skip("!")) {
    operation = Operator::logical_not;
  } else if (skip("~")) {
    operation = Operator::bit_not;
  } else if (!skip("-")) {
    return primary();
  }
  nest();
  const Term operand = unary();
  --nesting_;
  code_.emit(Instruction::Kind::unary, begin, operation);
  try {
    return negated(operation, operand);
  } catch (const MisfitError& error) {
    fail(begin, error.what());
  }
}

Term ExpressionParser::primary() {
  Term term;
  if (token_.kind == Token::Kind::name) return name();
  if (token_.kind == Token::Kind::number) {
    term.unit = token_.unit;
    term.is_real = !token_.number.is_whole();
    term.is_zero = term.unit == Unit::none && token_.number == 0;
    code_.emit_constant(token_.number, offset());
    token_ = lexer_.next();
    return term;
  }
  if (!skip("(")) fail_here("a name, a number or '('");
  term = expression();
  expect(")");
  term.shape = Term::Shape::other;
  return term;
}

Term ExpressionParser::name() {
  const Token token = token_;
  token_ = lexer_.next();
  if (is_next("(")) return call(token.name, token.begin);
  NamedNumber number;
  try {
    number = names_.resolve(token.name);
  } catch (const std::runtime_error& error) {
    if (const std::string_view word = switch_word(token.name); !word.empty()) {
      fail(token.begin, quoted(token.name) + " is unknown here; expected " + std::string(word));
    }
    fail(token.begin, error.what());
  }
  code_.emit_name(number, text_.substr(token.begin, token.end - token.begin), token.begin);
  Term term;
  term.unit = number.unit;
  return term;
}

Term ExpressionParser::call(const std::string& function, std::size_t offset) {
  const auto* const row =
      std::find_if(kExpressionFunctions.begin(), kExpressionFunctions.end(),
                   [&](const ExpressionFunctionRow& known) { return known.name == function; });
  if (row == kExpressionFunctions.end()) {
    std::vector<std::string> known;
    for (const ExpressionFunctionRow& candidate : kExpressionFunctions) known.emplace_back(candidate.name);
    fail(offset, "no function is called " + quoted(function) + suggestion(function, known));
  }
  expect("(");
  Term term = expression();
  if (row->folds && !is_next(",")) fail_here("',' and another value");
  if (!row->folds) code_.emit(Instruction::Kind::unary, offset, row->operation);
  while (row->folds && is_next(",")) {
    const std::size_t comma = this->offset();
    expect(",");
    const Term next = expression();
    try {
      term = either_of(term, next, ",");
    } catch (const MisfitError& error) {
      fail(comma, error.what());
    }
    code_.emit(Instruction::Kind::binary, offset, row->operation);
  }
  expect(")");
  term.shape = Term::Shape::other;
  return term;
}

}  // namespace understudy::emulator::world
