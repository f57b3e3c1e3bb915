#include "emulator/world/expression/term.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include "emulator/world/expression/number.h"

namespace understudy::emulator::world {

namespace {

constexpr std::array<BinaryRow, 18> kRows = {{
    {"||", Level::either, Operator::logical_or},
    {"&&", Level::both, Operator::logical_and},
    {"|", Level::bit_or, Operator::bit_or},
    {"^", Level::bit_xor, Operator::bit_xor},
    {"&", Level::bit_and, Operator::bit_and},
    {"==", Level::comparison, Operator::equal},
    {"!=", Level::comparison, Operator::not_equal},
    {"<", Level::comparison, Operator::less},
    {"<=", Level::comparison, Operator::less_or_equal},
    {">", Level::comparison, Operator::greater},
    {">=", Level::comparison, Operator::greater_or_equal},
    {"<<", Level::shift, Operator::shift_left},
    {">>", Level::shift, Operator::shift_right},
    {"+", Level::sum, Operator::add},
    {"-", Level::sum, Operator::subtract},
    {"*", Level::product, Operator::multiply},
    {"/", Level::product, Operator::divide},
    {"%", Level::product, Operator::remainder},
}};

void check_bits(std::string_view sign, const Term& left, const Term& right) {
  if (left.is_real || right.is_real) throw MisfitError("'" + std::string(sign) + "' requires whole numbers");
  const Unit unit = left.unit != Unit::none ? left.unit : right.unit;
  if (unit != Unit::none) {
    throw MisfitError("'" + std::string(sign) + "' requires numbers without a unit, not " + kind_of(unit));
  }
}

Unit unit_of_product(const BinaryRow& row, const Term& left, const Term& right) {
  if (right.unit == Unit::none && row.operation != Operator::remainder) return left.unit;
  if (row.operation != Operator::multiply) {
    check_units(left, right, row.sign);
    return row.operation == Operator::remainder ? right.unit : Unit::none;
  }
  if (left.unit != Unit::none) {
    throw MisfitError("'*' between " + kind_of(left.unit) + " and " + kind_of(right.unit) +
                      "; expected one number without a unit");
  }
  return right.unit;
}

}  // namespace

const BinaryRow* find_binary(std::string_view sign, Level level) {
  const auto* const row = std::find_if(kRows.begin(), kRows.end(), [&](const BinaryRow& candidate) {
    return candidate.level == level && candidate.sign == sign;
  });
  return row == kRows.end() ? nullptr : row;
}

void check_units(const Term& left, const Term& right, std::string_view sign) {
  if (left.unit == right.unit || left.is_zero || right.is_zero) return;
  const Unit unit = left.unit == Unit::none ? right.unit : left.unit;
  throw MisfitError("'" + std::string(sign) + "' between " + kind_of(left.unit) + " and " +
                    kind_of(right.unit) + "; " + kind_of(unit) + " is written like " +
                    (unit == Unit::nanoseconds ? "250ms" : "2.5V"));
}

Term combined(const BinaryRow& row, const Term& left, const Term& right) {
  const std::string sign(row.sign);
  const auto either_is = [&](Term::Shape shape) { return left.shape == shape || right.shape == shape; };
  Term term;
  switch (row.level) {
    case Level::comparison:
      if (left.shape == Term::Shape::comparison) {
        throw MisfitError("comparisons do not chain; write a " + sign + " b && b " + sign + " c");
      }
      if (either_is(Term::Shape::negation)) {
        throw MisfitError("'!' next to '" + sign + "' needs parentheses: !(a " + sign + " b), or (!a) " +
                          sign + " b");
      }
      check_units(left, right, sign);
      term.shape = Term::Shape::comparison;
      break;
    case Level::sum:
      check_units(left, right, sign);
      term.unit = left.is_zero ? right.unit : left.unit;
      term.is_real = left.is_real || right.is_real;
      break;
    case Level::product:
      if (row.operation == Operator::remainder && (left.is_real || right.is_real)) {
        throw MisfitError("'%' requires whole numbers");
      }
      term.unit = unit_of_product(row, left, right);
      term.is_real = left.is_real || right.is_real;
      break;
    default:
      if (either_is(Term::Shape::comparison)) {
        throw MisfitError("'" + sign +
                          "' next to a comparison needs parentheses, because the comparison comes " +
                          "first: (a " + sign + " b) == c");
      }
      check_bits(sign, left, right);
  }
  return term;
}

Term either_of(const Term& left, const Term& right, std::string_view sign) {
  check_units(left, right, sign);
  Term term;
  term.unit = left.is_zero ? right.unit : left.unit;
  term.is_zero = left.is_zero && right.is_zero;
  term.is_real = left.is_real && right.is_real;
  return term;
}

Term negated(Operator operation, const Term& term) {
  Term result;
  if (operation == Operator::logical_not) {
    result.shape = Term::Shape::negation;
    return result;
  }
  if (operation == Operator::bit_not) {
    check_bits("~", term, term);
    return result;
  }
  result = term;
  result.shape = Term::Shape::other;
  return result;
}

}  // namespace understudy::emulator::world
