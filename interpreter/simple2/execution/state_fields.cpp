#include "interpreter/simple2/execution/state_fields.h"

#include <cstdint>

#include "base/simulated_time.h"
#include "base/state/state_bytes.h"
#include "base/state/state_error.h"
#include "interpreter/simple2/execution/execution.h"
#include "interpreter/simple2/program.h"

namespace understudy {

using interpreter::simple2::Execution;
using interpreter::simple2::Program;

void StateOf<Execution>::check(const Execution& execution) {
  require_within(execution.delay_until_ms, 0, tick_at(kHorizon) * 2);
}

void StateOf<Program>::write(const Program& program, StateWriter& writer) {
  writer.write(program.lines());
  writer.write(program.flag_rules());
  writer.write(program.flag_lines());
}

void StateOf<Program>::read(Program& program, StateReader& reader) {
  interpreter::simple2::Lines lines;
  reader.read(lines);
  interpreter::simple2::FlagRules rules;
  reader.read(rules);
  interpreter::simple2::FlagLines flag_lines{};
  reader.read(flag_lines);
  for (const std::int16_t line : flag_lines) require_within(line, -1, interpreter::simple2::kLineCount - 1);
  program = Program(lines, rules, flag_lines);
}

}  // namespace understudy
