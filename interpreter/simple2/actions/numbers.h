// Instructions that calculate and compare. 32-bit two's complement that wraps; a quotient goes towards zero,
// a remainder has the dividend's sign, and a division by zero gives 0.
#pragma once

#include "interpreter/simple2/actions/step.h"

namespace understudy::interpreter::simple2 {

using Number = std::int32_t;

/// 64 bits hold every result of two 32-bit numbers, INT32_MIN / -1 included.
constexpr Number wrapped(std::int64_t value) {
  return static_cast<Number>(static_cast<std::uint64_t>(value));
}

constexpr Number sum(Number a, Number b) { return wrapped(std::int64_t{a} + b); }
constexpr Number difference(Number a, Number b) { return wrapped(std::int64_t{a} - b); }
constexpr Number product(Number a, Number b) { return wrapped(std::int64_t{a} * b); }
constexpr Number quotient(Number a, Number b) { return b == 0 ? 0 : wrapped(std::int64_t{a} / b); }
constexpr Number remainder(Number a, Number b) { return b == 0 ? 0 : wrapped(std::int64_t{a} % b); }

constexpr Number same(Number a) { return a; }
constexpr Number one_more(Number a) { return sum(a, 1); }
constexpr Number one_less(Number a) { return difference(a, 1); }
constexpr Number negative(Number a) { return difference(0, a); }

constexpr bool equal(Number a, Number b) { return a == b; }
constexpr bool greater(Number a, Number b) { return a > b; }
constexpr bool less(Number a, Number b) { return a < b; }

/// What the second operand is: the value of a parameter, or DATA2 itself (-128 to 127).
using SecondOperand = Number (*)(const Step&);
inline Number from_parameter(const Step& step) { return step.second_parameter(); }
inline Number from_line(const Step& step) { return static_cast<std::int8_t>(step.line.data2); }

template <Number (*operation)(Number, Number), SecondOperand second>
Then into_calc_register(Step& step) {
  step.machine.set_parameter(kCalcRegister, operation(step.first_parameter(), second(step)));
  return Then::next_line;
}

/// DATA1 becomes something made of itself.
template <Number (*operation)(Number)>
Then change(Step& step) {
  step.machine.set_parameter(step.line.data1, operation(step.first_parameter()));
  return Then::next_line;
}

/// DATA2 becomes something made of DATA1.
template <Number (*operation)(Number)>
Then change_second(Step& step) {
  step.machine.set_parameter(step.line.data2, operation(step.first_parameter()));
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

/// True: the next line. False: it is skipped.
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
