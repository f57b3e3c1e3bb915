// The transition table of pauses, resumes and stops against the activities of the chain and its program. Each
// cell has its outcome and the source for it: the list's line, or a row of choices.h, whose first option it
// is.
//
// The code follows this table (chain_stops.cpp for motions; dialogue.cpp and commands.cpp for programs), and
// meetings_test.cpp checks every cell.
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

enum class Meeting : std::uint8_t {
  pause,    // TAPZ
  go_on,    // TAREDO, during the pause
  give_up,  // TAUPZ, during the pause
  stop,     // TASTOP
  pause_q,  // PZ
  go_on_q,  // REDO, during that pause
};
inline constexpr std::size_t kMeetings = 6;

/// Where the command comes from.
enum class From : std::uint8_t { host, program, event_routine };
inline constexpr std::size_t kSources = 3;

enum class Outcome : std::uint8_t {
  // of a motion:
  comes_to_a_stand,  // slows down by its ramp, on its path; nothing of it is lost
  does_as_before,    // continues what it did before the pause
  is_forgotten,      // stands still and does not continue
  stops_at_once,     // stops without another pulse and does not continue
  // of a program:
  goes_on,             // continues as if nothing had happened: it waits on, or takes its next line
  ends,                // takes no further line
  ends_after_routine,  // the event's routine continues to its RET, but the interrupted program does not
  cannot_be,           // impossible: a waiting program gives no command, except in an event's routine
};

struct MeetingRow {
  Doing doing;
  Meeting meeting;
  std::array<Outcome, kSources> outcomes;  // by From: the host, the program, an event's routine
  std::string_view by;
};

namespace meetings {
constexpr std::array<Outcome, kSources> any(Outcome outcome) { return {outcome, outcome, outcome}; }
constexpr std::array<Outcome, kSources> of_waiting(Outcome outcome) {
  return {outcome, Outcome::cannot_be, outcome};
}
}  // namespace meetings

inline constexpr MeetingRow kMeetingTable[] = {
    // --- TAPZ: "each motor that moves slows down at once, in step, and keeps to its path"
    {Doing::line, Meeting::pause, meetings::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::move, Meeting::pause, meetings::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::homing, Meeting::pause, meetings::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::jog, Meeting::pause, meetings::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::thrust, Meeting::pause, meetings::any(Outcome::comes_to_a_stand), "list, TAPZ"},
    {Doing::program_runs, Meeting::pause, meetings::any(Outcome::goes_on), "pause_in_program"},
    {Doing::program_waits_for_number, Meeting::pause, meetings::of_waiting(Outcome::goes_on),
     "lines_for_a_number"},
    {Doing::program_waits_for_time, Meeting::pause, meetings::of_waiting(Outcome::goes_on),
     "pause_in_program"},
    {Doing::program_waits_for_motion, Meeting::pause, meetings::of_waiting(Outcome::goes_on),
     "pause_in_program"},
    // --- TAREDO: "each motor does at once what it did before the pause"
    {Doing::line, Meeting::go_on, meetings::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::move, Meeting::go_on, meetings::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::homing, Meeting::go_on, meetings::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::jog, Meeting::go_on, meetings::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::thrust, Meeting::go_on, meetings::any(Outcome::does_as_before), "list, TAREDO"},
    {Doing::program_runs, Meeting::go_on, meetings::any(Outcome::goes_on), "while_program_runs"},
    {Doing::program_waits_for_number, Meeting::go_on, meetings::of_waiting(Outcome::goes_on),
     "lines_for_a_number"},
    {Doing::program_waits_for_time, Meeting::go_on, meetings::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    {Doing::program_waits_for_motion, Meeting::go_on, meetings::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    // --- TAUPZ: "the command that is half done, and all in the buffer, are given up"
    {Doing::line, Meeting::give_up, meetings::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::move, Meeting::give_up, meetings::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::homing, Meeting::give_up, meetings::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::jog, Meeting::give_up, meetings::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::thrust, Meeting::give_up, meetings::any(Outcome::is_forgotten), "list, TAUPZ"},
    {Doing::program_runs, Meeting::give_up, meetings::any(Outcome::goes_on), "while_program_runs"},
    {Doing::program_waits_for_number, Meeting::give_up, meetings::of_waiting(Outcome::goes_on),
     "lines_for_a_number"},
    {Doing::program_waits_for_time, Meeting::give_up, meetings::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    {Doing::program_waits_for_motion, Meeting::give_up, meetings::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    // --- TASTOP: "each axis stops at once, in an emergency"
    {Doing::line, Meeting::stop, meetings::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::move, Meeting::stop, meetings::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::homing, Meeting::stop, meetings::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::jog, Meeting::stop, meetings::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::thrust, Meeting::stop, meetings::any(Outcome::stops_at_once), "list, TASTOP"},
    {Doing::program_runs,
     Meeting::stop,
     {Outcome::ends, Outcome::goes_on, Outcome::ends_after_routine},
     "emergency_stop_program"},
    {Doing::program_waits_for_number,
     Meeting::stop,
     {Outcome::ends, Outcome::cannot_be, Outcome::ends_after_routine},
     "emergency_stop_program"},
    {Doing::program_waits_for_time,
     Meeting::stop,
     {Outcome::ends, Outcome::cannot_be, Outcome::ends_after_routine},
     "emergency_stop_program"},
    {Doing::program_waits_for_motion,
     Meeting::stop,
     {Outcome::ends, Outcome::cannot_be, Outcome::ends_after_routine},
     "emergency_stop_program"},
    // --- PZ and REDO: like TAPZ and TAREDO for motions; for programs by a row of their own
    {Doing::line, Meeting::pause_q, meetings::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::move, Meeting::pause_q, meetings::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::homing, Meeting::pause_q, meetings::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::jog, Meeting::pause_q, meetings::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::thrust, Meeting::pause_q, meetings::any(Outcome::comes_to_a_stand), "pause_scope"},
    {Doing::program_runs, Meeting::pause_q, meetings::any(Outcome::goes_on), "pause_and_program"},
    {Doing::program_waits_for_number, Meeting::pause_q, meetings::of_waiting(Outcome::goes_on),
     "pause_and_program"},
    {Doing::program_waits_for_time, Meeting::pause_q, meetings::of_waiting(Outcome::goes_on),
     "pause_and_program"},
    {Doing::program_waits_for_motion, Meeting::pause_q, meetings::of_waiting(Outcome::goes_on),
     "pause_and_program"},
    {Doing::line, Meeting::go_on_q, meetings::any(Outcome::does_as_before), "list, REDO"},
    {Doing::move, Meeting::go_on_q, meetings::any(Outcome::does_as_before), "list, REDO"},
    {Doing::homing, Meeting::go_on_q, meetings::any(Outcome::does_as_before), "list, REDO"},
    {Doing::jog, Meeting::go_on_q, meetings::any(Outcome::does_as_before), "list, REDO"},
    {Doing::thrust, Meeting::go_on_q, meetings::any(Outcome::does_as_before), "list, REDO"},
    {Doing::program_runs, Meeting::go_on_q, meetings::any(Outcome::goes_on), "while_program_runs"},
    {Doing::program_waits_for_number, Meeting::go_on_q, meetings::of_waiting(Outcome::goes_on),
     "lines_for_a_number"},
    {Doing::program_waits_for_time, Meeting::go_on_q, meetings::of_waiting(Outcome::goes_on),
     "while_program_runs"},
    {Doing::program_waits_for_motion, Meeting::go_on_q, meetings::of_waiting(Outcome::goes_on),
     "while_program_runs"},
};

/// Checks that every cell has exactly one row.
consteval bool every_meeting_has_a_row() {
  for (std::size_t doing = 0; doing < kDoings; ++doing) {
    for (std::size_t meeting = 0; meeting < kMeetings; ++meeting) {
      int rows = 0;
      for (const MeetingRow& row : kMeetingTable) {
        rows +=
            static_cast<std::size_t>(row.doing) == doing && static_cast<std::size_t>(row.meeting) == meeting;
      }
      if (rows != 1) return false;
    }
  }
  return true;
}
static_assert(every_meeting_has_a_row());

constexpr Outcome outcome_of(Doing doing, Meeting meeting, From from) {
  for (const MeetingRow& row : kMeetingTable) {
    if (row.doing == doing && row.meeting == meeting) return row.outcomes[static_cast<std::size_t>(from)];
  }
  return Outcome::cannot_be;
}

}  // namespace understudy::emulator::models::slim
