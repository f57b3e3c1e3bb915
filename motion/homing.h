// Homing as a table of phases. Each phase defines what the axis searches for, in which direction, how fast,
// and what it does when it finds it.
//
//   phase 0  search +, fast, until home on, slow down      ──────────╮ home
//   phase 1  search -, creep, until home off, stop            ╭──────╯
//   phase 2  search +, creep, until home on, stop             ╰─────● the reference
//
// The tables of the four controllers are in motion/homing_tables.h. The code that runs them, homing_run.cpp,
// is independent of the controllers. Every edge is handled at its pulse (motion/environment.h).
#pragma once

#include <array>
#include <cstdint>

#include "motion/environment.h"
#include "motion/move.h"

namespace understudy::motion {

enum class Cause : std::uint8_t;  // motion/axis.h

/// One row of a homing table.
struct HomingPhase {
  enum class Does : std::uint8_t {
    search,  // moves in `direction` until `until` turns `until_on`, as a fresh edge, `count` times
    // Moves by `distance_pulses`, and repeats this while a signal of `again_while` is on. If it runs on, it
    // ends at the speed of the next phase. If the distance is too short to decelerate, it has that speed from
    // the start.
    go,
    go_back,             // returns to the travel that an earlier phase marked
    move_at_zero_speed,  // moves in `direction` at speed 0: no pulse, until a command ends it (Simple2-R3)
  };
  enum class Then : std::uint8_t {
    stop_at_once,
    slow_down,
    run_on,  // continues into the next phase if that is a search in the same direction; otherwise stops at
             // once
  };

  // The row that follows: the number of a row, or one of these.
  static constexpr std::int8_t kRowBelow = -1;  // the row below; home is found if this is the last row
  static constexpr std::int8_t kFail = -2;
  static constexpr std::int8_t kNext = -3;   // as `next` says
  static constexpr std::int8_t kAwait = -4;  // stays in this row: the signal must go off and come on again

  Does does = Does::search;
  std::int8_t direction = +1;  // +1 or -1; go and go_back use the sign of their distance
  std::int8_t speed = 0;       // index into HomingProgram::speeds
  Signal until = Signal::home;
  bool until_on = true;
  Then then = Then::slow_down;
  bool marks = false;     // true: the travel at the edge becomes the reference
  std::uint8_t code = 0;  // the number that the controller shows during this phase; motion does not use it
  std::int32_t count = 1;
  Signals again_while = 0;
  std::int64_t distance_pulses = 0;
  std::int64_t within_pulses = 0;  // distance after which a search stops at once; 0: no limit
  Signals ignores = 0;             // signals that the axis does not react to during this phase

  // The row that follows in each of these cases.
  // The signal is met and the axis has stopped (unless the phase runs on).
  std::int8_t next = kRowBelow;
  // `until` already has the required state when the phase begins. kNext: it counts as met.
  std::int8_t if_already = kNext;
  // The axis is at rest, but `until` no longer has the required state.
  std::int8_t if_gone = kNext;
  // A limit ahead stops the phase or keeps it from starting, before the signal is met. Unless this is kFail,
  // a limit after the signal is met has no effect.
  std::int8_t if_limit = kFail;
  std::int8_t if_far = kFail;  // the phase stopped after `within_pulses`

  bool operator==(const HomingPhase&) const = default;
};

struct HomingProgram {
  static constexpr std::size_t kMaxPhases = 8;
  static constexpr std::size_t kMaxSpeeds = 2;

  std::array<HomingPhase, kMaxPhases> phases{};
  std::int8_t phase_count = 0;  // 0: home is the present position of the axis
  std::array<SpeedLaw, kMaxSpeeds> speeds{};
  bool soft_limits_lead_on = false;  // true: soft limits lead to `if_limit`; false: homing fails at them

  bool operator==(const HomingProgram&) const = default;

  /// Appends a row. Throws BadMotion(no_room) if there are already kMaxPhases.
  void add(const HomingPhase& phase);
};

/// Throws BadMotion for a table that cannot run: a row or a speed is missing, a count is below 1, or
/// motion/move.h refuses a speed law that is used.
void check(const HomingProgram& program);

/// The state of a running homing, and its result afterwards.
struct Homing {
  HomingProgram program;
  std::int8_t phase = -1;     // the current row; -1: not homing
  std::int8_t ended_in = -1;  // the row in which the last homing ended
  // `arrived` means that home was found. If homing has failed and the axis decelerates, this is set before
  // the axis stops.
  Cause ended_by{};
  bool met = false;               // true: the signal of the row is met, and the axis is stopping
  std::int32_t counted = 0;       // edges of the row's signal so far
  std::int64_t began_pulses = 0;  // travel where the row began
  bool reference_known = false;
  std::int64_t reference_pulses = 0;  // travel at the marked edge; without a mark, where the axis was

  bool operator==(const Homing&) const = default;

  bool active() const { return phase >= 0; }
  const HomingPhase& row() const { return program.phases[static_cast<std::size_t>(phase)]; }
  /// Returns the speed law of the next row if the current row is a distance that runs on into it. Otherwise
  /// returns null.
  const SpeedLaw* runs_on_by() const;
  /// Returns the profile of the current row. Call it only if runs_on_by() is not null.
  Profile plan_to_run_on() const;
};

}  // namespace understudy::motion
