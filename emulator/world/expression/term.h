// What is known about a part of an expression before it is evaluated, and which parts fit together.
#pragma once

#include <string>
#include <string_view>

#include "emulator/world/expression/number.h"

namespace understudy::emulator::world {

struct Term {
  enum class Form : std::uint8_t { other, comparison, negation } form = Form::other;  // without parentheses
  Unit unit = Unit::none;
  bool is_zero = false;  // a literal 0, which fits every unit
  bool is_real = false;  // for certain; a name may turn out so
};

/// The signs of C, but one level for all comparisons, which do not chain. A higher level binds tighter.
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
/// Null if it is not a sign of that level.
const BinaryRow* find_binary(std::string_view sign, Level level);

/// Two terms do not fit, and why.
struct MisfitError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// All throw MisfitError. `sign` is what stands between the two.
void check_units(const Term& left, const Term& right, std::string_view sign);
/// `left sign right`, of every level but the two logical ones and unary.
Term combined(const BinaryRow& row, const Term& left, const Term& right);
/// One or the other: of `a ? b : c`, or of min(b, c).
Term either_of(const Term& left, const Term& right, std::string_view sign);
Term negated(Operator operation, const Term& term);

}  // namespace understudy::emulator::world
