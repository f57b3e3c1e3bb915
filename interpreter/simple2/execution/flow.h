// Instructions that determine the next line: jumps, loops, delays, and waits for an input.
#pragma once

#include "interpreter/simple2/execution/step.h"

namespace understudy::interpreter::simple2 {

inline Then nop(Step&) { return Then::next_line; }
inline Then end(Step&) { return Then::end; }
inline Then jump(Step&) { return Then::flag; }

// --- inputs and STATUS ---------------------------------------------------------------------------

/// An input that does not exist is OFF, and a bit that does not exist is 0.
inline bool input(const MachineView& machine, std::uint8_t din) {
  return is_defined(Operand::input, din) && machine.input(din);
}
inline bool status_bit(const MachineView& machine, std::uint8_t bit) {
  return is_defined(Operand::status_bit, bit) && machine.status_bit(bit);
}

inline bool wait_io_is_over(const Line& line, const Dialect& dialect, const MachineView& machine) {
  return input(machine, line.data1) == is_on(dialect, line.data2);
}

inline Then wait_io(Step& step) {
  return wait_io_is_over(step.line, step.dialect, step.machine) ? Then::next_line : Then::same_line;
}

template <bool level>
Then jump_input(Step& step) {
  return jump_if(input(step.machine, step.line.data2) == level);
}

template <bool level>
Then jump_status(Step& step) {
  return jump_if(status_bit(step.machine, step.line.data2) == level);
}

// --- delays --------------------------------------------------------------------------------------

inline Then delay(Step& step, std::int64_t amount_ms) {
  const bool slot_comes_extra = step.dialect.delay_counts == Dialect::DelayCounts::before_next_slot;
  step.execution.phase = Phase::delay;
  step.execution.delay_until_ms = step.now_ms + (slot_comes_extra ? amount_ms + kSlotMs : amount_ms);
  return Then::next_line;
}

inline std::int32_t amount(const Line& line) { return line.data1 | line.data2 << 8; }

inline Then delay_direct(Step& step) { return delay(step, amount(step.line)); }
inline Then delay_parameter(Step& step) {
  return delay(step, fitted(step.dialect, step.first_parameter(), 0, 65535));
}

// --- Loop ----------------------------------------------------------------------------------------

inline bool is_valid_loop(const Program& program, int line) {
  const Line& code = program.line(line);
  return code.command == opcode_of("Loop") && program.line_with_flag(code.data1).value_or(0) < line;
}

inline Then loop(Step& step) {
  const int first = step.flag_line();
  const int here = step.line_number;
  LoopState& state = step.execution.loop;
  if (first >= here || step.is_void_jump()) return Then::next_line;  // rule 1: no effect

  const bool is_counting_here = state.counts && state.loop_line == here;
  if (state.counts && !is_counting_here && here >= state.first_line && here <= state.loop_line) {
    return Then::end_for_nested_loop;  // rule 2
  }
  if (step.dialect.loop_nesting == Dialect::LoopNesting::when_outer_starts) {
    for (int line = first; line < here; ++line) {
      if (is_valid_loop(step.program, line)) return Then::end_for_nested_loop;
    }
  }

  if (!is_counting_here) state = {.counts = true, .loop_line = static_cast<std::uint8_t>(here), .passes = 1};
  state.first_line = static_cast<std::uint8_t>(first);  // the flag may have moved in the meantime
  const int count = step.line.data2;
  if (count == 0) return Then::flag;  // endless
  const bool counts_further = step.dialect.loop_count == Dialect::LoopCount::further_passes;
  const int passes_wanted = counts_further ? count + 1 : count;
  if (state.passes < passes_wanted) {
    ++state.passes;
    return Then::flag;
  }
  state = {};
  return Then::next_line;
}

inline constexpr ActionRow kFlowActions[] = {
    {"NOP", nop},
    {"Wait_IO", wait_io},
    {"Delay_mSec", delay_direct},
    {"Delay_mSec_VAR", delay_parameter},
    {"Jump", jump},
    {"Loop", loop},
    {"Jump_IN_ON", jump_input<true>},
    {"Jump_IN_OFF", jump_input<false>},
    {"Jump_STATUS_ON", jump_status<true>},
    {"Jump_STATUS_OFF", jump_status<false>},
    {"END", end},
};

}  // namespace understudy::interpreter::simple2
