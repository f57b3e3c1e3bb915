#include "interpreter/super_40nc/plc_lines.h"

#include <cstddef>
#include <utility>

#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/fields.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/instructions.h"
#include "interpreter/super_40nc/ladder.h"
#include "interpreter/super_40nc/numbers.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/ownership.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::interpreter::super_40nc {

/// Returns true if the condition has changed. A choice can hide the edge at RUN from some instructions.
bool PlcLines::count_as_edge(const LadderStep& step, bool is_on, bool& fires) {
  const Op op = ladder_.line(step.line).op;
  const bool was_on = std::exchange(plc_.memories[step.memory], is_on ? 1 : 0) != 0;
  const bool is_falling = row_of(op).in_plc == ConditionUse::falling_edge;
  fires = is_on != was_on && is_on != is_falling;
  if (plc_.is_first_scan && options_.chose(option("run_edges", "not_at_all"))) fires = false;
  const bool is_motion = op == Op::drv || op == Op::hom || op == Op::str;
  if (is_motion && options_.chose(option("instruction_edges", "every_scan"))) fires = is_on;
  return is_on != was_on;
}

bool PlcLines::carry_out(const LadderStep& step, bool is_on) {
  const Instruction& line = ladder_.line(step.line);
  const ConditionUse how = row_of(line.op).in_plc;
  const int number = ladder_.step_of(step.line);
  if (how == ConditionUse::rising_edge || how == ConditionUse::falling_edge) {
    bool fires = false;
    bool has_changed = count_as_edge(step, is_on, fires);
    if (line.op == Op::pls || line.op == Op::plf) {
      has_changed |= access_.switch_contact(line.fields[0], fires);
    } else if (fires && line.op == Op::alt) {
      has_changed |= access_.switch_contact(line.fields[0], !access_.contact(line.fields[0]));
    } else if (fires) {
      has_changed |= begin_motion(line, number);
    }
    return has_changed;
  }
  if (needs_edge(line.op, options_)) {
    bool fires = false;
    const bool has_changed = count_as_edge(step, is_on, fires);
    if (!fires) return has_changed;
  }
  if (line.op == Op::out) return access_.switch_contact(line.fields[0], is_on);
  if (!is_on) return false;
  if (line.op == Op::set) return access_.switch_contact(line.fields[0], true);
  if (line.op == Op::rst) return access_.reset(line.fields[0]);
  if (is_calculation(line.op)) {
    const Calculated result = calculate(line, access_, options_);
    return result.code == Code::none ? result.has_changed : report(result.code, number);
  }
  if (line.op == Op::pjg || line.op == Op::mjg) {
    jog(line, number);
    return false;
  }
  if (line.op == Op::chk) return report(Code::wrong_area, number);
  if (line.op == Op::stp) {
    control_programs(line);
    return true;
  }
  return set_modes(line);
}

bool PlcLines::set_modes(const Instruction& line) {
  if (line.op == Op::absc) return std::exchange(plc_.targets, Targets::absolute) != Targets::absolute;
  if (line.op == Op::incc) return std::exchange(plc_.targets, Targets::relative) != Targets::relative;
  const AxisValues values = axis_values(line, access_);
  if (line.op == Op::rpm) {
    bool has_changed = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!sets_speed(values[i], options_)) continue;
      has_changed |= std::exchange(plc_.rpm[i], *values[i]) != *values[i];
    }
    return has_changed;
  }
  if (is_empty(values)) return false;
  return access_.machine().set_positions({values, line.op == Op::mset});
}

/// Returns the values for the axes that the PLC may move.
AxisValues PlcLines::movable(AxisValues values, int step) {
  bool is_void = false;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    auto& value = values[static_cast<std::size_t>(axis)];
    if (!value || may_move(access_.machine(), options_, Area::plc, axis)) continue;
    value.reset();
    is_void = true;
  }
  if (is_void) report(Code::axis_not_owned, step);
  return values;
}

bool PlcLines::begin_motion(const Instruction& line, int step) {
  if (line.op == Op::str) {
    control_programs(line);
    return true;
  }
  AxisValues values = axis_values(line, access_);
  if (line.op == Op::hom) {
    for (auto& value : values) {
      if (value == 0) value.reset();
    }
  }
  values = movable(values, step);
  if (is_empty(values)) return true;
  if (line.op == Op::drv) {
    access_.machine().plc_drive({values, plc_.targets, plc_.rpm}, step);
  } else {
    access_.machine().plc_home({chosen_axes(values)}, step);
  }
  return true;
}

/// STR, STP: if no field is set, the instruction applies to C.
void PlcLines::control_programs(const Instruction& line) {
  const AxisValues values = axis_values(line, access_);
  const AxisSet axes = chosen_axes(values);
  const auto act = [&](Area area) { line.op == Op::str ? programs_.start(area) : programs_.stop(area); };
  if (is_empty(values)) return act(Area::c);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (has_axis(axes, axis)) act(area_of_axis(axis));
  }
}

void PlcLines::jog(const Instruction& line, int step) {
  AxisSet& axes = line.op == Op::pjg ? jogs_.positive : jogs_.negative;
  const AxisSet chosen = chosen_axes(axis_values(line, access_));
  axes = static_cast<AxisSet>(axes | chosen);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (has_axis(chosen, axis)) jog_steps_[static_cast<std::size_t>(axis)] = step;
  }
}

bool PlcLines::end_scan() {
  const bool is_same = jogs_ == plc_.jogs;
  if (is_same && jogs_ == Jogs{}) return false;
  plc_.jogs = jogs_;
  return access_.machine().plc_jog(jogs_, jog_steps_) || !is_same;
}

}  // namespace understudy::interpreter::super_40nc
