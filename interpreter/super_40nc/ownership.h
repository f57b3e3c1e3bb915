// The axes that a program may move. C21 (D9003) assigns the first axes to C. (Manual, C21, 故障排除.)
#pragma once

#include <algorithm>

#include "interpreter/super_40nc/machine.h"
#include "interpreter/super_40nc/options.h"

namespace understudy::interpreter::super_40nc {

/// Returns how many axes belong to C, counted from the first one.
inline int axes_of_c(const Machine& machine) {
  return std::clamp(machine.parameter_in_force(named::kOwnedAxes), 0, kAxisCount);
}

/// Returns true if a program may move an axis. C may move its own axes; an axis program may move its axis
/// unless it belongs to C; the PLC may move the axes of C only while C is not running.
inline bool may_move(const Machine& machine, const Options& options, Area by, int axis) {
  const bool is_of_c = axis < axes_of_c(machine);
  if (by == Area::c) return is_of_c;
  if (by == Area::plc) {
    if (!is_of_c || options.chose(option("plc_moves_axes_of_c", "whenever_they_are_free"))) return true;
    return options.chose(option("plc_moves_axes_of_c", "while_m8000_is_off")) &&
           !machine.special_contact(row_of(Area::c).run_contact);
  }
  return !is_of_c && axis == axis_of(by);
}

}  // namespace understudy::interpreter::super_40nc
