// Instructions that calculate and compare, with signed 32-bit numbers. The dialect determines what happens to
// a result beyond 32 bits and how a quotient is rounded. Dividing by zero results in 0.
#pragma once

#include <algorithm>

#include "interpreter/simple2/execution/step.h"

namespace understudy::interpreter::simple2 {

using Number = std::int32_t;

/// 64 bits can hold the result of any operation on two 32-bit numbers, including INT32_MIN / -1.
using Result = std::int64_t;

/// Returns a result as it is stored in 32 bits.
constexpr Number kept(const Dialect& dialect, Result result) {
  if (dialect.overflow == Dialect::Overflow::saturates) {
    return static_cast<Number>(std::clamp<Result>(result, INT32_MIN, INT32_MAX));
  }
  return static_cast<Number>(static_cast<std::uint64_t>(result));
}

constexpr Result sum(const Dialect&, Number a, Number b) { return Result{a} + b; }
constexpr Result difference(const Dialect&, Number a, Number b) { return Result{a} - b; }
constexpr Result product(const Dialect&, Number a, Number b) { return Result{a} * b; }
constexpr Result quotient(const Dialect& dialect, Number a, Number b) {
  if (b == 0) return 0;
  const bool has_fraction_below_zero = Result{a} % b != 0 && (a < 0) != (b < 0);
  const bool down = has_fraction_below_zero && dialect.division == Dialect::Division::downwards;
  return Result{a} / b - (down ? 1 : 0);
}
constexpr Result remainder(const Dialect& dialect, Number a, Number b) {
  return b == 0 ? 0 : a - quotient(dialect, a, b) * b;
}

constexpr Result same(Number a) { return a; }
constexpr Result one_more(Number a) { return Result{a} + 1; }
constexpr Result one_less(Number a) { return Result{a} - 1; }
constexpr Result negative(Number a) { return -Result{a}; }

constexpr bool equal(Number a, Number b) { return a == b; }
constexpr bool greater(Number a, Number b) { return a > b; }
constexpr bool less(Number a, Number b) { return a < b; }

/// The source of the second operand: the value of a parameter, or DATA2 itself (-128 to 127).
using SecondOperand = Number (*)(const Step&);
inline Number from_parameter(const Step& step) { return step.second_parameter(); }
inline Number from_line(const Step& step) { return static_cast<std::int8_t>(step.line.data2); }

template <Result (*operation)(const Dialect&, Number, Number), SecondOperand second>
Then into_calc_register(Step& step) {
  const Result result = operation(step.dialect, step.first_parameter(), second(step));
  step.machine.set_parameter(kCalcRegister, kept(step.dialect, result));
  return Then::next_line;
}

/// Sets DATA1 to a function of DATA1.
template <Result (*operation)(Number)>
Then change(Step& step) {
  step.machine.set_parameter(step.line.data1, kept(step.dialect, operation(step.first_parameter())));
  return Then::next_line;
}

/// Sets DATA2 to a function of DATA1.
template <Result (*operation)(Number)>
Then change_second(Step& step) {
  step.machine.set_parameter(step.line.data2, kept(step.dialect, operation(step.first_parameter())));
  return Then::next_line;
}

inline Then write_calc_register(Step& step) {
  step.machine.set_parameter(kCalcRegister, step.first_parameter());
  return Then::next_line;
}

inline Then load_calc_register(Step& step) {
  step.machine.set_parameter(step.line.data1, step.machine.parameter(kCalcRegister));
  return Then::next_line;
}

inline Then set_from_line(Step& step) {
  step.machine.set_parameter(step.line.data1, from_line(step));
  return Then::next_line;
}

/// Continues with the next line if true, otherwise skips it.
template <bool (*comparison)(Number, Number), SecondOperand second>
Then next_if(Step& step) {
  return comparison(step.first_parameter(), second(step)) ? Then::next_line : Then::line_after_next;
}

inline Then jump_above_zero(Step& step) { return jump_if(step.second_parameter() > 0); }
inline Then jump_from_zero_up(Step& step) { return jump_if(step.second_parameter() >= 0); }

inline constexpr ActionRow kNumberActions[] = {
    {"Write_CalcREG", write_calc_register},
    {"Load_CalcREG", load_calc_register},
    {"VAR_Copy", change_second<same>},
    {"VAR_Direct", set_from_line},

    {"VAR_Add", into_calc_register<sum, from_parameter>},
    {"VAR_Sub", into_calc_register<difference, from_parameter>},
    {"VAR_Mul", into_calc_register<product, from_parameter>},
    {"VAR_Div", into_calc_register<quotient, from_parameter>},
    {"VAR_DivR", into_calc_register<remainder, from_parameter>},
    {"VAR_DirectAdd", into_calc_register<sum, from_line>},
    {"VAR_DirectSub", into_calc_register<difference, from_line>},
    {"VAR_DirectMul", into_calc_register<product, from_line>},
    {"VAR_DirectDiv", into_calc_register<quotient, from_line>},
    {"VAR_DirectDivR", into_calc_register<remainder, from_line>},

    {"VAR_Inc", change<one_more>},
    {"VAR_Dec", change<one_less>},
    {"VAR_INV", change<negative>},
    {"VAR_Inc_To", change_second<one_more>},
    {"VAR_Dec_To", change_second<one_less>},
    {"VAR_INV_To", change_second<negative>},

    {"VAR_EQ", next_if<equal, from_parameter>},
    {"VAR_GT", next_if<greater, from_parameter>},
    {"VAR_LT", next_if<less, from_parameter>},
    {"VAR_DirectEQ", next_if<equal, from_line>},
    {"VAR_DirectGT", next_if<greater, from_line>},
    {"VAR_DirectLT", next_if<less, from_line>},
    {"VAR_GT_0", jump_above_zero},
    {"VAR_GE_0", jump_from_zero_up},
};

}  // namespace understudy::interpreter::simple2
