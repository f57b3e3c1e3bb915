#include "interpreter/slim/state_fields.h"

#include <cmath>
#include <string>
#include <vector>
#include "base/state/state_bytes.h"
#include "base/state/state_error.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/events.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/program.h"

namespace understudy {

namespace lang = interpreter::slim;

namespace {

/// Options with which a program can contain everything that any device can contain.
constexpr lang::Options kAnyProgram = [] {
  lang::Options options = lang::kWidestDialect;
  options.choose(lang::option("program_size", "4000_lines"));
  options.choose(lang::option("program_check", "when_it_runs"));
  return options;
}();

}  // namespace

void StateOf<lang::Operand>::check(const lang::Operand& operand) {
  using Kind = lang::Operand::Kind;
  require_state(std::isfinite(operand.number), "a number is not finite");
  const bool of_array = is_array(operand.kind) && !operand.index_is_variable;
  const bool of_variables = is_variable(operand.kind) && !of_array;
  const int max = of_array                          ? lang::kArrayCount - 1
                  : of_variables                    ? lang::kVariableCount - 1
                  : operand.kind == Kind::condition ? static_cast<int>(lang::Condition::not_greater)
                                                    : 8;
  require_within(operand.index, 0, max);
}

void StateOf<lang::Event>::check(const lang::Event& event) {
  // The number of operands depends on the condition.
  const bool compares = event.condition >= lang::Condition::equal;
  require_state(!event.has_condition || event.operands.size() == (compares ? 2U : 1U),
                "an event checks something else");
}

void StateOf<lang::Execution>::check(const lang::Execution& execution) {
  require_reach(execution.until_ms);
  require_state(execution.stack.size() <= 1000, "a program is nested too deep");
  require_state(std::isfinite(execution.number), "a number is not finite");
}

void StateOf<lang::Program>::write(const lang::Program& program, StateWriter& writer) {
  writer.write(program.texts());
}

void StateOf<lang::Program>::read(lang::Program& program, StateReader& reader) {
  std::vector<std::string> texts;
  reader.read(texts);
  require_state(program.set_texts(texts, kAnyProgram), "a line is not a line of a program");
}

}  // namespace understudy
