// Homing as a table of phases: what the axis looks for, in which direction and how fast, and what it does
// then.
//
//   phase 0  search +, fast, until home on, slow down      ──────────╮ home
//   phase 1  search -, creep, until home off, stop            ╭──────╯
//   phase 2  search +, creep, until home on, stop             ╰─────● the reference
//
// The tables of the four controllers are in motion/homing_tables.h; the code that runs them, homing_run.cpp,
// knows none of them. Every edge is met at its pulse (motion/surroundings.h).
#pragma once

#include <array>
#include <cstdint>

#include "motion/move.h"
#include "motion/surroundings.h"

namespace understudy::motion {

enum class Cause : std::uint8_t;  // motion/axis.h

/// One row of a homing table.
struct HomingPhase {
  enum class Does : std::uint8_t {
    search,   // goes `way` until `until` turns `until_on`, as a fresh edge, `count` times
    go,       // by `distance_pulses`; repeatedly while a signal of `again_while` is on, if any is given;
              // one that runs on is past them at the speed of the next phase, or goes at that from the start
              // where they are too few to slow down to it
    go_back,  // to the travel that a phase before marked
    hang,     // goes `way` at speed 0: no pulse, until a command ends it (Simple2-R3)
  };
  enum class Then : std::uint8_t {
    stop_at_once,
    slow_down,
    run_on,  // into the next phase, a search in the same direction; another one begins with a stop at once
  };

  // Where homing goes: the number of a row, or one of these.
  static constexpr std::int8_t kRowBelow = -1;  // below the last row: home is found
  static constexpr std::int8_t kFail = -2;
  static constexpr std::int8_t kNext = -3;   // wherever `next` says
  static constexpr std::int8_t kAwait = -4;  // nowhere: the signal must go away and come again

  Does does = Does::search;
  std::int8_t way = +1;   // +1 or -1; of go and go_back the sign of the distance
  std::int8_t speed = 0;  // which of the program's laws
  Signal until = Signal::home;
  bool until_on = true;
  Then then = Then::slow_down;
  bool marks = false;     // the travel of the edge becomes the reference
  std::uint8_t code = 0;  // what the controller shows meanwhile; nothing to the engine
  std::int32_t count = 1;
  Signals again_while = 0;
  std::int64_t distance_pulses = 0;
  std::int64_t within_pulses = 0;  // of a search: after this many it stops at once; 0: never
  Signals ignores = 0;             // the axis does not react to these meanwhile

  std::int8_t next = kRowBelow;    // when met and, unless it runs on, standing
  std::int8_t if_already = kNext;  // `until` is as sought when the phase begins; kNext: that counts as met
  std::int8_t if_gone = kNext;     // standing, and `until` is not as sought any more: overrun, or it moved
  std::int8_t if_limit = kFail;    // stopped by a limit ahead, or kept from starting, before it is met; once
                                   // met, the stop does no harm where this is not kFail
  std::int8_t if_far = kFail;      // stopped after `within_pulses`

  bool operator==(const HomingPhase&) const = default;
};

struct HomingProgram {
  static constexpr std::size_t kMaxPhases = 8;
  static constexpr std::size_t kMaxSpeeds = 2;

  std::array<HomingPhase, kMaxPhases> phases{};
  std::int8_t phase_count = 0;  // 0: home is where the axis is
  std::array<SpeedLaw, kMaxSpeeds> speeds{};
  bool soft_limits_lead_on = false;  // where `if_limit` says; else homing fails at them

  bool operator==(const HomingProgram&) const = default;

  /// A row below the others. Throws BadMotion(no_room) beyond kMaxPhases.
  void add(const HomingPhase& phase);
};

/// Throws BadMotion for a table that cannot be run: a missing row or speed, a count below 1, a speed law that
/// a row uses and motion/move.h refuses.
void check(const HomingProgram& program);

/// A homing under way, and afterwards its result.
struct Homing {
  HomingProgram program;
  std::int8_t phase = -1;         // the row that runs; -1: not homing
  std::int8_t ended_in = -1;      // the row that ran when the last homing ended
  Cause ended_by{};               // arrived: home is found. Set before the end when it slows down to give up
  bool met = false;               // the row has what it looked for, and comes to a stop
  std::int32_t counted = 0;       // edges of the row's signal, so far
  std::int64_t began_pulses = 0;  // travel where the row began
  bool reference_known = false;
  std::int64_t reference_pulses = 0;  // travel at the marked edge; without a mark, where the axis stood

  bool operator==(const Homing&) const = default;

  bool active() const { return phase >= 0; }
  const HomingPhase& row() const { return program.phases[static_cast<std::size_t>(phase)]; }
  /// The law of the next row, where the one that runs is a distance and goes over into it in motion.
  const SpeedLaw* runs_on_by() const;
  /// The profile of such a row.
  Profile plan_to_run_on() const;
};

}  // namespace understudy::motion
