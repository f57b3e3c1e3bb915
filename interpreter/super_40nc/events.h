// What happens to a step program, against what it is doing: the whole table, as data. (Manual, STP 指令,
// M8000, M8006, M8x02, 主畫面操作說明, MAN(手動)頁操作說明; cells that the manual does not name are ours.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace understudy::interpreter::super_40nc {

enum class Phase : std::uint8_t {
  idle,       // its contact OFF, its pointer 0
  executing,  // lines
  moving,     // waits for its LIN, arc, DRV, MRK or VDRV 0
  homing,     // waits for its HOM
  waiting,    // WAT, WTN, TMR, an axis that is taken, or M8004
  paused,     // between lines, or in a wait that stands
  held,       // its motion or wait is frozen
};
inline constexpr std::size_t kPhaseCount = 7;

enum class Event : std::uint8_t {
  start,           // its contact 0 to 1, STR, a START key
  contact_off,     // M8000, M8x00 written 0
  hold,            // M8006 rising, a PAUSE key
  motion_ended,    // its motion line is over
  single_step,     // the same with M8001 or M8x01 ON
  end,             // END
  end_continuous,  // END of C with M8007 or M8600 ON
  stop,            // STP, a STOP key
  reset,           // M8x02 is ON
  emergency,       // M8002 or CEMG is ON
  inhibit,         // M8004 is ON
  broken,  // a limit, a soft limit, a comparator, an alarm, or a home that failed, of an axis of its line
  file_changed,  // D9001
  plc_stop,
  plc_run,       // STOP to RUN, power-up
  limit_pauses,  // as broken, by a limit, where that only pauses a program
};
inline constexpr std::size_t kEventCount = 16;

enum class Reaction : std::uint8_t {
  nothing,
  fresh_start,  // from line 0, with the parameters' modes and speeds
  go_on,        // with the next line, or the wait that stood
  resume,       // with what was frozen
  pause,        // between lines; a wait stands
  pause_later,  // when its motion is over
  hold,         // pause, and what runs beside the lines is held
  freeze,       // its motion or wait, and what runs beside the lines
  next_line,
  forget,        // idle: pointer, calls, waits, what was held; motors go on
  restart,       // END's signal, and a fresh start
  stop_motors,   // idle as before
  stop,          // its motors at once, and forget
  broken,        // forget; the machine has stopped what has to
  motions_wait,  // the next motion line waits
  rest_waits,    // what was frozen goes on only afterwards
  same_step,     // of the new file
};

/// By event and phase.
inline constexpr auto kReactions = [] {
  using enum Reaction;
  return std::array<std::array<Reaction, kPhaseCount>, kEventCount>{{
      //  idle         executing     moving       homing       waiting       paused     held
      {{fresh_start, nothing, nothing, nothing, nothing, go_on, resume}},              // start
      {{nothing, pause, pause_later, pause_later, pause, nothing, nothing}},           // contact_off
      {{nothing, hold, freeze, freeze, freeze, hold, nothing}},                        // hold
      {{nothing, nothing, next_line, next_line, nothing, nothing, nothing}},           // motion_ended
      {{nothing, pause, pause, pause, nothing, nothing, nothing}},                     // single_step
      {{nothing, forget, nothing, nothing, nothing, nothing, nothing}},                // end
      {{nothing, restart, nothing, nothing, nothing, nothing, nothing}},               // end_continuous
      {{stop_motors, stop, stop, stop, stop, stop, stop}},                             // stop
      {{stop_motors, stop, stop, stop, stop, stop, stop}},                             // reset
      {{stop_motors, stop, stop, stop, stop, stop, stop}},                             // emergency
      {{nothing, motions_wait, nothing, nothing, motions_wait, nothing, rest_waits}},  // inhibit
      {{nothing, nothing, broken, broken, nothing, nothing, broken}},                  // broken
      {{nothing, same_step, nothing, nothing, same_step, nothing, nothing}},           // file_changed
      {{nothing, nothing, nothing, nothing, nothing, nothing, nothing}},               // plc_stop
      {{forget, nothing, nothing, nothing, nothing, forget, forget}},                  // plc_run
      {{nothing, nothing, pause, pause, nothing, nothing, nothing}},                   // limit_pauses
  }};
}();

constexpr Reaction reaction_of(Event event, Phase phase) {
  return kReactions[static_cast<std::size_t>(event)][static_cast<std::size_t>(phase)];
}

/// What becomes of motions that run beside the lines (a DRV with CHK 0, VDRV), and of axes that follow the
/// wheel by MPG. The machine is told by the same calls as of its line.
enum class Beside : std::uint8_t { goes_on, is_held, is_stopped, machine_knows };
struct BesideRow {
  Event event;
  Beside motion;
  Beside wheel;
};
inline constexpr std::array<BesideRow, kEventCount> kBeside{{
    {Event::start, Beside::goes_on, Beside::goes_on},
    {Event::contact_off, Beside::goes_on, Beside::goes_on},
    {Event::hold, Beside::is_held, Beside::goes_on},
    {Event::motion_ended, Beside::goes_on, Beside::goes_on},
    {Event::single_step, Beside::goes_on, Beside::goes_on},
    {Event::end, Beside::goes_on, Beside::goes_on},
    {Event::end_continuous, Beside::goes_on, Beside::goes_on},
    {Event::stop, Beside::is_stopped, Beside::is_stopped},
    {Event::reset, Beside::is_stopped, Beside::is_stopped},
    {Event::emergency, Beside::is_stopped, Beside::is_stopped},
    {Event::inhibit, Beside::goes_on, Beside::machine_knows},
    {Event::broken, Beside::machine_knows, Beside::machine_knows},
    {Event::file_changed, Beside::goes_on, Beside::goes_on},
    {Event::plc_stop, Beside::goes_on, Beside::goes_on},
    {Event::plc_run, Beside::goes_on, Beside::goes_on},
    {Event::limit_pauses, Beside::machine_knows, Beside::machine_knows},
}};

}  // namespace understudy::interpreter::super_40nc
