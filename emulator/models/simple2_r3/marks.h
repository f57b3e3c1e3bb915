// Marks of an axis: what a command sets for the motion that follows. The row of each mark contains the
// outcomes of transitions.h that clear it, so mode x phase x event determines which marks remain. Only this
// table clears marks; marks_test.cpp checks it for every cell. (For stop_drive(), `leaves`, `ends` and
// `begins` clear the same marks.)
//
// A position move or homing that ends by itself also clears its command (step_drive()). Marks that are read
// only during a command (has_own_speed, by_trigger), and marks about how the last command ended (cut_short,
// homed), are set again by the next command.
#pragma once

#include <array>
#include <string_view>

#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/transitions.h"

namespace understudy::emulator::models::simple2_r3 {

struct AxisMark {
  std::string_view name;
  Set taken_off_by;  // a set of Outcome values
  void (*take_off)(AxisState&);
  bool (*is_off)(const AxisState&);
};

template <auto member>
constexpr AxisMark axis_mark(std::string_view name, Set taken_off_by) {
  return {name, taken_off_by, [](AxisState& axis) { axis.*member = {}; },
          [](const AxisState& axis) {
            const auto off = decltype(AxisState{}.*member){};
            return axis.*member == off;
          }};
}

// clang-format off
inline constexpr auto kAxisMarks = [] {
  using enum Outcome;
  constexpr Set kOver = set_of(leaves, ends, begins);
  constexpr Set kNoMore = kOver | set_of(stops);
  return std::array{
      axis_mark<&AxisState::mode>("mode", kOver),
      axis_mark<&AxisState::command>("command", kNoMore),
      axis_mark<&AxisState::target_urpm>("target_urpm", kNoMore | set_of(slows)),
      axis_mark<&AxisState::speed_urpm>("speed_urpm", kNoMore | set_of(waits, turns)),
      axis_mark<&AxisState::velocity_phase>("velocity_phase", kNoMore | set_of(waits, turns)),
      axis_mark<&AxisState::pwm_percent>("pwm_percent", kNoMore),
  };
}();
// clang-format on

/// Returns true if a command with this outcome replaces a command that is waiting for SVON.
constexpr bool replaces_kept(Outcome outcome) { return outcome != Outcome::dropped; }

inline void take_off(AxisState& axis, Outcome outcome) {
  for (const AxisMark& mark : kAxisMarks) {
    if (has(mark.taken_off_by, outcome)) mark.take_off(axis);
  }
}

}  // namespace understudy::emulator::models::simple2_r3
