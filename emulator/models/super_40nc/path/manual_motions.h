// The table of how each event affects a motion for which no step program line is waiting. (《M8
// 特殊接點的功用》, 《M8x 特殊接點的功用》, 《STP 指令》; where the manual is silent, the entry is ours.) The
// motor itself handles limits and alarms; interpreter/super_40nc/events.h handles lines and their programs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace understudy::emulator::models::super_40nc {

enum class ManualMotion : std::uint8_t {
  jog,            // by contact or key
  plc_jog,        // PJG, MJG
  home,           // by contact, by the axis's key or by the PLC's HOM
  home_by_order,  // by the key on the main page
  zero,
  zero_by_order,
  wheel,           // by contact
  selected_wheel,  // by D8020
  plc_drive,
  behind_end,  // VDRV or MPG of an axis program after END, or CHK 0
  behind_end_of_c,
};
inline constexpr std::size_t kManualMotions = 11;

enum class ManualEvent : std::uint8_t {
  contact_off,  // the request has ended; D8020 was written
  pause,        // M8006, a PAUSE key
  stop,         // STP, M8x02 or the STOP key of the axis
  stop_of_c,    // STP without fields
  main_stop,    // the STOP key on the main page
  emergency,    // M8002, CEMG
  inhibit,      // M8004
  plc_stop,     // the PLC switches to STOP
};
inline constexpr std::size_t kManualEvents = 8;

enum class ManualAnswer : std::uint8_t { continues, slows, ends };

// clang-format off
inline constexpr auto kManualAnswers = [] {
  constexpr auto on = ManualAnswer::continues;
  constexpr auto slows = ManualAnswer::slows;
  constexpr auto ends = ManualAnswer::ends;
  return std::array<std::array<ManualAnswer, kManualEvents>, kManualMotions>{{
      // contact_off pause stop stop_of_c main_stop emergency inhibit plc_stop
      {slows, on, ends, on,   on,   ends, on, on},     // jog
      {slows, on, ends, on,   on,   ends, on, slows},  // plc_jog
      {on,    on, ends, on,   on,   ends, on, on},     // home
      {on,    on, ends, on,   ends, ends, on, on},     // home_by_order
      {on,    on, ends, on,   on,   ends, on, on},     // zero
      {on,    on, ends, on,   ends, ends, on, on},     // zero_by_order
      {ends,  on, ends, on,   on,   ends, on, on},     // wheel: M8004 drops its counts
      {ends,  on, ends, on,   on,   ends, on, on},     // selected_wheel
      {on,    on, ends, on,   on,   ends, on, on},     // plc_drive
      {on,    on, ends, on,   on,   ends, on, on},     // behind_end
      {on,    on, ends, ends, ends, ends, on, on},     // behind_end_of_c
  }};
}();
// clang-format on

constexpr ManualAnswer answer_of(ManualMotion motion, ManualEvent event) {
  return kManualAnswers[static_cast<std::size_t>(motion)][static_cast<std::size_t>(event)];
}

}  // namespace understudy::emulator::models::super_40nc
