// Converts the fields of a line to axis values.
#pragma once

#include <cstddef>

#include "interpreter/super_40nc/access.h"
#include "interpreter/super_40nc/program.h"
#include "interpreter/super_40nc/requests.h"

namespace understudy::interpreter::super_40nc {

/// Returns the values of the fields X, Y, Z and U.
inline AxisValues axis_values(const Instruction& line, const Access& access) {
  AxisValues values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (line.fields[i].is_set()) values[i] = access.value(line.fields[i]);
  }
  return values;
}

/// Returns the axes whose fields are set and not 0 (HOM, PJG, MJG, STP, STR).
inline AxisSet chosen_axes(const AxisValues& values) {
  AxisSet axes = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].value_or(0) != 0) axes = static_cast<AxisSet>(axes | (1U << i));
  }
  return axes;
}
constexpr bool has_axis(AxisSet axes, int axis) { return ((axes >> axis) & 1U) != 0; }

}  // namespace understudy::interpreter::super_40nc
