#include "emulator/world/expression/tolerance.h"
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/text/one_line.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/parser.h"
#include "emulator/world/expression/term.h"
#include "emulator/world/expression/tokens.h"

namespace understudy::emulator::world {

namespace {

class NoNames : public NameResolver {
 public:
  NamedNumber resolve(std::string_view name) const override {
    throw std::runtime_error("a name, " + quoted(name) +
                             ", where a value, a tolerance or a range is expected");
  }
};

class NoValues : public ValueSource {
 public:
  Number value(std::int32_t /*handle*/) const override { return {}; }
};

Number read_value(ExpressionParser& parser, std::string_view text, Unit unit) {
  const std::size_t begin = parser.offset();
  const Term term = parser.expression();
  if (term.unit != unit && !term.is_zero) {
    throw ExpressionError(text, begin,
                          kind_of(term.unit) + " where " + kind_of(unit) + " is expected" +
                              (unit == Unit::nanoseconds  ? ", such as 3050ms"
                               : unit == Unit::millivolts ? ", such as 2.5V"
                                                          : ", without a unit"));
  }
  return evaluate(parser.take(), NoValues());
}

std::string trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kSpace);
  return begin == std::string_view::npos
             ? std::string()
             : std::string(text.substr(begin, text.find_last_not_of(kSpace) + 1 - begin));
}

}  // namespace

Tolerance parse_tolerance(std::string_view text, Unit unit) {
  const NoNames names;
  ExpressionParser parser(text, names);
  Tolerance tolerance;
  tolerance.text = on_one_line(trimmed(text));
  const std::size_t begin = parser.offset();
  if (parser.skip("..")) {
    tolerance.high = read_value(parser, text, unit);
    parser.expect_end();
    return tolerance;
  }
  const Number value = read_value(parser, text, unit);
  const std::size_t sign = parser.offset();
  if (parser.skip("+-")) {
    try {
      std::int64_t millionths = 0;
      const Number width =
          parser.percentage(millionths) ? share_of(value, millionths) : read_value(parser, text, unit);
      const Bounds bounds = bounds_around(value, width);
      tolerance.low = bounds.low;
      tolerance.high = bounds.high;
    } catch (const ArithmeticError& error) {
      throw ExpressionError(text, sign, error.what());
    }
  } else if (parser.skip("..")) {
    tolerance.low = value;
    if (!parser.at_end()) tolerance.high = read_value(parser, text, unit);
    if (tolerance.high && *tolerance.high < value) {
      throw ExpressionError(text, begin, "the range ends before it begins");
    }
  } else {
    tolerance.low = tolerance.high = value;
  }
  parser.expect_end();
  return tolerance;
}

}  // namespace understudy::emulator::world
