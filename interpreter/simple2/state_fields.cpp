#include "interpreter/simple2/state_fields.h"

#include <cstdint>

#include "base/simulated_time.h"

namespace understudy {

using interpreter::simple2::Execution;
using interpreter::simple2::Program;

void StateOf<Execution>::check(const Execution& execution) {
  demand_within(execution.delay_until_ms, 0, tick_at(kHorizon) * 2);
}

void StateOf<Program>::write(const Program& program, StateWriter& writer) {
  writer.put_value(program.lines());
  writer.put_value(program.flag_rules());
  writer.put_value(program.flag_lines());
}

void StateOf<Program>::read(Program& program, StateReader& reader) {
  interpreter::simple2::Lines lines;
  reader.take_value(lines);
  interpreter::simple2::FlagRules rules;
  reader.take_value(rules);
  interpreter::simple2::FlagLines flag_lines{};
  reader.take_value(flag_lines);
  for (const std::int16_t line : flag_lines) demand_within(line, -1, interpreter::simple2::kLineCount - 1);
  program = Program(lines, rules, flag_lines);
}

}  // namespace understudy
