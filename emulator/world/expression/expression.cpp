#include "emulator/world/expression/expression.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/world/expression/code_writer.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/parser.h"
#include "emulator/world/expression/tokens.h"

namespace understudy::emulator::world {

namespace {

Number present_value(const Expression::Name& name, const ValueSource& source) {
  const Number value = source.value(name.number.handle);
  if (!value.is_whole() && !std::isfinite(value.real())) {
    throw ArithmeticError(name.spelling + " is not a finite number");
  }
  return value;
}

bool is_within(Number value, Bounds bounds) { return value >= bounds.low && value <= bounds.high; }

// Returns "(feeder.STATUS.4 is 1, time is 3.05s)", or an empty text if there are no names.
std::string present_values(const Expression& expression, const ValueSource& source) {
  std::string text;
  for (const Expression::Name& name : expression.names) {
    text += (text.empty() ? "(" : ", ") + on_one_line(name.spelling) + " is " +
            number_text(source.value(name.number.handle), name.number.unit);
  }
  return text.empty() ? text : text + ")";
}

template <std::size_t stack_depth>
Number run(const Expression& expression, const ValueSource& source, const Instruction*& at) {
  std::array<Number, stack_depth> stack;
  std::size_t top = 0;  // the size of the stack
  const auto pop = [&] { return stack[--top]; };
  const std::vector<Instruction>& code = expression.code;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const Instruction& step = code[i];
    at = &step;
    const auto argument = static_cast<std::size_t>(step.argument);
    switch (step.kind) {
      case Instruction::Kind::constant: stack[top++] = expression.constants[argument]; break;
      case Instruction::Kind::name: stack[top++] = present_value(expression.names[argument], source); break;
      case Instruction::Kind::unary: stack[top - 1] = apply(step.operation, stack[top - 1]); break;
      case Instruction::Kind::binary: {
        const Number right = pop();
        stack[top - 1] = apply(step.operation, stack[top - 1], right);
        break;
      }
      case Instruction::Kind::within: {
        const Number tolerance = pop();
        const Number centre = pop();
        stack[top - 1] = is_within(stack[top - 1], bounds_around(centre, tolerance));
        break;
      }
      case Instruction::Kind::within_share: {
        const Number centre = pop();
        const Number tolerance = share_of(centre, expression.constants[argument].whole());
        stack[top - 1] = is_within(stack[top - 1], bounds_around(centre, tolerance));
        break;
      }
      case Instruction::Kind::skip_if_false:
      case Instruction::Kind::skip_if_true:
        if (stack[top - 1].is_true() == (step.kind == Instruction::Kind::skip_if_true)) {
          stack[top - 1] = stack[top - 1].is_true();
          i += argument;
        } else {
          --top;
        }
        break;
      case Instruction::Kind::truth: stack[top - 1] = stack[top - 1].is_true(); break;
      case Instruction::Kind::choose:
        if (!pop().is_true()) i += argument;
        break;
      case Instruction::Kind::skip: i += argument; break;
    }
  }
  return stack[0];
}

}  // namespace

Expression parse_expression(std::string_view text, const NameResolver& names) {
  ExpressionParser parser(text, names);
  parser.expression();
  parser.expect_end();
  return parser.take();
}

Number evaluate(const Expression& expression, const ValueSource& source) {
  const Instruction* at = nullptr;
  try {
    // Nearly all expressions need only a small stack, and clearing the largest possible stack would take
    // longer than evaluating them.
    constexpr int kUsual = 8;
    return expression.stack_depth <= kUsual ? run<kUsual>(expression, source, at)
                                            : run<kDeepestStack>(expression, source, at);
  } catch (const ArithmeticError& error) {
    const std::string values = present_values(expression, source);
    throw ExpressionError(expression.text, at->offset, error.what() + (values.empty() ? "" : "  " + values));
  }
}

std::string to_text(const Expression& expression) { return on_one_line(expression.text); }

std::string explain(const Expression& expression, const ValueSource& source) {
  const std::string values = present_values(expression, source);
  return to_text(expression) + (values.empty() ? "" : "  " + values);
}

std::vector<std::int32_t> names_in(const Expression& expression) {
  std::vector<std::int32_t> handles;
  handles.reserve(expression.names.size());
  for (const Expression::Name& name : expression.names) handles.push_back(name.number.handle);
  return handles;
}

}  // namespace understudy::emulator::world
