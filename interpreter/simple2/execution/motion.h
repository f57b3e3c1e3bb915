// Instructions for the axes. Each instruction exists for A, for B and for both.
#pragma once

#include <algorithm>

#include "interpreter/simple2/execution/flow.h"

namespace understudy::interpreter::simple2 {

enum class Axes : std::uint8_t { a, b, all };

constexpr bool has(Axes axes, Axis axis) {
  return axes == Axes::all || axes == (axis == Axis::a ? Axes::a : Axes::b);
}

// --- actions on one axis -------------------------------------------------------------------------

inline void home(Step& step, Axis axis) { step.machine.go_home(axis); }
inline void servo_on(Step& step, Axis axis) { step.machine.switch_servo(axis, true); }
inline void servo_off(Step& step, Axis axis) { step.machine.switch_servo(axis, false); }
inline void stop_axis(Step& step, Axis axis) { step.machine.stop(axis); }
inline void follow(Step& step, Axis axis) { step.machine.follow_encoder(axis); }

inline void move_by(Step& step, Axis axis, std::int32_t pulses) {
  step.machine.move_incremental(axis, pulses);
}
inline void move_to(Step& step, Axis axis, std::int32_t pulses) { step.machine.move_absolute(axis, pulses); }
inline void speed(Step& step, Axis axis, std::int32_t rpm) {
  step.machine.set_speed(axis, fitted(step.dialect, rpm, 0, 32768));
}
inline void coordinate(Step& step, Axis axis, std::int32_t pulses) {
  step.machine.set_parameter(axis == Axis::a ? kCordA : kCordB, pulses);
}
inline void coordinate_zero(Step& step, Axis axis) { coordinate(step, axis, 0); }
inline void pwm(Step& step, Axis axis, std::int32_t percent) {
  step.machine.output_pwm(axis, fitted(step.dialect, percent, 0, 100));
}
inline void velocity_mrpm(Step& step, Axis axis, std::int32_t milli_rpm) {
  step.machine.run_velocity(axis, milli_rpm);
}
inline void velocity_rpm(Step& step, Axis axis, std::int32_t rpm) {
  const std::int64_t milli_rpm = std::int64_t{rpm} * 1000;
  step.machine.run_velocity(
      axis, static_cast<std::int32_t>(std::clamp<std::int64_t>(milli_rpm, INT32_MIN, INT32_MAX)));
}

// --- instructions with these actions -------------------------------------------------------------

template <Axes axes, void (*order)(Step&, Axis)>
Then to_axes(Step& step) {
  if (has(axes, Axis::a)) order(step, Axis::a);
  if (has(axes, Axis::b)) order(step, Axis::b);
  return Then::next_line;
}

/// An instruction for a single axis uses the parameter in DATA1. With both axes, A uses DATA1 and B uses
/// DATA2; both are read before either axis acts.
template <Axes axes, void (*order)(Step&, Axis, std::int32_t)>
Then to_axes(Step& step) {
  const std::int32_t first = step.first_parameter();
  const std::int32_t last = axes == Axes::all ? step.second_parameter() : first;
  if (has(axes, Axis::a)) order(step, Axis::a, first);
  if (has(axes, Axis::b)) order(step, Axis::b, last);
  return Then::next_line;
}

/// DATA1 is the acceleration and DATA2 the deceleration. If both axes are affected, they use the same values.
template <Axes axes>
Then ramps(Step& step) {
  const std::int32_t up_10ms = fitted(step.dialect, step.first_parameter(), 0, 3000);
  const std::int32_t down_10ms = fitted(step.dialect, step.second_parameter(), 0, 3000);
  if (has(axes, Axis::a)) step.machine.set_ramps(Axis::a, up_10ms, down_10ms);
  if (has(axes, Axis::b)) step.machine.set_ramps(Axis::b, up_10ms, down_10ms);
  return Then::next_line;
}

template <Axis axis>
Then pwm_direct(Step& step) {
  pwm(step, axis, step.line.data1);
  return Then::next_line;
}

template <Axis axis>
Then velocity_rpm_direct(Step& step) {
  velocity_rpm(step, axis, static_cast<std::int16_t>(amount(step.line)));
  return Then::next_line;
}

// --- waiting -------------------------------------------------------------------------------------

template <Axes axes, Action start>
Then and_wait(Step& step) {
  start(step);
  // A move that was not accepted cannot be cut short.
  const bool any = step.dialect.wait_cut_short == Dialect::WaitCutShort::line_is_over;
  step.execution.phase = Phase::move;
  step.execution.waits_for_a = has(axes, Axis::a) && (any || step.machine.moving(Axis::a));
  step.execution.waits_for_b = has(axes, Axis::b) && (any || step.machine.moving(Axis::b));
  return Then::next_line;
}

template <Axes axes>
bool any_moving(const MachineView& machine) {
  return (has(axes, Axis::a) && machine.moving_for_wait(Axis::a)) ||
         (has(axes, Axis::b) && machine.moving_for_wait(Axis::b));
}

/// Returns true if the move for which the line waits was cut short.
inline bool wait_is_cut_short(const Execution& execution, const MachineView& machine) {
  return (execution.waits_for_a && machine.cut_short(Axis::a)) ||
         (execution.waits_for_b && machine.cut_short(Axis::b));
}
/// Returns true if that move was cut short and the line is waiting for a later move.
inline bool waits_on(const Execution& execution, const Dialect& dialect, const MachineView& machine) {
  return dialect.wait_cut_short == Dialect::WaitCutShort::waits_on && wait_is_cut_short(execution, machine);
}

/// Returns where Wait_Move_* continues. It has no other effect.
template <Axes axes>
Then after_wait_move(const Line& line, const Execution& execution, const Program& program,
                     const Dialect& dialect, const MachineView& machine) {
  if (!any_moving<axes>(machine)) {
    return waits_on(execution, dialect, machine) ? Then::same_line : Then::next_line;
  }
  const bool jumps = dialect.wait_move_jumps && program.line_with_flag(line.data1).has_value();
  return jumps ? Then::flag : Then::same_line;
}

template <Axes axes>
Then wait_move(Step& step) {
  const Then then =
      after_wait_move<axes>(step.line, step.execution, step.program, step.dialect, step.machine);
  if (step.dialect.wait_cut_short == Dialect::WaitCutShort::line_is_over) return then;
  Execution& execution = step.execution;
  if (then == Then::same_line) {
    execution.waits_for_a |= has(axes, Axis::a) && step.machine.moving_for_wait(Axis::a);
    execution.waits_for_b |= has(axes, Axis::b) && step.machine.moving_for_wait(Axis::b);
    return then;
  }
  const bool ends = step.dialect.wait_cut_short == Dialect::WaitCutShort::program_ends &&
                    wait_is_cut_short(execution, step.machine);
  execution.waits_for_a = execution.waits_for_b = false;
  return ends ? Then::end_for_cut_wait : then;
}

inline Then wait_move_b(Step& step) {
  if (step.dialect.quirk_wait_move_b_is_move_inc_b_wait) {
    return and_wait<Axes::b, to_axes<Axes::b, move_by>>(step);
  }
  return wait_move<Axes::b>(step);
}

inline constexpr ActionRow kMotionActions[] = {
    {"Move_INC_A", to_axes<Axes::a, move_by>},
    {"Move_INC_B", to_axes<Axes::b, move_by>},
    {"Move_INC_ALL", to_axes<Axes::all, move_by>},
    {"Move_ABS_A", to_axes<Axes::a, move_to>},
    {"Move_ABS_B", to_axes<Axes::b, move_to>},
    {"Move_ABS_ALL", to_axes<Axes::all, move_to>},
    {"Move_Home_A", to_axes<Axes::a, home>},
    {"Move_Home_B", to_axes<Axes::b, home>},
    {"Move_Home_ALL", to_axes<Axes::all, home>},

    {"Move_INC_A_Wait", and_wait<Axes::a, to_axes<Axes::a, move_by>>},
    {"Move_INC_B_Wait", and_wait<Axes::b, to_axes<Axes::b, move_by>>},
    {"Move_INC_ALL_Wait", and_wait<Axes::all, to_axes<Axes::all, move_by>>},
    {"Move_ABS_A_Wait", and_wait<Axes::a, to_axes<Axes::a, move_to>>},
    {"Move_ABS_B_Wait", and_wait<Axes::b, to_axes<Axes::b, move_to>>},
    {"Move_ABS_ALL_Wait", and_wait<Axes::all, to_axes<Axes::all, move_to>>},
    {"Move_Home_A_Wait", and_wait<Axes::a, to_axes<Axes::a, home>>},
    {"Move_Home_B_Wait", and_wait<Axes::b, to_axes<Axes::b, home>>},
    {"Move_Home_ALL_Wait", and_wait<Axes::all, to_axes<Axes::all, home>>},

    {"Wait_Move_A", wait_move<Axes::a>},
    {"Wait_Move_B", wait_move_b},
    {"Wait_Move_ALL", wait_move<Axes::all>},

    {"Move_Speed_A", to_axes<Axes::a, speed>},
    {"Move_Speed_B", to_axes<Axes::b, speed>},
    {"Move_Speed_ALL", to_axes<Axes::all, speed>},
    {"Move_AccDec_A", ramps<Axes::a>},
    {"Move_AccDec_B", ramps<Axes::b>},
    {"Move_AccDec_ALL", ramps<Axes::all>},

    {"SVON_A", to_axes<Axes::a, servo_on>},
    {"SVON_B", to_axes<Axes::b, servo_on>},
    {"SVON_ALL", to_axes<Axes::all, servo_on>},
    {"SVOFF_A", to_axes<Axes::a, servo_off>},
    {"SVOFF_B", to_axes<Axes::b, servo_off>},
    {"SVOFF_ALL", to_axes<Axes::all, servo_off>},
    {"STOP_A", to_axes<Axes::a, stop_axis>},
    {"STOP_B", to_axes<Axes::b, stop_axis>},
    {"STOP_ALL", to_axes<Axes::all, stop_axis>},

    {"Cord_A_ZERO", to_axes<Axes::a, coordinate_zero>},
    {"Cord_B_ZERO", to_axes<Axes::b, coordinate_zero>},
    {"Cord_ALL_ZERO", to_axes<Axes::all, coordinate_zero>},
    {"Cord_A", to_axes<Axes::a, coordinate>},
    {"Cord_B", to_axes<Axes::b, coordinate>},
    {"Cord_ALL", to_axes<Axes::all, coordinate>},

    {"PWM_A", to_axes<Axes::a, pwm>},
    {"PWM_B", to_axes<Axes::b, pwm>},
    {"PWM_A_Direct", pwm_direct<Axis::a>},
    {"PWM_B_Direct", pwm_direct<Axis::b>},
    {"VelmRPM_A", to_axes<Axes::a, velocity_mrpm>},
    {"VelmRPM_B", to_axes<Axes::b, velocity_mrpm>},
    {"VelRPM_A", to_axes<Axes::a, velocity_rpm>},
    {"VelRPM_B", to_axes<Axes::b, velocity_rpm>},
    {"VelRPM_A_Direct", velocity_rpm_direct<Axis::a>},
    {"VelRPM_B_Direct", velocity_rpm_direct<Axis::b>},
    {"SyncMode_A", to_axes<Axes::a, follow>},
    {"SyncMode_B", to_axes<Axes::b, follow>},
};

}  // namespace understudy::interpreter::simple2
