#include "interpreter/simple2/execution/execution.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/program_watch.h"
#include "interpreter/simple2/dialect.h"
#include "interpreter/simple2/execution/decisions.h"
#include "interpreter/simple2/execution/flow.h"
#include "interpreter/simple2/execution/motion.h"
#include "interpreter/simple2/execution/step.h"
#include "interpreter/simple2/execution/table.h"
#include "interpreter/simple2/instructions.h"
#include "interpreter/simple2/machine.h"
#include "interpreter/simple2/parameter_names.h"
#include "interpreter/simple2/program.h"

namespace understudy::interpreter::simple2 {
namespace {

void finish(Execution& execution, Ending ending) {
  execution = {.ending = ending, .now_line = execution.now_line};
}

bool waited_for_move_goes_on(const Execution& execution, const Dialect& dialect, const MachineView& machine) {
  return (execution.waits_for_a && machine.moving(Axis::a)) ||
         (execution.waits_for_b && machine.moving(Axis::b)) || waits_on(execution, dialect, machine);
}

Line without_flag(const Line& line) {
  return {.command = line.command, .data1 = line.data1, .data2 = line.data2};
}

bool holds(const Execution& execution) { return execution.held.command != 0; }

/// Returns true if the current line is waiting and was replaced in the meantime.
bool must_be_reread(const Execution& execution, const Program& program, const Dialect& dialect) {
  return dialect.rewritten_line == Dialect::RewrittenLine::reread && holds(execution) &&
         without_flag(program.line(execution.now_line)) != execution.held;
}

/// Returns the current line of the program, or the line with which it began to wait.
const Line& line_to_run(const Execution& execution, const Program& program, const Dialect& dialect) {
  const bool as_it_began = dialect.rewritten_line == Dialect::RewrittenLine::waits_on && holds(execution);
  return as_it_began ? execution.held : program.line(execution.next_line);
}

void go_on_at(Execution& execution, int line, const Dialect& dialect) {
  const bool wraps = dialect.after_last_line == Dialect::AfterLastLine::goes_on_at_0;
  execution.next_line = static_cast<std::uint16_t>(wraps ? line % kLineCount : line);
  const LoopState& loop = execution.loop;
  const bool is_inside = execution.next_line >= loop.first_line && execution.next_line <= loop.loop_line;
  if (loop.counts && !is_inside && dialect.loop_left == Dialect::LoopLeft::forgotten) execution.loop = {};
}

bool writes_what_is_read_only(const Line& line) {
  switch (written_by(line.command)) {
    case Written::nothing: return false;
    case Written::data1: return is_read_only(line.data1);
    case Written::data2: return is_read_only(line.data2);
  }
  return false;
}

/// Returns true if the program ends because an operand of the line does not exist or cannot be written.
bool ends_for_an_operand(const Line& line, const Dialect& dialect) {
  const bool by_operand = dialect.undefined_operand == Dialect::UndefinedOperand::ends;
  const bool by_parameter = dialect.undefined_parameter == Dialect::UndefinedParameter::ends;
  const bool by_write = dialect.read_only_parameter == Dialect::ReadOnlyParameter::ends;
  if (by_write && writes_what_is_read_only(line)) return true;
  if (!by_operand && !by_parameter) return false;
  const Instruction* instruction = find_instruction(line.command);
  const auto is_wrong = [&](Operand operand, std::uint8_t value) {
    if (operand == Operand::parameter) return by_parameter && !parameter_name(value);
    return by_operand && !is_defined(operand, value);
  };
  return instruction != nullptr &&
         (is_wrong(instruction->data1, line.data1) || is_wrong(instruction->data2, line.data2));
}

/// Reports the decision of the line.
void report_decision(ProgramWatch& watch, int number, const Line& line, Then then) {
  if (const auto outcome = outcome_of(decision_of(line.command), then)) {
    watch.decides(0, number, *outcome, 1);
  }
}

void execute_line(Execution& execution, std::int64_t now_ms, const Program& program, const Dialect& dialect,
                  Machine& machine) {
  const int number = execution.next_line;
  if (number >= kLineCount) return finish(execution, Ending::past_last_line);
  execution.now_line = static_cast<std::uint8_t>(number);

  const Line line = line_to_run(execution, program, dialect);
  ProgramWatch* const watch = holds(execution) ? nullptr : machine.watch();
  execution.held = {};
  if (watch != nullptr) watch->runs(0, number, 1);
  const Action action = kActions[line.command];
  if (action == nullptr) {
    if (dialect.unknown_command == Dialect::UnknownCommand::ends) {
      return finish(execution, Ending::unknown_command);
    }
    return go_on_at(execution, number + 1, dialect);
  }
  if (ends_for_an_operand(line, dialect)) return finish(execution, Ending::undefined_operand);
  Step step{.line = line,
            .line_number = number,
            .now_ms = now_ms,
            .execution = execution,
            .program = program,
            .dialect = dialect,
            .machine = machine};
  const Then then = action(step);
  if (watch != nullptr) report_decision(*watch, number, line, then);
  if (then == Then::same_line || execution.phase != Phase::line) execution.held = without_flag(line);
  switch (then) {
    case Then::next_line: return go_on_at(execution, number + 1, dialect);
    case Then::line_after_next: return go_on_at(execution, number + 2, dialect);
    case Then::flag: return go_on_at(execution, step.is_void_jump() ? number + 1 : step.flag_line(), dialect);
    case Then::same_line:
      execution.waits = dialect.wait_slot == Dialect::WaitSlot::next_line_runs_in_it;
      return go_on_at(execution, number, dialect);
    case Then::end: return finish(execution, Ending::end_instruction);
    case Then::end_for_nested_loop: return finish(execution, Ending::nested_loop);
    case Then::end_for_cut_wait: return finish(execution, Ending::wait_cut_short);
  }
}

/// Returns true if the next line was already executed and would only continue to wait, as long as the machine
/// does not change.
bool would_wait_on(const Execution& execution, const Program& program, const Dialect& dialect,
                   const MachineView& machine) {
  if (execution.next_line != execution.now_line) return false;
  if (dialect.wait_slot == Dialect::WaitSlot::next_line_runs_in_it && !execution.waits) return false;
  if (!holds(execution) || must_be_reread(execution, program, dialect)) return false;
  const Line& line = line_to_run(execution, program, dialect);
  if (ends_for_an_operand(line, dialect)) return false;
  // The line also waits for an axis that began to move in the meantime.
  const bool all_noted = (execution.waits_for_a || !machine.moving_for_wait(Axis::a)) &&
                         (execution.waits_for_b || !machine.moving_for_wait(Axis::b));
  const bool notes = dialect.wait_cut_short != Dialect::WaitCutShort::line_is_over && !all_noted;
  const auto stays = [&](Then then) { return then == Then::same_line && !notes; };
  switch (line.command) {
    case opcode_of("Wait_IO"): return !wait_io_is_over(line, dialect, machine);
    case opcode_of("Wait_Move_A"):
      return stays(after_wait_move<Axes::a>(line, execution, program, dialect, machine));
    case opcode_of("Wait_Move_B"):
      return !dialect.quirk_wait_move_b_is_move_inc_b_wait &&
             stays(after_wait_move<Axes::b>(line, execution, program, dialect, machine));
    case opcode_of("Wait_Move_ALL"):
      return stays(after_wait_move<Axes::all>(line, execution, program, dialect, machine));
    default: return false;
  }
}

}  // namespace

void start(Execution& execution, std::uint8_t line) {
  execution = {.running = true, .now_line = line, .next_line = line};
}

void stop(Execution& execution) {
  if (execution.running) finish(execution, Ending::stopped);
}

void step(Execution& execution, std::int64_t now_ms, const Program& program, const Dialect& dialect,
          Machine& machine) {
  if (!execution.running) return;
  const bool next_line_runs_at_once = dialect.wait_slot == Dialect::WaitSlot::next_line_runs_in_it;
  if (must_be_reread(execution, program, dialect)) {
    execution = {.running = true,
                 .now_line = execution.now_line,
                 .next_line = execution.now_line,
                 .loop = execution.loop};
  }
  switch (execution.phase) {
    case Phase::line: break;
    case Phase::delay:
      if (now_ms < execution.delay_until_ms) return;
      execution.phase = Phase::line;
      execution.delay_until_ms = 0;
      execution.held = {};
      break;
    case Phase::move:
      if (waited_for_move_goes_on(execution, dialect, machine)) return;
      if (dialect.wait_cut_short == Dialect::WaitCutShort::program_ends &&
          wait_is_cut_short(execution, machine)) {
        return finish(execution, Ending::wait_cut_short);
      }
      execution.phase = Phase::line;
      execution.waits_for_a = false;
      execution.waits_for_b = false;
      execution.held = {};
      if (next_line_runs_at_once) break;
      return;  // the slot that detects the end of the move still belongs to the same line
  }
  const bool has_waited = std::exchange(execution.waits, false);
  execute_line(execution, now_ms, program, dialect, machine);
  // Only a line that has waited passes on its slot, so at most two lines run in a slot.
  if (has_waited && execution.running && !execution.waits && execution.phase == Phase::line) {
    execute_line(execution, now_ms, program, dialect, machine);
  }
}

std::int64_t next_active_slot_ms(const Execution& execution, std::int64_t done_ms, const Program& program,
                                 const Dialect& dialect, const MachineView& machine) {
  if (!execution.running) return kNoSlot;
  const auto first_slot_from = [](std::int64_t ms) { return (ms + kSlotMs - 1) / kSlotMs * kSlotMs; };
  const std::int64_t next = first_slot_from(done_ms + 1);
  if (must_be_reread(execution, program, dialect)) return next;
  switch (execution.phase) {
    case Phase::delay: return std::max(next, first_slot_from(execution.delay_until_ms));
    case Phase::move: return waited_for_move_goes_on(execution, dialect, machine) ? kNoSlot : next;
    case Phase::line: return would_wait_on(execution, program, dialect, machine) ? kNoSlot : next;
  }
  return next;
}

}  // namespace understudy::interpreter::simple2
