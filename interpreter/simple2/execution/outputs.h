// Instructions for outputs, counters and timers.
#pragma once

#include <algorithm>

#include "interpreter/simple2/execution/step.h"

namespace understudy::interpreter::simple2 {

// --- outputs -------------------------------------------------------------------------------------

inline constexpr std::uint8_t kAllOutputs = (1U << kOutputCount) - 1;

constexpr std::uint8_t levels(const Dialect& dialect, std::uint8_t logic) {
  return is_on(dialect, logic) ? kAllOutputs : 0;
}

inline Then out(Step& step) {
  if (!is_defined(Operand::output, step.line.data1)) return Then::next_line;
  step.machine.set_outputs(static_cast<std::uint8_t>(1U << step.line.data1),
                           levels(step.dialect, step.line.data2));
  return Then::next_line;
}

inline Then out_all(Step& step) {
  step.machine.set_outputs(kAllOutputs, levels(step.dialect, step.line.data1));
  return Then::next_line;
}

inline Then out_array(Step& step) {
  step.machine.set_outputs(kAllOutputs, step.line.data1 & kAllOutputs);
  return Then::next_line;
}

inline Then out_array_select(Step& step) {
  step.machine.set_outputs(step.line.data1 & kAllOutputs, levels(step.dialect, step.line.data2));
  return Then::next_line;
}

// --- counters ------------------------------------------------------------------------------------

constexpr int counter_parameter(int counter) { return kCounter1 + counter - 1; }

inline Then set_counter(Step& step, std::int32_t value) {
  if (!is_defined(Operand::counter, step.line.data1)) return Then::next_line;
  const bool saturates = step.dialect.counter_overflow == Dialect::CounterOverflow::saturates;
  step.machine.set_parameter(counter_parameter(step.line.data1),
                             saturates ? std::clamp(value, 0, 65535) : value & 0xFFFF);
  return Then::next_line;
}

inline Then counter_clear(Step& step) { return set_counter(step, 0); }
inline Then counter_value(Step& step) { return set_counter(step, step.second_parameter()); }

template <int change>
Then counter_count(Step& step) {
  if (!is_defined(Operand::counter, step.line.data1)) return Then::next_line;
  const auto value = static_cast<std::uint16_t>(step.machine.parameter(counter_parameter(step.line.data1)));
  return set_counter(step, value + change);
}

template <int counter>
Then jump_counter_equal(Step& step) {
  return jump_if(step.machine.parameter(counter_parameter(counter)) == step.second_parameter());
}

template <int counter>
Then jump_counter_greater(Step& step) {
  return jump_if(step.machine.parameter(counter_parameter(counter)) > step.second_parameter());
}

template <int counter>
Then jump_counter_zero(Step& step) {
  return jump_if(step.machine.parameter(counter_parameter(counter)) == 0);
}

template <int counter>
Then jump_counter_above_zero(Step& step) {
  return jump_if(step.machine.parameter(counter_parameter(counter)) > 0);
}

// --- timers --------------------------------------------------------------------------------------

constexpr int timer_parameter(int timer) { return kTimer1 + timer - 1; }

template <bool run>
Then timer_run(Step& step) {
  if (is_defined(Operand::timer, step.line.data1)) step.machine.run_timer(step.line.data1, run);
  return Then::next_line;
}

inline Then set_timer(Step& step, std::int32_t value) {
  if (is_defined(Operand::timer, step.line.data1))
    step.machine.set_parameter(timer_parameter(step.line.data1), value);
  return Then::next_line;
}

inline Then timer_reset(Step& step) { return set_timer(step, 0); }
inline Then timer_value(Step& step) { return set_timer(step, step.second_parameter()); }

/// Timers and their limits are unsigned 32-bit numbers, unless a choice says otherwise.
template <int timer>
Then jump_timer_reached(Step& step) {
  if (timer == 1 && step.dialect.quirk_jump_timer1_does_not_work) {
    return jump_if(step.dialect.timer1_defect == Dialect::Timer1Defect::always_jumps);
  }
  const std::int32_t time = step.machine.parameter(timer_parameter(timer));
  const std::int32_t limit = step.second_parameter();
  if (step.dialect.timer_compare == Dialect::TimerCompare::with_sign) return jump_if(time >= limit);
  return jump_if(static_cast<std::uint32_t>(time) >= static_cast<std::uint32_t>(limit));
}

inline constexpr ActionRow kOutputActions[] = {
    {"Out", out},
    {"Out_ALL", out_all},
    {"Out_Array", out_array},
    {"Out_Array_Select", out_array_select},

    {"Counter_Clear", counter_clear},
    {"Counter_Increase", counter_count<+1>},
    {"Counter_Decrease", counter_count<-1>},
    {"Counter_Value", counter_value},
    {"Jump_Counter1_EQ", jump_counter_equal<1>},
    {"Jump_Counter1_GT", jump_counter_greater<1>},
    {"Jump_Counter2_EQ", jump_counter_equal<2>},
    {"Jump_Counter2_GT", jump_counter_greater<2>},
    {"Jump_Counter1_EQ_0", jump_counter_zero<1>},
    {"Jump_Counter1_GT_0", jump_counter_above_zero<1>},
    {"Jump_Counter2_EQ_0", jump_counter_zero<2>},
    {"Jump_Counter2_GT_0", jump_counter_above_zero<2>},

    {"Timer_Stop", timer_run<false>},
    {"Timer_Start", timer_run<true>},
    {"Timer_Reset", timer_reset},
    {"Timer_Value", timer_value},
    {"Jump_Timer1_GE", jump_timer_reached<1>},
    {"Jump_Timer2_GE", jump_timer_reached<2>},
};

}  // namespace understudy::interpreter::simple2
