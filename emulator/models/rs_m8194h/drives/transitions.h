// RS-M8194H: the effect of a command in each state of an axis, as data. The code looks up these tables, and a
// test checks every cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

// --- starting: the rows are checked in order, and the first applicable row decides -------------------------

/// The obstacles that can prevent a drive, apart from a motion of its axis.
enum class Obstacle : std::uint8_t {
  emergency_state,
  lock,
  path_lock,
  emergency_input,
  alarm,
  servo_off,  // if a choice requires the servo to be on
  hold
};
inline constexpr std::size_t kObstacles = 7;

enum class Starter : std::uint8_t {
  command,   // a drive of single axes, or a path, from the FIFO or a macro
  external,  // an EXD input, or a drive action of a synchronous action
};

enum class Start : std::uint8_t { starts, waits, is_void, is_held };

struct ObstacleRow {
  Obstacle obstacle;
  Start command;
  Start external;
  bool sets_error;  // true: it sets a bit in the error code
  ErrorBit error;   // the bit in the error code
};
/// Obstacles (7.5.1 to 7.5.10, 3.12). A lock sets its error bit when the lock is set, not when it prevents a
/// drive.
inline constexpr std::array<ObstacleRow, kObstacles> kObstacleRows{{
    {Obstacle::emergency_state, Start::is_void, Start::is_void, false, ErrorBit::soft_emergency},
    {Obstacle::lock, Start::is_void, Start::is_void, false, ErrorBit::soft_stop},
    {Obstacle::path_lock, Start::is_void, Start::is_void, false, ErrorBit::soft_stop},
    {Obstacle::emergency_input, Start::is_void, Start::is_void, true, ErrorBit::emergency},
    {Obstacle::alarm, Start::is_void, Start::is_void, true, ErrorBit::alarm},
    {Obstacle::servo_off, Start::is_void, Start::is_void, false, ErrorBit::reserved},
    {Obstacle::hold, Start::is_held, Start::starts, false, ErrorBit::reserved},
}};

/// The effect of a start without obstacles.
struct ActivityRow {
  Activity activity;
  Start command;
  Start external;
};
inline constexpr std::array<ActivityRow, kActivities> kActivityRows{{
    {Activity::idle, Start::starts, Start::starts},
    {Activity::single, Start::waits, Start::is_void},
    {Activity::path, Start::waits, Start::is_void},
    {Activity::homing, Start::waits, Start::is_void},
}};

// --- stopping ----------------------------------------------------------------------------------------------

enum class Halt : std::uint8_t { continues, slows, stops };

struct StopRow {
  lang::Verb verb;
  std::uint8_t type;                    // stopType of EMERGENCY_STOP, otherwise 0
  std::array<Halt, kActivities> halts;  // by Activity; a path slows down or stops with all its axes
  bool locks;                           // sets lock L
  bool locks_path;                      // sets lock V
  bool drops_held_drive;
  bool drops_hold;
  ErrorBit error;
};
inline constexpr std::array<StopRow, 6> kStopRows{{
    {lang::Verb::stop_slowly,
     0,
     {Halt::continues, Halt::slows, Halt::slows, Halt::slows},
     true,
     false,
     true,
     false,
     ErrorBit::soft_stop},
    {lang::Verb::stop_suddenly,
     0,
     {Halt::continues, Halt::stops, Halt::stops, Halt::stops},
     true,
     false,
     true,
     false,
     ErrorBit::soft_stop},
    {lang::Verb::vstop_slowly,
     0,
     {Halt::continues, Halt::continues, Halt::slows, Halt::continues},
     false,
     true,
     true,
     false,
     ErrorBit::soft_stop},
    {lang::Verb::vstop_suddenly,
     0,
     {Halt::continues, Halt::continues, Halt::stops, Halt::continues},
     false,
     true,
     true,
     false,
     ErrorBit::soft_stop},
    {lang::Verb::emergency_stop,
     0,
     {Halt::continues, Halt::stops, Halt::stops, Halt::stops},
     false,
     false,
     true,
     true,
     ErrorBit::soft_emergency},
    {lang::Verb::emergency_stop,
     1,
     {Halt::continues, Halt::slows, Halt::slows, Halt::slows},
     false,
     false,
     true,
     true,
     ErrorBit::soft_emergency},
}};

constexpr const StopRow& stop_row(lang::Verb verb, std::uint32_t type = 0) {
  for (const StopRow& row : kStopRows) {
    if (row.verb == verb && row.type == type) return row;
  }
  throw "not a stop";
}

// --- the remaining work of a motion, and what discards it --------------------------------------------------

enum class Mark : std::uint8_t {
  paused_drive,    // the rest of a drive during a trigger's pause
  external_drive,  // a drive that an EXD input has started, and the edges that wait for its end
  trigger_hold,    // an axis that a trigger's level holds
};
inline constexpr std::size_t kMarks = 3;

enum class DiscardEvent : std::uint8_t {
  stop,
  path_stop,
  emergency_stop,
  cause,  // a limit, an alarm, EMG
  other_drive,
  release,  // DRV_START
  triggers_off,
};
inline constexpr std::size_t kDiscardEvents = 7;

/// Which event discards which mark. RESET_CARD and power-off discard all of them.
inline constexpr std::array<std::array<bool, kDiscardEvents>, kMarks> kDiscards{{
    // stop, VSTOP, emergency stop, cause, another drive, DRV_START, triggers off
    {true, false, true, true, true, false, false},
    {true, false, true, true, true, false, false},
    {false, false, true, false, false, true, true},
}};
constexpr bool takes_off(DiscardEvent event, Mark mark) {
  return kDiscards[static_cast<std::size_t>(mark)][static_cast<std::size_t>(event)];
}

// --- clearing ----------------------------------------------------------------------------------------------

/// The reasons to keep bits of an error code when CLEAR_STOP or CLEAR_VSTOP removes the corresponding lock
/// (A-35, 6.2): the other lock, the emergency state, and inputs that are still active.
struct Cleared {
  bool other_lock = false;
  bool emergency_state = false;
  bool alarm_is_active = false;
  bool emergency_input = false;
};
constexpr std::uint16_t error_left(std::uint16_t code, const Cleared& still) {
  std::uint16_t left = 0;
  if (still.other_lock) left |= bit_of(ErrorBit::soft_stop);
  if (still.emergency_state) left |= bit_of(ErrorBit::soft_emergency);
  if (still.alarm_is_active) left |= bit_of(ErrorBit::alarm);
  if (still.emergency_input) left |= bit_of(ErrorBit::emergency);
  return code & left;
}

/// The error bits of earlier motions, which a starting drive clears.
inline constexpr std::uint16_t kClearedByDrive =
    bit_of(ErrorBit::soft_limit_plus) | bit_of(ErrorBit::soft_limit_minus) | bit_of(ErrorBit::limit_plus) |
    bit_of(ErrorBit::limit_minus) | bit_of(ErrorBit::alarm) | bit_of(ErrorBit::emergency) |
    bit_of(ErrorBit::home);

}  // namespace understudy::emulator::models::rs_m8194h
