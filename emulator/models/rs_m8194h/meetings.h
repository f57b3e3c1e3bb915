// RS-M8194H: where commands meet what an axis does, as data. The code asks these tables, and a test walks
// their cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/models/rs_m8194h/axis_unit.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

/// What an axis does.
enum class Going : std::uint8_t { idle, single, path, homing };
inline constexpr std::size_t kGoings = 4;

// --- starting: rows in the order in which they are asked, the first that holds decides --------------------

/// What stands against a drive, beside its axis being in motion.
enum class Obstacle : std::uint8_t {
  emergency_state,
  lock,
  path_lock,
  emergency_input,
  alarm,
  servo_off,  // where drives need it, which is a choice
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
  bool sets_error;  // of the error code,
  ErrorBit error;   // this bit
};
/// 7.5.1 to 7.5.10, 3.12. A lock is told of when it is set, not by what it voids.
inline constexpr std::array<ObstacleRow, kObstacles> kObstacleRows{{
    {Obstacle::emergency_state, Start::is_void, Start::is_void, false, ErrorBit::soft_emergency},
    {Obstacle::lock, Start::is_void, Start::is_void, false, ErrorBit::soft_stop},
    {Obstacle::path_lock, Start::is_void, Start::is_void, false, ErrorBit::soft_stop},
    {Obstacle::emergency_input, Start::is_void, Start::is_void, true, ErrorBit::emergency},
    {Obstacle::alarm, Start::is_void, Start::is_void, true, ErrorBit::alarm},
    {Obstacle::servo_off, Start::is_void, Start::is_void, false, ErrorBit::reserved},
    {Obstacle::hold, Start::is_held, Start::starts, false, ErrorBit::reserved},
}};

/// Without obstacles.
struct GoingRow {
  Going going;
  Start command;
  Start external;
};
inline constexpr std::array<GoingRow, kGoings> kGoingRows{{
    {Going::idle, Start::starts, Start::starts},
    {Going::single, Start::waits, Start::is_void},
    {Going::path, Start::waits, Start::is_void},
    {Going::homing, Start::waits, Start::is_void},
}};

// --- stopping ----------------------------------------------------------------------------------------------

enum class Halt : std::uint8_t { goes_on, slows, stops };

struct StopRow {
  lang::Verb verb;
  std::uint8_t type;                // stopType of EMERGENCY_STOP, else 0
  std::array<Halt, kGoings> halts;  // by Going; a path slows or stops with all its axes
  bool locks;                       // L
  bool locks_path;                  // V
  bool drops_held_drive;
  bool drops_hold;
  ErrorBit error;
};
inline constexpr std::array<StopRow, 6> kStopRows{{
    {lang::Verb::stop_slowly,
     0,
     {Halt::goes_on, Halt::slows, Halt::slows, Halt::slows},
     true,
     false,
     true,
     false,
     ErrorBit::soft_stop},
    {lang::Verb::stop_suddenly,
     0,
     {Halt::goes_on, Halt::stops, Halt::stops, Halt::stops},
     true,
     false,
     true,
     false,
     ErrorBit::soft_stop},
    {lang::Verb::vstop_slowly,
     0,
     {Halt::goes_on, Halt::goes_on, Halt::slows, Halt::goes_on},
     false,
     true,
     true,
     false,
     ErrorBit::soft_stop},
    {lang::Verb::vstop_suddenly,
     0,
     {Halt::goes_on, Halt::goes_on, Halt::stops, Halt::goes_on},
     false,
     true,
     true,
     false,
     ErrorBit::soft_stop},
    {lang::Verb::emergency_stop,
     0,
     {Halt::goes_on, Halt::stops, Halt::stops, Halt::stops},
     false,
     false,
     true,
     true,
     ErrorBit::soft_emergency},
    {lang::Verb::emergency_stop,
     1,
     {Halt::goes_on, Halt::slows, Halt::slows, Halt::slows},
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

// --- what a motion has left to be done, and what takes that away
// ----------------------------------------------

enum class Mark : std::uint8_t {
  paused_drive,    // the rest of a drive that a trigger's pause holds
  external_drive,  // what an EXD input has begun, and edges that wait behind it
  trigger_hold,    // an axis that a trigger's level holds until it ends
};
inline constexpr std::size_t kMarks = 3;

enum class WayOut : std::uint8_t {
  stop,
  path_stop,
  emergency_stop,
  cause,  // a limit, an alarm, EMG
  other_drive,
  release,  // DRV_START
  triggers_off,
};
inline constexpr std::size_t kWaysOut = 7;

/// RESET_CARD and power-off take all of them.
inline constexpr std::array<std::array<bool, kWaysOut>, kMarks> kTakenOff{{
    // stop, VSTOP, emergency stop, cause, another drive, DRV_START, triggers off
    {true, false, true, true, true, false, false},
    {true, false, true, true, true, false, false},
    {false, false, true, false, false, true, true},
}};
constexpr bool takes_off(WayOut way, Mark mark) {
  return kTakenOff[static_cast<std::size_t>(mark)][static_cast<std::size_t>(way)];
}

// --- clearing ----------------------------------------------------------------------------------------------

/// What of an error code stays when CLEAR_STOP or CLEAR_VSTOP has taken its lock away (A-35, 6.2): of the
/// other lock, of the emergency state, and of an input that is still active.
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

/// A drive that starts takes these away: what it has left behind it.
inline constexpr std::uint16_t kClearedByDrive =
    bit_of(ErrorBit::soft_limit_plus) | bit_of(ErrorBit::soft_limit_minus) | bit_of(ErrorBit::limit_plus) |
    bit_of(ErrorBit::limit_minus) | bit_of(ErrorBit::alarm) | bit_of(ErrorBit::emergency) |
    bit_of(ErrorBit::home);

}  // namespace understudy::emulator::models::rs_m8194h
