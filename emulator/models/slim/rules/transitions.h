// The transition table of pauses, resumes and stops against the activities of the chain and its program. Each
// cell has its outcome and the source for it: the list's line, or the first option of a row of choices.h.
//
// The code follows this table (chain/stops.cpp for motions; dialogue.cpp and commands.cpp for programs), and
// transitions_test.cpp checks every cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace understudy::emulator::models::slim {

/// The activities. The last four are those of a program, which may run during any of the others.
enum class Doing : std::uint8_t {
  line,
  move,
  homing,
  jog,
  thrust,
  program_runs,
  program_waits_for_number,  // GETI, GETR
  program_waits_for_time,    // WT
  program_waits_for_motion,  // DN
};
inline constexpr std::size_t kDoings = 9;

enum class Event : std::uint8_t {
  pause,    // TAPZ
  go_on,    // TAREDO, during the pause
  give_up,  // TAUPZ, during the pause
  stop,     // TASTOP
  pause_q,  // PZ
  go_on_q,  // REDO, during that pause
};
inline constexpr std::size_t kEvents = 6;

/// The source of a command.
enum class From : std::uint8_t { host, program, event_routine };
inline constexpr std::size_t kSources = 3;

enum class Outcome : std::uint8_t {
  // of a motion:
  comes_to_a_stand,  // decelerates along its ramp, on its path; nothing of it is lost
  does_as_before,    // continues what it did before the pause
  is_forgotten,      // is at rest and does not continue
  stops_at_once,     // stops without another pulse and does not continue
  // of a program:
  goes_on,             // continues as if nothing had happened: it keeps waiting, or takes its next line
  ends,                // takes no further line
  ends_after_routine,  // the event's routine continues to its RET, but the interrupted program does not
  cannot_be,           // impossible: a waiting program gives no command, except in an event's routine
};

struct Transition {
  Doing doing;
  Event event;
  std::array<Outcome, kSources> outcomes;  // by From: the host, the program, an event's routine
  std::string_view by;
};

namespace transitions {
constexpr std::array<Outcome, kSources> any(Outcome outcome) { return {outcome, outcome, outcome}; }
constexpr std::array<Outcome, kSources> of_waiting(Outcome outcome) {
  return {outcome, Outcome::cannot_be, outcome};
}
}  // namespace transitions

inline constexpr Transition kTransitions[] = {
    // --- TAPZ: "each motor that moves slows down at once, in step, and keeps to its path"
    {Doing::line, Event::pause, transitions::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::move, Event::pause, transitions::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::homing, Event::pause, transitions::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::jog, Event::pause, transitions::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::thrust, Event::pause, transitions::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::program_runs, Event::pause, transitions::any(Outcome::goes_on), "pause_in_program"},
    {Doing::program_waits_for_number, Event::pause, transitions::of_waiting(Outcome::goes_on),
     "lines_for_a_number"},
    {Doing::program_waits_for_time, Event::pause, transitions::of_waiting(Outcome::goes_on),
     "pause_in_program"},
    {Doing::program_waits_for_motion, Event::pause, transitions::of_waiting(Outcome::goes_on),
     "pause_in_program"},
    // --- TAREDO: "each motor does at once what it did before the pause"
    {Doing::line, Event::go_on, transitions::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::move, Event::go_on, transitions::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::homing, Event::go_on, transitions::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::jog, Event::go_on, transitions::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::thrust, Event::go_on, transitions::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::program_runs, Event::go_on, transitions::any(Outcome::goes_on), "while_program_runs"},
    {Doing::program_waits_for_number, Event::go_on, transitions::of_waiting(Outcome::goes_on),
     "lines_for_a_number"},
    {Doing::program_waits_for_time, Event::go_on, transitions::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    {Doing::program_waits_for_motion, Event::go_on, transitions::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    // --- TAUPZ: "the command that is half done, and all in the buffer, are given up"
    {Doing::line, Event::give_up, transitions::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::move, Event::give_up, transitions::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::homing, Event::give_up, transitions::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::jog, Event::give_up, transitions::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::thrust, Event::give_up, transitions::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::program_runs, Event::give_up, transitions::any(Outcome::goes_on), "while_program_runs"},
    {Doing::program_waits_for_number, Event::give_up, transitions::of_waiting(Outcome::goes_on),
     "lines_for_a_number"},
    {Doing::program_waits_for_time, Event::give_up, transitions::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    {Doing::program_waits_for_motion, Event::give_up, transitions::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    // --- TASTOP: "each axis stops at once, in an emergency"
    {Doing::line, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::move, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::homing, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::jog, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::thrust, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::program_runs,
     Event::stop,
     {Outcome::ends, Outcome::goes_on, Outcome::ends_after_routine},
     "emergency_stop_program"},
    {Doing::program_waits_for_number,
     Event::stop,
     {Outcome::ends, Outcome::cannot_be, Outcome::ends_after_routine},
     "emergency_stop_program"},
    {Doing::program_waits_for_time,
     Event::stop,
     {Outcome::ends, Outcome::cannot_be, Outcome::ends_after_routine},
     "emergency_stop_program"},
    {Doing::program_waits_for_motion,
     Event::stop,
     {Outcome::ends, Outcome::cannot_be, Outcome::ends_after_routine},
     "emergency_stop_program"},
    // --- PZ and REDO: like TAPZ and TAREDO for motions; for programs by a row of their own
    {Doing::line, Event::pause_q, transitions::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::move, Event::pause_q, transitions::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::homing, Event::pause_q, transitions::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::jog, Event::pause_q, transitions::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::thrust, Event::pause_q, transitions::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::program_runs, Event::pause_q, transitions::any(Outcome::goes_on), "pause_and_program"},
    {Doing::program_waits_for_number, Event::pause_q, transitions::of_waiting(Outcome::goes_on),
     "pause_and_program"},
    {Doing::program_waits_for_time, Event::pause_q, transitions::of_waiting(Outcome::goes_on),
     "pause_and_program"},
    {Doing::program_waits_for_motion, Event::pause_q, transitions::of_waiting(Outcome::goes_on),
     "pause_and_program"},
    {Doing::line, Event::go_on_q, transitions::any(Outcome::does_as_before), "list, REDO"},
    {Doing::move, Event::go_on_q, transitions::any(Outcome::does_as_before), "list, REDO"},
    {Doing::homing, Event::go_on_q, transitions::any(Outcome::does_as_before), "list, REDO"},
    {Doing::jog, Event::go_on_q, transitions::any(Outcome::does_as_before), "list, REDO"},
    {Doing::thrust, Event::go_on_q, transitions::any(Outcome::does_as_before), "list, REDO"},
    {Doing::program_runs, Event::go_on_q, transitions::any(Outcome::goes_on), "while_program_runs"},
    {Doing::program_waits_for_number, Event::go_on_q, transitions::of_waiting(Outcome::goes_on),
     "lines_for_a_number"},
    {Doing::program_waits_for_time, Event::go_on_q, transitions::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    {Doing::program_waits_for_motion, Event::go_on_q, transitions::of_waiting(Outcome::goes_on),
     "while_program_runs"},
};

/// Checks that every cell has exactly one row.
consteval bool every_transition_has_a_row() {
  for (std::size_t doing = 0; doing < kDoings; ++doing) {
    for (std::size_t event = 0; event < kEvents; ++event) {
      int rows = 0;
      for (const Transition& row : kTransitions) {
        rows += static_cast<std::size_t>(row.doing) == doing && static_cast<std::size_t>(row.event) == event;
      }
      if (rows != 1) return false;
    }
  }
  return true;
}
static_assert(every_transition_has_a_row());

constexpr Outcome outcome_of(Doing doing, Event event, From from) {
  for (const Transition& row : kTransitions) {
    if (row.doing == doing && row.event == event) return row.outcomes[static_cast<std::size_t>(from)];
  }
  return Outcome::cannot_be;
}

}  // namespace understudy::emulator::models::slim
