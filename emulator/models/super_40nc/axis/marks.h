// Marks of a SUPER-40NC axis: flags that are set for a later decision. The row of each mark contains the
// events that clear it. Only this table clears marks. A test begins every motion, ends it in every possible
// way and checks all rows.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "emulator/models/super_40nc/axis/axis_state.h"

namespace understudy::emulator::models::super_40nc {

enum class MarkEvent : std::uint8_t {
  motion_begins,
  motion_ends,      // in any way: arrived, stopped, abandoned, or replaced by another command
  path_ends,        // the end of LIN or an arc, in any way
  program_over,     // of the waiting program; only awaited and stop_awaited_by refer to it
  orders_given_up,  // orders from the main page's HOME and ZERO keys
  reset,            // M8x02
  plc_run,
};
using MarkEvents = std::uint8_t;
constexpr MarkEvents events_of(auto... some) {
  return static_cast<MarkEvents>((0U | ... | (1U << static_cast<unsigned>(some))));
}

struct AxisMark {
  std::string_view name;
  MarkEvents taken_off_by;
  void (*take_off)(AxisState&);
  bool (*is_off)(const AxisState&);
};

inline const AxisState kUnmarked{};

template <auto member>
constexpr AxisMark axis_mark(std::string_view name, MarkEvents taken_off_by) {
  return {name, taken_off_by, [](AxisState& axis) { axis.*member = kUnmarked.*member; },
          [](const AxisState& axis) { return axis.*member == kUnmarked.*member; }};
}

// clang-format off
inline constexpr auto kAxisMarks = [] {
  using enum MarkEvent;
  return std::array{
      axis_mark<&AxisState::holder>("holder", events_of(motion_ends)),
      axis_mark<&AxisState::asked_by_contact>("asked_by_contact", events_of(motion_ends)),
      axis_mark<&AxisState::asked_by_plc>("asked_by_plc", events_of(motion_ends)),
      axis_mark<&AxisState::mover>("mover", events_of(motion_ends)),
      axis_mark<&AxisState::awaited>("awaited", events_of(motion_ends, program_over)),
      axis_mark<&AxisState::stop_awaited_by>("stop_awaited_by", events_of(motion_ends, program_over)),
      axis_mark<&AxisState::shows_finish>("shows_finish", events_of(motion_ends)),
      axis_mark<&AxisState::is_held>("is_held", events_of(motion_ends)),
      axis_mark<&AxisState::rest>("rest", events_of(motion_ends)),
      axis_mark<&AxisState::order>("order", events_of(motion_ends, orders_given_up)),
      axis_mark<&AxisState::wheel>("wheel", events_of(motion_ends)),
      axis_mark<&AxisState::path_backlash>("path_backlash", events_of(path_ends)),
      axis_mark<&AxisState::arc_backlash>("arc_backlash", events_of(path_ends)),
      axis_mark<&AxisState::has_ended>("has_ended", events_of(motion_begins)),
      axis_mark<&AxisState::has_error>("has_error", events_of(motion_begins, reset, plc_run)),
      axis_mark<&AxisState::stands_on_target>("stands_on_target", events_of(motion_begins)),
  };
}();
// clang-format on

constexpr bool is_taken_off_by(const AxisMark& mark, MarkEvent event) {
  return (mark.taken_off_by & events_of(event)) != 0;
}

inline void take_off(AxisState& axis, MarkEvent event) {
  for (const AxisMark& mark : kAxisMarks) {
    if (is_taken_off_by(mark, event)) mark.take_off(axis);
  }
}

}  // namespace understudy::emulator::models::super_40nc
