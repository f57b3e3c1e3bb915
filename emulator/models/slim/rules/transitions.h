// The transition table of the chain and its program: the effect of pauses, resumes and stops on each
// activity. Each cell contains the outcome and its source: a line of the command list, or the first option of
// a row of choices.h.
//
// The code follows this table (chain/stops.cpp for motions; dialogue.cpp and commands.cpp for programs), and
// transitions_test.cpp checks every cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace understudy::emulator::models::slim {

/// The activities. The last four are those of a program, which may run during any of the other activities.
enum class ActiveTask : std::uint8_t {
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
inline constexpr std::size_t kActiveTasks = 9;

enum class Event : std::uint8_t {
  pause,     // TAPZ
  resume,    // TAREDO, during the pause
  give_up,   // TAUPZ, during the pause
  stop,      // TASTOP
  pause_q,   // PZ
  resume_q,  // REDO, during that pause
};
inline constexpr std::size_t kEvents = 6;

/// The source of a command.
enum class From : std::uint8_t { host, program, event_routine };
inline constexpr std::size_t kSources = 3;

enum class Outcome : std::uint8_t {
  // For a motion:
  decelerates,          // decelerates along its ramp, on its path; nothing of it is lost
  continues_as_before,  // continues as before the pause
  is_dropped,           // is at rest and does not continue
  stops_at_once,        // stops without a further pulse and does not continue
  // For a program:
  continues,           // unaffected: it continues to wait, or executes its next line
  ends,                // executes no further line
  ends_after_routine,  // the event routine continues to its RET, but the interrupted program does not
  cannot_be,           // impossible: a waiting program sends no command, except in an event routine
};

struct Transition {
  ActiveTask task;
  Event event;
  std::array<Outcome, kSources> outcomes;  // by From: the host, the program, an event routine
  std::string_view by;
};

namespace transitions {
constexpr std::array<Outcome, kSources> any(Outcome outcome) { return {outcome, outcome, outcome}; }
constexpr std::array<Outcome, kSources> of_waiting(Outcome outcome) {
  return {outcome, Outcome::cannot_be, outcome};
}
}  // namespace transitions

inline constexpr Transition kTransitions[] = {
    // --- TAPZ: all moving motors slow down immediately, in step, and stay on the path
    {ActiveTask::line, Event::pause, transitions::any(Outcome::decelerates), "list, TAPZ"},
    {ActiveTask::move, Event::pause, transitions::any(Outcome::decelerates), "list, TAPZ"},
    {ActiveTask::homing, Event::pause, transitions::any(Outcome::decelerates), "list, TAPZ"},
    {ActiveTask::jog, Event::pause, transitions::any(Outcome::decelerates), "list, TAPZ"},
    {ActiveTask::thrust, Event::pause, transitions::any(Outcome::decelerates), "list, TAPZ"},
    {ActiveTask::program_runs, Event::pause, transitions::any(Outcome::continues), "pause_in_program"},
    {ActiveTask::program_waits_for_number, Event::pause, transitions::of_waiting(Outcome::continues),
     "lines_for_a_number"},
    {ActiveTask::program_waits_for_time, Event::pause, transitions::of_waiting(Outcome::continues),
     "pause_in_program"},
    {ActiveTask::program_waits_for_motion, Event::pause, transitions::of_waiting(Outcome::continues),
     "pause_in_program"},
    // --- TAREDO: all motors immediately continue what they did before the pause
    {ActiveTask::line, Event::resume, transitions::any(Outcome::continues_as_before), "list, TAREDO"},
    {ActiveTask::move, Event::resume, transitions::any(Outcome::continues_as_before), "list, TAREDO"},
    {ActiveTask::homing, Event::resume, transitions::any(Outcome::continues_as_before), "list, TAREDO"},
    {ActiveTask::jog, Event::resume, transitions::any(Outcome::continues_as_before), "list, TAREDO"},
    {ActiveTask::thrust, Event::resume, transitions::any(Outcome::continues_as_before), "list, TAREDO"},
    {ActiveTask::program_runs, Event::resume, transitions::any(Outcome::continues), "while_program_runs"},
    {ActiveTask::program_waits_for_number, Event::resume, transitions::of_waiting(Outcome::continues),
     "lines_for_a_number"},
    {ActiveTask::program_waits_for_time, Event::resume, transitions::of_waiting(Outcome::continues),
     "while_program_runs"},
    {ActiveTask::program_waits_for_motion, Event::resume, transitions::of_waiting(Outcome::continues),
     "while_program_runs"},
    // --- TAUPZ: the unfinished command and the whole buffer are abandoned
    {ActiveTask::line, Event::give_up, transitions::any(Outcome::is_dropped), "list, TAUPZ"},
    {ActiveTask::move, Event::give_up, transitions::any(Outcome::is_dropped), "list, TAUPZ"},
    {ActiveTask::homing, Event::give_up, transitions::any(Outcome::is_dropped), "list, TAUPZ"},
    {ActiveTask::jog, Event::give_up, transitions::any(Outcome::is_dropped), "list, TAUPZ"},
    {ActiveTask::thrust, Event::give_up, transitions::any(Outcome::is_dropped), "list, TAUPZ"},
    {ActiveTask::program_runs, Event::give_up, transitions::any(Outcome::continues), "while_program_runs"},
    {ActiveTask::program_waits_for_number, Event::give_up, transitions::of_waiting(Outcome::continues),
     "lines_for_a_number"},
    {ActiveTask::program_waits_for_time, Event::give_up, transitions::of_waiting(Outcome::continues),
     "while_program_runs"},
    {ActiveTask::program_waits_for_motion, Event::give_up, transitions::of_waiting(Outcome::continues),
     "while_program_runs"},
    // --- TASTOP: all axes stop immediately, as in an emergency
    {ActiveTask::line, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {ActiveTask::move, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {ActiveTask::homing, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {ActiveTask::jog, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {ActiveTask::thrust, Event::stop, transitions::any(Outcome::stops_at_once), "list, TASTOP"},
    {ActiveTask::program_runs,
     Event::stop,
     {Outcome::ends, Outcome::continues, Outcome::ends_after_routine},
     "emergency_stop_program"},
    {ActiveTask::program_waits_for_number,
     Event::stop,
     {Outcome::ends, Outcome::cannot_be, Outcome::ends_after_routine},
     "emergency_stop_program"},
    {ActiveTask::program_waits_for_time,
     Event::stop,
     {Outcome::ends, Outcome::cannot_be, Outcome::ends_after_routine},
     "emergency_stop_program"},
    {ActiveTask::program_waits_for_motion,
     Event::stop,
     {Outcome::ends, Outcome::cannot_be, Outcome::ends_after_routine},
     "emergency_stop_program"},
    // --- PZ and REDO: as TAPZ and TAREDO for motions; programs have separate rows
    {ActiveTask::line, Event::pause_q, transitions::any(Outcome::decelerates), "pause_scope"},
    {ActiveTask::move, Event::pause_q, transitions::any(Outcome::decelerates), "pause_scope"},
    {ActiveTask::homing, Event::pause_q, transitions::any(Outcome::decelerates), "pause_scope"},
    {ActiveTask::jog, Event::pause_q, transitions::any(Outcome::decelerates), "pause_scope"},
    {ActiveTask::thrust, Event::pause_q, transitions::any(Outcome::decelerates), "pause_scope"},
    {ActiveTask::program_runs, Event::pause_q, transitions::any(Outcome::continues), "pause_and_program"},
    {ActiveTask::program_waits_for_number, Event::pause_q, transitions::of_waiting(Outcome::continues),
     "pause_and_program"},
    {ActiveTask::program_waits_for_time, Event::pause_q, transitions::of_waiting(Outcome::continues),
     "pause_and_program"},
    {ActiveTask::program_waits_for_motion, Event::pause_q, transitions::of_waiting(Outcome::continues),
     "pause_and_program"},
    {ActiveTask::line, Event::resume_q, transitions::any(Outcome::continues_as_before), "list, REDO"},
    {ActiveTask::move, Event::resume_q, transitions::any(Outcome::continues_as_before), "list, REDO"},
    {ActiveTask::homing, Event::resume_q, transitions::any(Outcome::continues_as_before), "list, REDO"},
    {ActiveTask::jog, Event::resume_q, transitions::any(Outcome::continues_as_before), "list, REDO"},
    {ActiveTask::thrust, Event::resume_q, transitions::any(Outcome::continues_as_before), "list, REDO"},
    {ActiveTask::program_runs, Event::resume_q, transitions::any(Outcome::continues), "while_program_runs"},
    {ActiveTask::program_waits_for_number, Event::resume_q, transitions::of_waiting(Outcome::continues),
     "lines_for_a_number"},
    {ActiveTask::program_waits_for_time, Event::resume_q, transitions::of_waiting(Outcome::continues),
     "while_program_runs"},
    {ActiveTask::program_waits_for_motion, Event::resume_q, transitions::of_waiting(Outcome::continues),
     "while_program_runs"},
};

/// The number of this table in transition_tables.h.
inline constexpr std::size_t kTaskTable = 0;

/// Checks that every cell has exactly one row.
consteval bool every_transition_has_a_row() {
  for (std::size_t task = 0; task < kActiveTasks; ++task) {
    for (std::size_t event = 0; event < kEvents; ++event) {
      int rows = 0;
      for (const Transition& row : kTransitions) {
        rows += static_cast<std::size_t>(row.task) == task && static_cast<std::size_t>(row.event) == event;
      }
      if (rows != 1) return false;
    }
  }
  return true;
}
static_assert(every_transition_has_a_row());

constexpr Outcome outcome_of(ActiveTask task, Event event, From from) {
  for (const Transition& row : kTransitions) {
    if (row.task == task && row.event == event) return row.outcomes[static_cast<std::size_t>(from)];
  }
  return Outcome::cannot_be;
}

}  // namespace understudy::emulator::models::slim
