// The motion instructions of a step program: what they request of the machine, and whether the program waits.
// (Manual, Motion 指令一覽表.)
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/events.h"
#include "interpreter/super_40nc/fields.h"
#include "interpreter/super_40nc/instruction_row.h"
#include "interpreter/super_40nc/instructions.h"
#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/operand.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/ownership.h"
#include "interpreter/super_40nc/program.h"
#include "interpreter/super_40nc/requests.h"
#include "interpreter/super_40nc/step_programs.h"

namespace understudy::interpreter::super_40nc {

Plane StepPrograms::plane() const {
  return static_cast<Plane>(std::clamp(machine_.special_register(named::kPlane), 0, 2));
}

/// Executes instructions that do not themselves move anything.
StepPrograms::Slice StepPrograms::set_mode(Area area, const Instruction& line) {
  StepState& program = state(area);
  if (has(row_of(line.op).void_in, area)) {
    report(area, Code::wrong_area);
    return advance(area, line);
  }
  if (line.op == Op::stp || line.op == Op::str) return control(area, line);
  if (line.op == Op::pset || line.op == Op::mset) {
    const AxisValues values = axis_values(line, access_);
    if (!is_empty(values)) machine_.set_positions({values, line.op == Op::mset});
  } else if (line.op == Op::rpm) {
    const AxisValues values = values_of(area, line);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (sets_speed(values[i], options_)) program.rpm[i] = *values[i];
    }
  } else if (line.op == Op::absc || line.op == Op::incc) {
    program.targets = line.op == Op::absc ? Targets::absolute : Targets::relative;
  } else if (line.op == Op::chk) {
    program.waits_for_drive = access_.value(line.fields[0]) != 0;
  } else if (line.op == Op::f) {
    machine_.set_special_register(named::kFeed, access_.value(line.fields[0]));
  } else if (line.op >= Op::xyp && line.op <= Op::yzp) {
    machine_.set_special_register(named::kPlane, static_cast<int>(line.op) - static_cast<int>(Op::xyp));
  } else {
    return move(area, line);
  }
  return advance(area, line);
}

/// In an axis program, only the first field counts, and it refers to the program's own axis.
AxisValues StepPrograms::values_of(Area area, const Instruction& line) const {
  if (area == Area::c) return axis_values(line, access_);
  AxisValues values;
  const auto own = static_cast<std::size_t>(axis_of(area));
  const bool is_own = line.op == Op::mrk && options_.chose(option("mrk_fields", "of_its_own_axis"));
  const Operand field = line.fields[is_own ? own : 0];
  if (field.is_set()) values[own] = access_.value(field);
  return values;
}

/// Removes the axes that the program may not move. Returns true if the program continues without them.
bool StepPrograms::drop_forbidden_axes(Area area, AxisValues& values) {
  bool is_void = false;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    auto& value = values[static_cast<std::size_t>(axis)];
    if (!value || may_move(machine_, options_, area, axis)) continue;
    value.reset();
    is_void = true;
  }
  if (!is_void) return true;
  if (options_.chose(option("c21_zero", "skipped"))) {
    report(area, Code::axis_not_owned);
    return true;
  }
  fail(area, Code::axis_not_owned);
  return false;
}

/// D9005: the program does not wait for a LIN or an arc if another one follows, so the axes do not stop at
/// the corner.
bool StepPrograms::goes_on_by_path(Area area, const Instruction& line) const {
  const auto is_path = [](Op op) { return op >= Op::lin && op <= Op::ccwr; };
  if (!options_.chose(option("continuous_path", "corners_are_run_through")) || !is_path(line.op) ||
      is_single_step(area))
    return false;
  if (machine_.parameter_in_force(named::kContinuousPath) == 0) return false;
  const int next = code(area).line_at(state(area).step + steps_of(line));
  return next >= 0 && is_path(code(area).line(next).op);
}

template <class Request>
StepPrograms::Slice StepPrograms::begin_motion(Area area, const Instruction& line, const Request& request,
                                               bool waits) {
  StepState& program = state(area);
  const Begun begun = machine_.begin(area, request);
  if (!program.owns_pointer) return Slice::is_over;
  switch (begun) {
    case Begun::taken: program.phase = Phase::waiting; return Slice::is_over;
    case Begun::refused:
      program.phase = Phase::moving;
      take(Event::broken, area);
      return Slice::is_over;
    case Begun::ignored: return advance(area, line);
    case Begun::runs:
      if (!waits || goes_on_by_path(area, line)) break;
      program.next_step = program.step + steps_of(line);
      program.phase = row_of(line.op).waits == Waits::for_home ? Phase::homing : Phase::moving;
      return Slice::is_over;
    case Begun::done: break;
  }
  advance(area, line);
  const bool ends_single_step = row_of(line.op).ends_single_step ||
                                (line.op == Op::mpg && options_.chose(option("single_step_lines", "yes")));
  if (ends_single_step && is_single_step(area)) {
    take(Event::single_step, area);
    return Slice::is_over;
  }
  return waits ? Slice::is_over : Slice::continues;
}

StepPrograms::Slice StepPrograms::move(Area area, const Instruction& line) {
  const bool is_arc = line.op >= Op::cw && line.op <= Op::ccwr;
  if (is_arc) return begin_arc(area, line);
  const StepState& program = state(area);
  AxisValues values = values_of(area, line);
  if (line.op == Op::hom) {
    for (auto& value : values) {
      if (value == 0) value.reset();
    }
  }
  if (is_empty(values)) return advance(area, line);
  if (!drop_forbidden_axes(area, values)) return Slice::is_over;
  if (is_empty(values)) return advance(area, line);
  const bool stops = std::any_of(values.begin(), values.end(), [](const auto& value) { return value == 0; });
  const bool turns =
      std::any_of(values.begin(), values.end(), [](const auto& value) { return value.value_or(0) != 0; });
  const bool is_inhibitable = line.op == Op::vdrv ? turns : line.op != Op::mpg;
  if (is_inhibitable && is_inhibited()) {
    state(area).phase = Phase::waiting;
    return Slice::is_over;
  }
  if (line.op == Op::lin) return begin_motion(area, line, LinearMove{values, program.targets, feed()}, true);
  if (line.op == Op::mrk) {
    std::array<std::int32_t, kAxisCount> rpm = program.rpm;
    for (int axis = 0; axis < kAxisCount && options_.chose(option("mrk_speed", "by_x14_alone")); ++axis) {
      rpm[static_cast<std::size_t>(axis)] = machine_.rpm_at_power_up(axis);
    }
    return begin_motion(area, line, MarkSearch{values, program.targets, rpm}, true);
  }
  if (line.op == Op::hom) return begin_motion(area, line, HomeSearch{chosen_axes(values)}, true);
  if (line.op == Op::mpg) return begin_motion(area, line, WheelRatios{values}, false);
  if (line.op == Op::vdrv) {
    return begin_motion(area, line, Rotation{values},
                        stops && !options_.chose(option("vdrv_zero_wait", "goes_on")));
  }
  const bool waits = area == Area::c || program.waits_for_drive;
  return begin_motion(area, line, Drive{values, program.targets, program.rpm, waits}, waits);
}

/// Begins an arc. Both axes of the plane must belong to C.
StepPrograms::Slice StepPrograms::begin_arc(Area area, const Instruction& line) {
  const StepState& program = state(area);
  const auto field = [&](std::size_t i) {
    return line.fields[i].is_set() ? std::optional(access_.value(line.fields[i])) : std::nullopt;
  };
  if (!line.fields[0].is_set() && !line.fields[1].is_set() && !line.fields[2].is_set() &&
      !line.fields[3].is_set()) {
    return advance(area, line);
  }
  const Plane where =
      line.op == Op::c3p && options_.chose(option("c3p_plane", "always_xy")) ? Plane::xy : plane();
  const std::array<int, 2> axes = axes_of(where);
  AxisValues moved;
  for (const int axis : axes) moved[static_cast<std::size_t>(axis)] = 0;
  const AxisValues all = moved;
  if (!drop_forbidden_axes(area, moved)) return Slice::is_over;
  if (moved != all) return advance(area, line);
  if (is_inhibited()) {
    state(area).phase = Phase::waiting;
    return Slice::is_over;
  }
  const PlanePoint first{field(0), field(1)};
  const PlanePoint second{field(2), field(3)};
  const Turn turn = line.op == Op::cw || line.op == Op::cwr ? Turn::clockwise : Turn::counter_clockwise;
  if (line.op == Op::c3p) {
    return begin_motion(area, line, PointArc{where, first, second, program.targets, feed()}, true);
  }
  if (line.op == Op::cw || line.op == Op::ccw) {
    const std::array<std::int32_t, 2> centre{second[0].value_or(0), second[1].value_or(0)};
    return begin_motion(area, line, CentreArc{where, turn, first, centre, program.targets, feed()}, true);
  }
  const std::int32_t radius = second[0].value_or(0);  // is set, because the line would not load otherwise
  return begin_motion(area, line, RadiusArc{where, turn, first, radius, program.targets, feed()}, true);
}

}  // namespace understudy::interpreter::super_40nc
