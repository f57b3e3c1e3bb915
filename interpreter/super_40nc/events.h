// The transition table of step programs: the reaction to each event in each phase, as data. (Manual, STP
// 指令, M8000, M8006, M8x02, 主畫面操作說明, MAN(手動)頁操作說明. Cells that the manual does not mention are
// ours.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace understudy::interpreter::super_40nc {

enum class Phase : std::uint8_t {
  idle,       // the contact is OFF and the pointer is 0
  executing,  // it is executing lines
  moving,     // waiting for the end of LIN, an arc, DRV, MRK or VDRV 0
  homing,     // waiting for the end of HOM
  waiting,    // waiting in WAT, WTN or TMR, for an axis that is taken, or because of M8004
  paused,     // between lines, or the wait is suspended
  held,       // the motion or wait is frozen
};
inline constexpr std::size_t kPhaseCount = 7;

enum class Event : std::uint8_t {
  start,           // the contact changes from 0 to 1; STR; a START key
  contact_off,     // M8000 or M8x00 is set to 0
  hold,            // M8006 rises, or a PAUSE key
  motion_ended,    // the motion of the line has ended
  single_step,     // like motion_ended, with M8001 or M8x01 ON
  end,             // END
  end_continuous,  // END of C with M8007 or M8600 ON
  stop,            // STP, a STOP key
  reset,           // M8x02 is ON
  emergency,       // M8002 or CEMG is ON
  inhibit,         // M8004 is ON
  // an axis of the line has reached a limit, a soft limit, a comparator or an alarm, or its homing has failed
  broken,
  file_changed,  // D9001
  plc_stop,
  plc_run,       // STOP to RUN, power-up
  limit_pauses,  // like broken, for a limit, if limits only pause programs
};
inline constexpr std::size_t kEventCount = 16;

enum class Reaction : std::uint8_t {
  nothing,
  fresh_start,   // from line 0, with the modes and speeds in the parameters
  next_or_wait,  // continues with the next line, or with the suspended wait
  resume,        // continues the frozen motion or wait
  pause,         // pauses between lines; suspends a wait
  pause_later,   // pauses when the motion has ended
  hold,          // like pause, and also holds the motions outside lines
  freeze,        // freezes the motion or wait, and the motions outside lines
  next_line,
  forget,        // becomes idle: drops the pointer, calls, waits and held motions; motors continue
  restart,       // outputs the END signal, and makes a fresh start
  stop_motors,   // stops the motors, and stays idle
  stop,          // stops the motors immediately, and forgets
  broken,        // forgets; the machine has already stopped the motors
  motions_wait,  // the next motion line waits
  rest_waits,    // the frozen motion continues only afterwards
  same_step,     // continues at the same step of the new file
};

/// The reaction to each event in each phase.
inline constexpr auto kReactions = [] {
  using enum Reaction;
  return std::array<std::array<Reaction, kPhaseCount>, kEventCount>{{
      //  idle         executing     moving       homing       waiting       paused     held
      {{fresh_start, nothing, nothing, nothing, nothing, next_or_wait, resume}},       // start
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

/// The effect of an event on motions outside lines (a DRV with CHK 0, VDRV), and on axes that follow the
/// wheel by MPG. The machine receives the same calls as for the program's line.
enum class OutsideEffect : std::uint8_t { continues, is_held, is_stopped, machine_knows };
struct OutsideEffectRow {
  Event event;
  OutsideEffect motion;
  OutsideEffect wheel;
};
inline constexpr std::array<OutsideEffectRow, kEventCount> kOutsideEffects{{
    {Event::start, OutsideEffect::continues, OutsideEffect::continues},
    {Event::contact_off, OutsideEffect::continues, OutsideEffect::continues},
    {Event::hold, OutsideEffect::is_held, OutsideEffect::continues},
    {Event::motion_ended, OutsideEffect::continues, OutsideEffect::continues},
    {Event::single_step, OutsideEffect::continues, OutsideEffect::continues},
    {Event::end, OutsideEffect::continues, OutsideEffect::continues},
    {Event::end_continuous, OutsideEffect::continues, OutsideEffect::continues},
    {Event::stop, OutsideEffect::is_stopped, OutsideEffect::is_stopped},
    {Event::reset, OutsideEffect::is_stopped, OutsideEffect::is_stopped},
    {Event::emergency, OutsideEffect::is_stopped, OutsideEffect::is_stopped},
    {Event::inhibit, OutsideEffect::continues, OutsideEffect::machine_knows},
    {Event::broken, OutsideEffect::machine_knows, OutsideEffect::machine_knows},
    {Event::file_changed, OutsideEffect::continues, OutsideEffect::continues},
    {Event::plc_stop, OutsideEffect::continues, OutsideEffect::continues},
    {Event::plc_run, OutsideEffect::continues, OutsideEffect::continues},
    {Event::limit_pauses, OutsideEffect::machine_knows, OutsideEffect::machine_knows},
}};

}  // namespace understudy::interpreter::super_40nc
