// The properties of a part of an expression before it is evaluated, and the rules for combining parts.
#pragma once

#include <string>
#include <string_view>

#include "emulator/world/expression/number.h"

namespace understudy::emulator::world {

struct Term {
  enum class Shape : std::uint8_t {
    other,
    comparison,
    negation
  } shape = Shape::other;  // without parentheses
  Unit unit = Unit::none;
  bool is_zero = false;  // a literal 0, which is compatible with all units
  bool is_real = false;  // certainly real; the value of a name may also be real
};

/// The precedence levels of C, except that all comparisons have the same level and cannot be chained. A
/// higher level binds tighter.
enum class Level : std::uint8_t {
  either,
  both,
  bit_or,
  bit_xor,
  bit_and,
  comparison,
  shift,
  sum,
  product,
  unary
};

struct BinaryRow {
  std::string_view sign;
  Level level;
  Operator operation;
};
/// Returns null if `sign` is not an operator of this level.
const BinaryRow* find_binary(std::string_view sign, Level level);

/// Thrown if two terms cannot be combined. The message contains the reason.
struct MisfitError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// All of these functions throw MisfitError. `sign` is the operator between the two terms.
void check_units(const Term& left, const Term& right, std::string_view sign);
/// Returns `left sign right`, for all levels except the two logical levels and `unary`.
Term combined(const BinaryRow& row, const Term& left, const Term& right);
/// Returns the term for a choice between two terms, as in `a ? b : c` or min(b, c).
Term either_of(const Term& left, const Term& right, std::string_view sign);
Term negated(Operator operation, const Term& term);

}  // namespace understudy::emulator::world
