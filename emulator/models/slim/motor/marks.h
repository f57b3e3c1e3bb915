// Marks of a module: what an activity sets for a later decision. The row of each mark contains the events
// that clear it. Only this table clears marks, except where a motion continues in another way: AVM specifies
// a speed again (refresh_speed(), resume_motion()), VM ends AVM, or running thrust briefly was a jog.
// marks_test.cpp begins every activity, ends it in every possible way and checks all rows.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "emulator/models/slim/motor/module.h"

namespace understudy::emulator::models::slim {

enum class MarkEvent : std::uint8_t {
  begins,          // a motion of the module: MA, MR, H, JGF, JGR, FT
  continues,       // JGF or JGR in the direction of the running jog
  jogs_dropped,    // JG0, TAUPZ, CLR BUF in a pause, or a pause before it sets its own marks
  stop_requested,  // the motion has begun to decelerate, and then ends
  stands,          // the motion has ended, or is interrupted and will start again from the FIFO
  pause_over,      // TAREDO, REDO
  cut,             // TASTOP, IHOFF, HOFF or RESET, all of them immediately
  servo_off,       // IHOFF, HOFF, RESET; TASTOP if it switches the servo off
};
using MarkEvents = std::uint8_t;
static_assert(static_cast<int>(MarkEvent::servo_off) < std::numeric_limits<MarkEvents>::digits);
constexpr MarkEvents events_of(auto... some) {
  return static_cast<MarkEvents>((0U | ... | (1U << static_cast<unsigned>(some))));
}

struct ModuleMark {
  std::string_view name;
  MarkEvents taken_off_by;
  void (*take_off)(Module&);
  bool (*is_off)(const Module&);
};

template <auto member, auto off = decltype(Module{}.*member){}>
constexpr ModuleMark module_mark(std::string_view name, MarkEvents taken_off_by) {
  return {name, taken_off_by, [](Module& module) { module.*member = off; },
          [](const Module& module) { return module.*member == off; }};
}

// clang-format off
inline constexpr auto kModuleMarks = [] {
  using enum MarkEvent;
  return std::array{
      module_mark<&Module::activity>("activity", events_of(stands, cut)),
      module_mark<&Module::jog_direction>("jog_direction", events_of(stands, cut)),
      module_mark<&Module::thrust>("thrust", events_of(begins, stands, cut)),
      module_mark<&Module::next_jog_direction>("next_jog_direction", events_of(begins, continues, jogs_dropped, cut)),
      module_mark<&Module::next_thrust>("next_thrust", events_of(begins, continues, jogs_dropped, cut)),
      module_mark<&Module::held_jog_direction>("held_jog_direction", events_of(jogs_dropped, pause_over, cut)),
      module_mark<&Module::held_thrust>("held_thrust", events_of(jogs_dropped, pause_over, cut)),
      module_mark<&Module::starved>("starved", events_of(begins, stop_requested, stands, cut)),
      module_mark<&Module::analog_speed>("analog_speed", events_of(servo_off)),
  };
}();
// clang-format on

constexpr bool is_taken_off_by(const ModuleMark& mark, MarkEvent event) {
  return (mark.taken_off_by & events_of(event)) != 0;
}

inline void take_off(Module& module, MarkEvent event) {
  for (const ModuleMark& mark : kModuleMarks) {
    if (is_taken_off_by(mark, event)) mark.take_off(module);
  }
}

}  // namespace understudy::emulator::models::slim
