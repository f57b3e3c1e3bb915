// The reaction of a Simple2-R3 axis to each event, as data: mode x phase x event. Commands (commands.cpp) and
// signals (reactions.cpp) use the table, and a test checks all cells against the running device.
//
// Directions are relative to the axis: a limit is "ahead" if the axis moves towards it, and commands are
// "towards" or "away" from the limit that is on. While no limit is on, either word may be used.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "emulator/models/simple2_r3/options.h"

namespace understudy::emulator::models::simple2_r3 {

/// The modes of Axis_Mode; homing is separate from the other motions of position mode.
enum class Activity : std::uint8_t { position, homing, velocity, pwm, sync };
inline constexpr int kActivities = 5;

enum class Phase : std::uint8_t {
  standing,   // no pulses; PWM: 0 percent
  moving,     // PWM: with a duty cycle above 0
  slowing,    // slows down in its direction
  turning,    // slows down to reverse
  leaving,    // moves away from a limit that is on
  at_limit,   // at rest while a limit is on, or stopped by it; PWM: with any duty cycle
  in_alarm,   // no output while the alarm is active
  servo_off,  // no output while the servo is off; only for commands
};
inline constexpr int kPhases = 8;

enum class Event : std::uint8_t {
  limit_ahead,
  limit_behind,
  limit_gone,
  alarm,
  alarm_gone,
  stop,
  servo_off,
  // Commands.
  move_towards,
  move_away,
  move_nowhere,  // a distance of 0
  home,
  velocity_towards,
  velocity_away,
  velocity_zero,
  pwm,
  pwm_zero,
  sync,
};
inline constexpr int kEvents = 17;

enum class Outcome : std::uint8_t {
  continues,        // continues as if nothing had happened
  stops,            // sends no further pulses and no duty cycle; the target is dropped
  leaves,           // like stops, and returns to position mode
  waits,            // sends no pulses and no duty cycle until the cause has disappeared
  turns,            // stops at once and reverses
  slows,            // decelerates along its ramp and stops; the target is dropped
  slows_and_waits,  // like slows, until the cause has disappeared
  blocked,          // follows only in the opposite direction
  resumes,          // continues with the target that was waiting
  dropped,          // the command has no effect
  kept,             // the command waits for SVON
  ends,             // the command has no effect, but the running motion ends
  begins,           // the running motion ends at once, and the command begins from standstill
  changes,          // changes from the present state to the command
};

/// The outcome of a cell if another option is selected.
struct OtherOutcome {
  Option chosen{};
  Outcome outcome = Outcome::continues;
  bool exists = false;

  constexpr OtherOutcome() = default;
  constexpr OtherOutcome(Option option, Outcome what) : chosen(option), outcome(what), exists(true) {}
};

/// A set of Activities, Phases or Events.
using Set = std::uint32_t;
template <class... T>
constexpr Set set_of(T... members) {
  return ((Set{1} << static_cast<unsigned>(members)) | ...);
}
template <class T>
constexpr bool has(Set set, T member) {
  return (set >> static_cast<unsigned>(member) & 1) != 0;
}

struct Transition {
  Set activities, phases, events;
  Outcome outcome;
  /// The section of the manual, or the choice, on which the cell is based.
  std::string_view source;
  OtherOutcome other{}, another{};  // the first one whose option is selected applies
};

namespace transitions {

using enum Phase;
using enum Outcome;
using E = Event;

inline constexpr Set kPositioning = set_of(Activity::position, Activity::homing);
inline constexpr Set kVelocity = set_of(Activity::velocity);
inline constexpr Set kPwm = set_of(Activity::pwm);
inline constexpr Set kSync = set_of(Activity::sync);
inline constexpr Set kPosition = set_of(Activity::position);
inline constexpr Set kHoming = set_of(Activity::homing);
inline constexpr Set kOthers = kVelocity | kPwm | kSync;
inline constexpr Set kAny = kPositioning | kOthers;

inline constexpr Set kRunning = set_of(moving, slowing, turning);
inline constexpr Set kFree = set_of(standing) | kRunning;  // no limit, no alarm
inline constexpr Set kResting = set_of(standing, at_limit);
inline constexpr Set kGoing = kRunning | set_of(leaving);
inline constexpr Set kOnLimit = set_of(leaving, at_limit);
inline constexpr Set kReady = kFree | kOnLimit;
inline constexpr Set kPowered = kReady | set_of(in_alarm);

inline constexpr Set kMoves = set_of(E::move_towards, E::move_away);
inline constexpr Set kVelocities = set_of(E::velocity_towards, E::velocity_away);
inline constexpr Set kDuties = set_of(E::pwm, E::pwm_zero);
inline constexpr Set kCommands = kMoves | set_of(E::move_nowhere, E::home) | kVelocities |
                                 set_of(E::velocity_zero) | kDuties | set_of(E::sync);

inline constexpr Option kModeStays = option("mode_after_stop", "stays");
inline constexpr Option kPwmNeedsNoServo = option("pwm_servo", "not_needed");
inline constexpr Option kAlarmResumes = option("after_alarm", "resumes");
inline constexpr Option kLimitResumes = option("after_limit", "resumes");
inline constexpr Option kPwmStopsAtLimit = option("pwm_at_limit", "stops");

inline constexpr OtherOutcome kUntilServoOn{option("command_while_servo_off", "kept_until_servo_on"), kept};
inline constexpr OtherOutcome kUnlessMoving{option("command_while_moving", "ignored"), dropped};
inline constexpr OtherOutcome kUnlessPositioning{option("mode_change_while_moving", "ignored"), dropped};
inline constexpr OtherOutcome kUnlessInOtherMode{option("move_in_other_mode", "ignored"), dropped};
inline constexpr OtherOutcome kUnlessIntoLimit{option("command_into_limit", "dropped"), dropped};
inline constexpr OtherOutcome kForgotten{kAlarmResumes, ends};  // discards a motion that would have resumed
inline constexpr OtherOutcome kFromTheSpeed{option("move_in_other_mode", "goes_on_from_the_speed"), changes};

// clang-format off
inline constexpr Transition kRows[] = {
    // --- limits ---
    {kPosition | kVelocity, kResting, set_of(E::limit_ahead), continues, "limit_reaction"},
    {kPosition, kGoing,           set_of(E::limit_ahead), stops, "limit_reaction"},
    {kHoming,   kRunning,         set_of(E::limit_ahead), turns, "homing_sequence"},
    {kHoming,   set_of(leaving),  set_of(E::limit_ahead), stops, "homing_sequence"},
    {kVelocity, set_of(moving, slowing, leaving), set_of(E::limit_ahead), stops, "after_limit", {kLimitResumes, waits}},
    {kVelocity, set_of(turning),  set_of(E::limit_ahead), turns, "limit_reaction"},
    {kSync,     kReady,           set_of(E::limit_ahead), blocked, "limit_reaction"},

    {kPositioning, kFree,         set_of(E::limit_behind), continues, "limit_reaction"},
    {kVelocity, set_of(standing, moving, slowing), set_of(E::limit_behind), continues, "limit_reaction"},
    {kVelocity, set_of(turning),  set_of(E::limit_behind), slows, "after_limit", {kLimitResumes, slows_and_waits}},
    {kSync,     kFree,            set_of(E::limit_behind), continues, "limit_reaction"},

    {kPwm,      kPowered,         set_of(E::limit_ahead), continues, "pwm_at_limit", {kPwmStopsAtLimit, stops}},
    {kPwm,      kFree,            set_of(E::limit_behind), continues, "pwm_at_limit", {kPwmStopsAtLimit, stops}},
    {kAny & ~kPwm, set_of(in_alarm), set_of(E::limit_ahead), continues, "limit_reaction"},
    {kAny,      set_of(in_alarm), set_of(E::limit_gone), continues, "limit_reaction"},

    {kPositioning | kPwm, kOnLimit, set_of(E::limit_gone), continues, "limit_reaction"},
    {kVelocity, set_of(leaving),  set_of(E::limit_gone), continues, "limit_reaction"},
    {kVelocity, set_of(at_limit), set_of(E::limit_gone), continues, "after_limit", {kLimitResumes, resumes}},
    {kSync,     set_of(leaving),  set_of(E::limit_gone), continues, "limit_reaction"},
    {kSync,     set_of(at_limit), set_of(E::limit_gone), resumes, "系統參數相關: 0xF024, left by STOP alone"},

    // --- alarm ---
    {kPosition | kVelocity, kResting, set_of(E::alarm), continues, "alarm_reaction"},
    {kPositioning, kGoing,        set_of(E::alarm), stops, "alarm_reaction"},
    {kVelocity, kGoing,           set_of(E::alarm), stops, "after_alarm", {kAlarmResumes, waits}},
    {kPwm, set_of(standing),      set_of(E::alarm), continues, "alarm_reaction"},
    {kPwm, set_of(moving, at_limit), set_of(E::alarm), stops, "after_alarm", {kAlarmResumes, waits}},
    {kSync, kReady,               set_of(E::alarm), waits, "sync_after_alarm", {option("sync_after_alarm", "mode_left"), leaves}},

    {kPosition, set_of(in_alarm), set_of(E::alarm_gone), continues, "alarm_reaction"},
    {kVelocity | kPwm, set_of(in_alarm), set_of(E::alarm_gone), continues, "after_alarm", {kAlarmResumes, resumes}},
    {kSync, set_of(in_alarm),     set_of(E::alarm_gone), resumes, "sync_after_alarm"},

    // --- STOP, SVOFF ---
    {kPosition, kResting | set_of(in_alarm), set_of(E::stop, E::servo_off), continues, "運動相關: 0x100D, 0x1013"},
    {kPositioning, kGoing, set_of(E::stop), stops, "stop", {option("stop", "slows_down"), slows}},
    {kPositioning, kGoing, set_of(E::servo_off), stops, "程式指令列表: 0x2B, SVOFF"},
    {kVelocity, kPowered, set_of(E::stop, E::servo_off), leaves, "mode_after_stop", {kModeStays, stops}},
    {kPwm, kPowered, set_of(E::stop), leaves, "mode_after_stop", {kModeStays, stops}},
    {kPwm, kPowered, set_of(E::servo_off), leaves, "pwm_servo", {kPwmNeedsNoServo, continues}, {kModeStays, stops}},
    {kSync, kPowered, set_of(E::stop), leaves, "系統參數相關: 0xF024"},
    {kSync, kPowered, set_of(E::servo_off), leaves, "程式指令列表: 0x2B, SVOFF"},

    // --- commands while output is forbidden ---
    {kPosition | kVelocity | kPwm, set_of(servo_off), kCommands & ~kDuties, dropped, "command_while_servo_off", kUntilServoOn},
    {kPosition | kVelocity, set_of(servo_off), kDuties, dropped, "pwm_servo", {kPwmNeedsNoServo, begins}, kUntilServoOn},
    {kPwm, set_of(servo_off), kDuties, dropped, "pwm_servo", {kPwmNeedsNoServo, changes}, kUntilServoOn},
    {kPosition | kSync, set_of(in_alarm), kMoves | set_of(E::home, E::sync), dropped, "alarm_reaction"},
    {kVelocity | kPwm, set_of(in_alarm), kMoves | set_of(E::home), dropped, "after_alarm", kUnlessInOtherMode, kForgotten},
    {kVelocity | kPwm, set_of(in_alarm), set_of(E::sync), dropped, "after_alarm", kForgotten},
    {kVelocity, set_of(in_alarm), kVelocities, dropped, "after_alarm", {kAlarmResumes, waits}},
    {kVelocity, set_of(in_alarm), set_of(E::velocity_zero), changes, "系統參數相關: 0xF006, at once"},
    {kPosition | kSync, set_of(in_alarm), kVelocities, dropped, "alarm_reaction"},
    {kPwm, set_of(in_alarm), kVelocities, dropped, "after_alarm", kForgotten},
    {kAny & ~kVelocity, set_of(in_alarm), set_of(E::velocity_zero), begins, "系統參數相關: 0xF006, at once"},
    {kPwm, set_of(in_alarm), set_of(E::pwm), dropped, "after_alarm", {kAlarmResumes, waits}},
    {kPwm, set_of(in_alarm), set_of(E::pwm_zero), changes, "運動相關: 0x1019, at once"},
    {kPosition | kSync, set_of(in_alarm), set_of(E::pwm), dropped, "alarm_reaction"},
    {kVelocity, set_of(in_alarm), set_of(E::pwm), dropped, "after_alarm", kForgotten},
    {kAny & ~kPwm, set_of(in_alarm), set_of(E::pwm_zero), begins, "運動相關: 0x1019, at once"},

    // --- moves and homing ---
    {kAny, kPowered, set_of(E::move_nowhere), begins, "附錄 A: (2), at once"},
    {kPosition, kResting, set_of(E::home, E::move_away), begins, "附錄 A"},
    {kPosition, set_of(standing), set_of(E::move_towards), begins, "附錄 A"},
    {kPosition, set_of(at_limit), set_of(E::move_towards), dropped, "limit_reaction"},
    {kPositioning, kGoing, set_of(E::home, E::move_away), begins, "command_while_moving", kUnlessMoving},
    {kPositioning, kRunning, set_of(E::move_towards), begins, "command_while_moving", kUnlessMoving},
    {kPositioning, set_of(leaving), set_of(E::move_towards), ends, "command_into_limit", kUnlessMoving, kUnlessIntoLimit},
    {kOthers, kReady, set_of(E::home), begins, "move_in_other_mode", kUnlessInOtherMode},
    {kPwm, kReady, set_of(E::move_away), begins, "move_in_other_mode", kUnlessInOtherMode},
    {kPwm, kFree, set_of(E::move_towards), begins, "move_in_other_mode", kUnlessInOtherMode},
    {kVelocity | kSync, kReady, set_of(E::move_away), begins, "move_in_other_mode", kUnlessInOtherMode, kFromTheSpeed},
    {kVelocity | kSync, kFree, set_of(E::move_towards), begins, "move_in_other_mode", kUnlessInOtherMode, kFromTheSpeed},
    {kOthers, kOnLimit, set_of(E::move_towards), ends, "command_into_limit", kUnlessInOtherMode, kUnlessIntoLimit},

    // --- velocity ---
    {kPosition, kResting, set_of(E::velocity_away, E::velocity_zero), begins, "系統參數相關: 0xF006"},
    {kPosition, set_of(standing), set_of(E::velocity_towards), begins, "系統參數相關: 0xF006"},
    {kPosition, set_of(at_limit), set_of(E::velocity_towards), dropped, "limit_reaction"},
    {kPositioning, kGoing, set_of(E::velocity_away, E::velocity_zero), begins, "mode_change_while_moving", kUnlessPositioning},
    {kPositioning, kRunning, set_of(E::velocity_towards), begins, "mode_change_while_moving", kUnlessPositioning},
    {kPositioning, set_of(leaving), set_of(E::velocity_towards), ends, "command_into_limit", kUnlessPositioning, kUnlessIntoLimit},
    {kVelocity, kReady, set_of(E::velocity_away, E::velocity_zero), changes, "系統參數相關: 0xF006, at once"},
    {kVelocity, kFree, set_of(E::velocity_towards), changes, "系統參數相關: 0xF006, at once"},
    {kVelocity, kOnLimit, set_of(E::velocity_towards), slows, "after_limit", {kLimitResumes, slows_and_waits}},
    {kPwm | kSync, kReady, set_of(E::velocity_away, E::velocity_zero), begins, "系統參數相關: 0xF006, at once"},
    {kPwm | kSync, kFree, set_of(E::velocity_towards), begins, "系統參數相關: 0xF006, at once"},
    {kPwm | kSync, kOnLimit, set_of(E::velocity_towards), ends, "command_into_limit", kUnlessIntoLimit},

    // --- PWM, sync ---
    {kPosition, set_of(standing), kDuties, begins, "運動相關: 0x1019, at once"},
    {kPosition, set_of(at_limit), set_of(E::pwm), begins, "pwm_at_limit", {kPwmStopsAtLimit, dropped}},
    {kPosition, set_of(at_limit), set_of(E::pwm_zero), begins, "運動相關: 0x1019, at once"},
    {kPositioning, kRunning, kDuties, begins, "mode_change_while_moving", kUnlessPositioning},
    {kPositioning, set_of(leaving), set_of(E::pwm), begins, "pwm_at_limit", kUnlessPositioning, {kPwmStopsAtLimit, dropped}},
    {kPositioning, set_of(leaving), set_of(E::pwm_zero), begins, "mode_change_while_moving", kUnlessPositioning},
    {kVelocity | kSync, kFree, kDuties, begins, "運動相關: 0x1019, at once"},
    {kVelocity | kSync, kOnLimit, set_of(E::pwm), begins, "pwm_at_limit", {kPwmStopsAtLimit, dropped}},
    {kVelocity | kSync, kOnLimit, set_of(E::pwm_zero), begins, "運動相關: 0x1019, at once"},
    {kPwm, kFree, kDuties, changes, "運動相關: 0x1019, at once"},
    {kPwm, kOnLimit, set_of(E::pwm), changes, "pwm_at_limit", {kPwmStopsAtLimit, dropped}},
    {kPwm, kOnLimit, set_of(E::pwm_zero), changes, "運動相關: 0x1019, at once"},
    {kPosition, kResting, set_of(E::sync), begins, "系統參數相關: 0xF024"},
    {kPositioning, kGoing, set_of(E::sync), begins, "mode_change_while_moving", kUnlessPositioning},
    {kOthers, kReady, set_of(E::sync), begins, "系統參數相關: 0xF024"},
};
// clang-format on

}  // namespace transitions

/// Returns true if a mode has this phase.
constexpr bool is_phase_of(Activity activity, Phase phase) {
  using enum Phase;
  switch (activity) {
    case Activity::position: return phase != turning;
    case Activity::homing: return has(set_of(moving, slowing, leaving), phase);
    case Activity::velocity: return true;
    case Activity::pwm: return has(set_of(standing, moving, at_limit, in_alarm, servo_off), phase);
    case Activity::sync: return has(set_of(standing, moving, slowing, leaving, at_limit, in_alarm), phase);
  }
  return false;
}

/// Returns true if an event can occur in a phase.
constexpr bool can_come(Phase phase, Event event) {
  using namespace transitions;
  if (phase == servo_off) return has(kCommands, event);
  switch (event) {
    case Event::limit_ahead: return true;  // at standstill, any limit
    case Event::limit_behind: return has(kFree, phase);
    case Event::limit_gone: return has(kOnLimit | set_of(in_alarm), phase);
    case Event::alarm: return phase != in_alarm;
    case Event::alarm_gone: return phase == in_alarm;
    case Event::stop:
    case Event::servo_off:
    case Event::move_towards:
    case Event::move_away:
    case Event::move_nowhere:
    case Event::home:
    case Event::velocity_towards:
    case Event::velocity_away:
    case Event::velocity_zero:
    case Event::pwm:
    case Event::pwm_zero:
    case Event::sync: return true;
  }
  return true;
}

inline constexpr std::uint8_t kNoRow = 255;

/// The row for each cell; kNoRow if there is none, 254 if there are several.
inline constexpr auto kReactionOfCell = [] {
  std::array<std::array<std::array<std::uint8_t, kEvents>, kPhases>, kActivities> cells{};
  for (auto& phases : cells) {
    for (auto& events : phases) events.fill(kNoRow);
  }
  for (std::size_t i = 0; i < std::size(transitions::kRows); ++i) {
    for (std::size_t d = 0; d < kActivities; ++d) {
      for (std::size_t p = 0; p < kPhases; ++p) {
        for (std::size_t e = 0; e < kEvents; ++e) {
          const Transition& row = transitions::kRows[i];
          if (!has(row.activities, d) || !has(row.phases, p) || !has(row.events, e)) continue;
          std::uint8_t& cell = cells[d][p][e];
          cell = cell == kNoRow ? static_cast<std::uint8_t>(i) : std::uint8_t{254};
        }
      }
    }
  }
  return cells;
}();

static_assert(
    [] {
      for (int d = 0; d < kActivities; ++d) {
        for (int p = 0; p < kPhases; ++p) {
          for (int e = 0; e < kEvents; ++e) {
            const bool there = is_phase_of(Activity(d), Phase(p)) && can_come(Phase(p), Event(e));
            if (there && kReactionOfCell[d][p][e] >= 254) return false;
          }
        }
      }
      return true;
    }(),
    "each cell has exactly one row");

constexpr const Transition* reaction_row(Activity activity, Phase phase, Event event) {
  const std::uint8_t row = kReactionOfCell[static_cast<std::size_t>(activity)]
                                          [static_cast<std::size_t>(phase)][static_cast<std::size_t>(event)];
  return row == kNoRow ? nullptr : &transitions::kRows[row];
}

}  // namespace understudy::emulator::models::simple2_r3
