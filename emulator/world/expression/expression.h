// Conditions of scenarios, fault triggers and `ctl run-until` (docs/expressions.md):
//   feeder.STATUS.4 == 0 && time >= 250ms
//
// A text is parsed once, and all names and units are checked at that time. The result is a value that can be
// evaluated often without allocating memory, and that refers to the world only through small handles.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/world/expression/number.h"
#include "emulator/world/expression/tokens.h"

namespace understudy::emulator::world {

/// What a name refers to: a handle that the resolver assigns and the value source understands, and a unit. A
/// register is a plain number, even if its manual specifies a unit.
struct NamedNumber {
  std::int32_t handle = 0;
  Unit unit = Unit::none;
};

class NameResolver {
 public:
  virtual ~NameResolver() = default;
  /// Resolves a name: "time", "feeder.STATUS.4", "feeder.A.pulses". The parts of a name are joined by dots,
  /// without quotes or brackets: feeder["Logic Position X"] becomes "feeder.Logic Position X". For an unknown
  /// name, throws a std::runtime_error (such as NameError) with a one-line message that contains the nearest
  /// known name.
  virtual NamedNumber resolve(std::string_view name) const = 0;
};

class ValueSource {
 public:
  virtual ~ValueSource() = default;
  /// Returns the current value. Nanoseconds and millivolts are whole numbers.
  virtual Number value(std::int32_t handle) const = 0;
};

/// An instruction of a stack machine.
struct Instruction {
  enum class Kind : std::uint8_t {
    constant,  // pushes constants[argument]
    name,      // pushes the value of names[argument]
    unary,     // replaces the top value with the result of `operation`
    binary,    // replaces the top two values with the result of `operation`
    within,  // replaces value, centre and tolerance with 1 if the value is within the tolerance, else with 0
    within_share,   // replaces value and centre with the result; the tolerance is `constants[argument]`
                    // millionths of a percent of the centre
    skip_if_false,  // `and`: if the top is false, it becomes 0 and the next `argument` instructions are
                    // skipped; otherwise it is dropped
    skip_if_true,  // `or`: if the top is true, it becomes 1 and the next `argument` instructions are skipped;
                   // otherwise it is dropped
    truth,         // makes the top 0 or 1
    choose,        // drops the top; if it was false, skips the next `argument` instructions
    skip,          // skips the next `argument` instructions
  } kind = Kind::constant;
  Operator operation = Operator::add;
  std::uint16_t offset = 0;  // position in the text, for messages
  std::int32_t argument = 0;
};

/// Created by parse_expression(). A default-constructed expression evaluates to 0.
struct Expression {
  struct Name {
    NamedNumber number;
    std::string spelling;  // as written
  };
  std::string text;
  std::vector<Instruction> code;
  std::vector<Number> constants;
  std::vector<Name> names;  // all names in the order of the text, without duplicates
  int stack_depth = 1;      // the maximum number of values on the stack
};

/// Throws ExpressionError.
Expression parse_expression(std::string_view text, const NameResolver& names);

/// Throws ExpressionError if there is no result (division by zero, overflow, a bit of a real number). The
/// message contains the values that were involved.
Number evaluate(const Expression& expression, const ValueSource& source);
inline bool is_true(const Expression& expression, const ValueSource& source) {
  return evaluate(expression, source).is_true();
}

/// Returns the expression as it was written, on one line.
std::string to_text(const Expression& expression);
/// Returns the text, followed by the current value of each name: "feeder.STATUS.4 == 0  (feeder.STATUS.4 is
/// 1)".
std::string explain(const Expression& expression, const ValueSource& source);

/// Returns the handles of all names in the expression. The value can change only when one of them changes.
std::vector<std::int32_t> names_in(const Expression& expression);

}  // namespace understudy::emulator::world
