// Conditions as scenarios, fault triggers and `ctl run-until` write them (docs/expressions.md):
//   feeder.STATUS.4 == 0 && time >= 250ms
// Text is parsed once, all names looked up and all units checked; what is left is a value that is evaluated
// as often as needed without allocating, and that knows the world only by small handles.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/world/expression/number.h"
#include "emulator/world/expression/tokens.h"

namespace understudy::emulator::world {

/// What a name stands for: a handle that the resolver chose and the source of values knows, and what it
/// counts. A register is a plain number, whatever unit its manual gives it.
struct NamedNumber {
  std::int32_t handle = 0;
  Unit unit = Unit::none;
};

class NameResolver {
 public:
  virtual ~NameResolver() = default;
  /// `name` is "time", "feeder.STATUS.4", "feeder.A.pulses": parts joined by dots, quotes and brackets
  /// gone: feeder["Logic Position X"] is "feeder.Logic Position X".
  /// If it is not known: a std::runtime_error (NameError for example) that says so in one line and names
  /// the nearest that is.
  virtual NamedNumber resolve(std::string_view name) const = 0;
};

class ValueSource {
 public:
  virtual ~ValueSource() = default;
  /// The present value; nanoseconds and millivolts are whole.
  virtual Number value(std::int32_t handle) const = 0;
};

/// One step of a stack machine.
struct Instruction {
  enum class Kind : std::uint8_t {
    constant,       // push constants[argument]
    name,           // push the value of names[argument]
    unary,          // replace the top by `operation` of it
    binary,         // replace the two on top by `operation` of them
    within,         // replace value, centre and tolerance by whether the value is within
    within_share,   // replace value and centre by the same; the tolerance is `constants[argument]` millionths
                    // of a percent of the centre
    skip_if_false,  // `and`: a false top becomes 0 and the next `argument` instructions are left out, a true
                    // one is dropped
    skip_if_true,   // `or`: a true top becomes 1 and ..., a false one is dropped
    truth,          // the top becomes 0 or 1
    choose,         // drop the top; if it was false, leave out the next `argument` instructions
    skip,           // leave out the next `argument` instructions
  } kind = Kind::constant;
  Operator operation = Operator::add;
  std::uint16_t offset = 0;  // in the text, for messages
  std::int32_t argument = 0;
};

/// Made by parse_expression(). One that was not parsed is 0.
struct Expression {
  struct Name {
    NamedNumber number;
    std::string spelling;  // as written
  };
  std::string text;
  std::vector<Instruction> code;
  std::vector<Number> constants;
  std::vector<Name> names;  // each once, in the order of the text
  int stack_depth = 1;      // how many values the code needs at a time
};

/// ExpressionError.
Expression parse_expression(std::string_view text, const NameResolver& names);

/// ExpressionError if there is no result (division by zero, overflow, a bit of a real number); its line
/// shows the values that led to it.
Number evaluate(const Expression& expression, const ValueSource& source);
inline bool is_true(const Expression& expression, const ValueSource& source) {
  return evaluate(expression, source).is_true();
}

/// As written, on one line.
std::string to_text(const Expression& expression);
/// The same with the present value of each name: "feeder.STATUS.4 == 0  (feeder.STATUS.4 is 1)".
std::string explain(const Expression& expression, const ValueSource& source);

/// The handles of all names in it: it can change only when one of them does.
std::vector<std::int32_t> names_in(const Expression& expression);

}  // namespace understudy::emulator::world
