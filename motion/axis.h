// One axis of a controller, as a value: a pulse generator with its limits, signals, backlash and events.
//
//   commands ──> drive (profile on the clock) ──> travel ──> counters, comparators   <── environment
//                   ^ reactions to limits, alarm, emergency, homing <──────────────────────┘
//
// Travel is the sum of the pulses that the user's coordinate counts, in 64 bits, from power-up. Soft limits,
// comparators and switches all refer to travel, so a window of two numbers determines how far the axis can
// move before anything can happen. A tick inside the window is a cubic and two comparisons.
//
// Edges are handled at their pulse, within the tick, as a chip handles them: motion/axis_tick.h. If axes act
// on each other, motion/shared_tick.h brings them to the same moment.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "motion/counter.h"
#include "motion/environment.h"
#include "motion/following.h"
#include "motion/homing.h"
#include "motion/move.h"
#include "motion/pulse_drive.h"

namespace understudy::motion {

/// How an axis reacts to a signal, limit or comparator.
enum class Reaction : std::uint8_t { ignore, stop_at_once, slow_down };

/// Why a motion ended, or why it is refused.
enum class Cause : std::uint8_t {
  none,
  arrived,
  stopped,  // by command
  limit_plus,
  limit_minus,
  soft_limit_plus,
  soft_limit_minus,
  comparator,
  alarm,
  emergency,
  servo_off,
  homing_failed,
};

/// What happened in a tick, or between it and the one before; one bit each. The first eight are the MCX314's
/// factors of synchronous action, in its order, with comparators 0 to 3 as P>=C+, P<C+, P<C- and P>=C-. The
/// last three are raised only if AxisSettings::raises asks for them.
enum class Event : std::uint8_t {
  comparator_0,
  comparator_1,
  comparator_2,
  comparator_3,
  started,
  ended,
  mark_on,
  mark_off,
  homed,
  pulse,             // one or more pulses came out in the tick
  constant_started,  // C-STA: the first pulse at constant speed, and again after each change of speed
  constant_ended,    // C-END: the first pulse that is no longer at constant speed, or the last pulse
};
inline constexpr std::size_t kEvents = 12;
using Events = std::uint16_t;
constexpr Events bit(Event event) { return static_cast<Events>(1U << static_cast<unsigned>(event)); }

/// When in its tick an event happens. Events between two ticks belong to the beginning of the next one.
enum class Moment : std::uint8_t {
  its_own,  // at the pulse, end or signal that raises it: Axis::event_at
  end,      // at the tick's end, for a motion that begins between two ticks; also for PULSE
};
/// The moment of each event. Within a tick, edges are handled in the order of their moments; at the same
/// moment, axis by axis, with all events of an axis together.
inline constexpr std::array<Moment, kEvents> kMoments{
    Moment::its_own,  // comparators
    Moment::its_own, Moment::its_own, Moment::its_own,
    Moment::end,                       // started
    Moment::its_own,                   // ended
    Moment::its_own, Moment::its_own,  // marks
    Moment::its_own,                   // homed
    Moment::end,                       // pulse
    Moment::its_own, Moment::its_own,  // constant speed
};
/// Returns the mask of the events with this moment.
constexpr Events events_of(Moment moment) {
  Events mask = 0;
  for (std::size_t i = 0; i < kEvents; ++i) {
    if (kMoments[i] == moment) mask = static_cast<Events>(mask | 1U << i);
  }
  return mask;
}

enum class Count : std::uint8_t { command, encoder };

/// A position comparator. It raises an event each time the relation becomes true, by motion or because a
/// number was written. It compares the count itself, so the relation also changes where the count wraps.
struct Comparator {
  /// The last two become true only when the count reaches the value by rising, or by falling.
  enum class Relation : std::uint8_t { off, at_least, below, equal, equal_upwards, equal_downwards };

  Relation relation = Relation::off;
  Count count = Count::command;
  Reaction reaction = Reaction::ignore;  // of this axis only; other axes react through motion/synchronous.h
  bool was_true = false;
  Counter counter{};  // the counter in whose numbers `value` is given
  std::int64_t value = 0;

  bool operator==(const Comparator&) const = default;

  /// Returns the only direction of the count in which the relation can become true; 0 if it can in both, and
  /// when a number is written.
  int sense() const {
    return relation == Relation::equal_upwards ? +1 : relation == Relation::equal_downwards ? -1 : 0;
  }
  bool asks_for_one_place() const { return relation == Relation::equal || sense() != 0; }

  bool holds(std::int64_t travel) const;
  /// Returns how many pulses (1 or more) in `direction` it takes until the relation may change, or nothing if
  /// it will not.
  std::optional<std::int64_t> steps_until_change(std::int64_t travel, int direction) const;
};

struct AxisSettings {
  Reaction at_limit_plus = Reaction::stop_at_once;
  Reaction at_limit_minus = Reaction::stop_at_once;
  Reaction at_soft_limit = Reaction::stop_at_once;
  std::optional<Reaction> at_soft_limit_minus = std::nullopt;  // nothing: the same as at_soft_limit
  Reaction at_alarm = Reaction::stop_at_once;
  Reaction at_emergency = Reaction::stop_at_once;
  Reaction at_mark_on = Reaction::ignore;  // the mark's edges; the cause is `stopped`
  Reaction at_mark_off = Reaction::ignore;
  bool needs_servo = true;             // true: commands are refused and motion ends while the servo is off
  bool waits_for_in_position = false;  // a motion lasts until the in-position signal is on
  bool waits_beside_limits = false;    // true: a limit does not end a motion that only waits for in-position
  // The last allowed position, in travel or in encoder counts; the pulse beyond it triggers. Nothing: no soft
  // limit.
  std::optional<std::int64_t> soft_limit_plus = std::nullopt;
  std::optional<std::int64_t> soft_limit_minus = std::nullopt;
  Count soft_limits_of = Count::command;
  Events raises = 0;  // which of pulse, constant_started and constant_ended to raise; each costs time
  // Extra pulses at the beginning of each reversal; they are output but do not count as travel.
  std::int64_t backlash_pulses = 0;
  double backlash_speed_pps = 0;  // > 0 if there is backlash
  // True: the extra pulses make up for slip and come at every start of the drive, in either direction.
  bool slips = false;

  Reaction at_soft_limit_of_minus() const { return at_soft_limit_minus.value_or(at_soft_limit); }

  bool operator==(const AxisSettings&) const = default;
};

/// Throws BadMotion for settings that no axis can have. Settings from outside are also checked with it.
void check(const AxisSettings& settings);

/// What an axis was commanded to do.
enum class Task : std::uint8_t {
  none,
  move,
  endless,
  hanging,
  following,
  coordinated,  // carried along a path with others (motion/coordinated.h)
};

struct alignas(64) Axis {
  // The members that every tick needs come first; with the beginning of `drive` they fill two cache lines.
  std::int64_t travel_pulses = 0;
  std::int64_t watch_low = 0;  // while travel stays within these, nothing can happen because of the position
  std::int64_t watch_high = 0;
  std::int64_t base_pulses = 0;  // travel where the drive's coordinate is 0
  std::uint32_t seen_version = 0;
  Events events = 0;          // events of the last tick
  bool must_recheck = true;   // true: check everything in the next tick
  bool inverted = false;      // true: pulses come out in the opposite direction
  Signals signals = 0;        // signals as last seen
  Events events_between = 0;  // events since the last tick
  // The commanded motion. While backlash is taken up, the drive runs the backlash and this motion waits.
  Task task = Task::none;
  Cause cause = Cause::none;       // why the last motion ended, or why it is being stopped now
  std::int8_t last_direction = 0;  // direction of the last motion; 0 before the first
  bool servo_on = false;
  PulseDrive drive;

  AxisSettings settings;
  std::array<Comparator, 4> comparators{};
  std::int64_t encoder_pulses = 0;          // set by set_encoder(), or computed within the tick (EncoderLine)
  std::int64_t encoder_seen = 0;            // the count up to which comparators have been checked
  std::int64_t backlash_sent = 0;           // all extra pulses so far, signed by direction
  std::int64_t backlash_taken_pulses = 0;   // 0 .. backlash_pulses: taken up towards plus
  std::array<Instant, kEvents> event_at{};  // when each event with a moment of its own last happened
  double constant_pps = 0;  // constant speed at the last pulse; 0: it was not at constant speed

  // State of the commanded motion.
  bool in_backlash = false;
  bool slowing = false;            // slowing down to a stop, for `cause`
  bool comes_back = false;         // after stopping, returns to the target that it has passed
  bool settling = false;           // all pulses are sent; the axis waits for in-position
  bool encoder_is_known = false;   // the environment determines what the encoder counts along the travel
  std::int64_t target_pulses = 0;  // whole distance of a move, in the drive's coordinate
  SpeedLaw law;
  Follower follower;
  Homing homing;

  bool operator==(const Axis&) const = default;

  // ---- Commands. Call them between ticks; `now` is the last tick that was stepped. A motion from rest
  // begins in the next tick; a change acts from now on. All return Cause::none if accepted, otherwise the
  // reason for the refusal; a refused command changes nothing. All throw BadMotion as motion/move.h does,
  // also without changing anything.

  /// Moves by `distance_pulses`, signed, from the present position; a running motion is dropped. A distance
  /// of 0 ends a running motion at once.
  Cause move(std::int64_t distance_pulses, const SpeedLaw& speed, Tick now);
  /// Like move(), but from a signed speed that the axis already has from another generator. It continues to
  /// the target; if that is too near or behind, it stops and comes back.
  Cause move_on(double speed_pps, std::int64_t distance_pulses, const SpeedLaw& speed, Tick now);
  /// Runs without end in `direction` (+1 or -1).
  Cause run(int direction, const SpeedLaw& speed, Tick now);
  /// Begins a move at speed 0: the axis counts as moving, but sends no pulse (Simple2-R3).
  Cause move_at_zero_speed(int direction);
  /// Follows the counts from feed() until stopped (motion/following.h).
  Cause follow(const Follower& by);
  void feed(std::int64_t counts);
  /// Joins a coordinated motion: carry() moves the axis, until arrive(), stop() or a reaction ends it.
  Cause take_part();
  void arrive(Instant at);

  /// Changes the speed law from now on, for a move or an endless run. Does nothing if neither runs or the
  /// axis is stopping.
  void change_speed(const SpeedLaw& speed, Tick now);
  /// Changes the distance of the running move, counted from where it began, in its direction. A target that
  /// is already passed or too near is overshot and returned to. With `stop_if_passed` (MCX314) the move ends
  /// at once if the target is passed.
  void change_distance(std::int64_t distance_pulses, bool stop_if_passed, Tick now);
  /// Slows down to a stop. An axis that follows or is carried stops at once, since another source sets its
  /// speed (motion/coordinated.h slows a path down).
  void slow_down(Tick now, Cause why = Cause::stopped);
  /// The next three act within a tick, at the moment to which the axis has been brought
  /// (motion/shared_tick.h).
  void slow_down(Instant at, Cause why = Cause::stopped) { slow(at, why); }
  void stop(Cause why, Instant at) {
    if (task != Task::none) end(why, at);
  }
  void change_speed(const SpeedLaw& speed, Instant at);
  /// Cancels a commanded slow_down() while the axis still moves, and continues to the target or to the top
  /// speed of `speed`. Returns false if there is none to cancel. Homing ends when it is slowed down.
  bool resume(const SpeedLaw& speed, Tick now);
  /// Stops at once: no pulse comes out from now on.
  void stop(Cause why = Cause::stopped);
  void switch_servo(bool on);
  /// Homes by a table of phases (motion/homing.h). Homing lasts until Event::homed, or until Event::ended
  /// with Cause::homing_failed or stopped; homing.ended_by and ended_in say why and in which phase. Commands
  /// for another kind of motion end it; changes of speed and distance do not affect it.
  Cause home(const HomingProgram& program, Tick now);

  void set_comparator(std::size_t number, const Comparator& comparator);
  void set_encoder(std::int64_t pulses);
  void set(const AxisSettings& changed);

  // ---- State

  bool moving() const { return task != Task::none || homing.active(); }
  /// Returns why a motion in `direction` would be refused now, or none if it may begin.
  Cause forbidden(int direction) const { return forbidden(direction, 0); }
  /// Like forbidden(), but only for what forbids both directions (servo, emergency, alarm).
  Cause forbidden_anywhere() const;
  /// Returns the count that the soft limits refer to.
  std::int64_t soft_limit_place() const {
    return settings.soft_limits_of == Count::command ? travel_pulses : encoder_pulses;
  }
  /// Returns position in the drive's coordinate, speed and acceleration along the motion, after tick `now`.
  Sample sample(Tick now) const { return drive.sample({.tick = now}); }
  /// Returns the pulses of the running move that are still to come.
  std::int64_t remaining_pulses() const {
    if (task != Task::move || settling) return 0;
    return in_backlash ? target_pulses : target_pulses - drive.sent_pulses;
  }
  /// Like remaining_pulses(), signed as they come out; 0 if the move will not reach its target.
  std::int64_t pulses_to_come() const {
    if (slowing && !comes_back) return 0;
    return remaining_pulses() * drive.direction * (inverted ? -1 : +1);
  }

  // ---- The tick

  /// Runs one tick, the next after the last one. Returns the pulses that come out, signed as they come out.
  std::int64_t step(Tick tick, const Environment& environment) {
    QuietTick quiet;
    return step_quietly(tick, environment, quiet) ? quiet.pulses
                                                  : step_slow_path(tick, environment, quiet.followed);
  }

  /// The result of a tick in which nothing can happen, and the state before it. Such a tick can be taken back
  /// and stepped again the slow way.
  struct QuietTick {
    std::int64_t pulses = 0;  // the pulses, signed as they come out
    std::int64_t travel = 0;  // the travel before the tick
    std::int64_t sent = 0;
    // pulses that a follower asked for, even in a tick that is not quiet
    std::optional<std::int64_t> followed{};
  };
  /// Runs a quiet tick, or returns false if something may happen in it.
  bool step_quietly(Tick tick, const Environment& environment, QuietTick& quiet) {
    quiet.travel = travel_pulses;
    quiet.sent = drive.sent_pulses;
    if (tick < drive.next_check && environment.version == seen_version && !must_recheck) [[likely]] {
      const std::int64_t sent = drive.pulses_of_segment(tick);
      const std::int64_t travel = base_pulses + drive.direction * sent;
      if (travel >= watch_low && travel <= watch_high) [[likely]] {
        const std::int64_t pulses = travel - travel_pulses;
        travel_pulses = travel;
        drive.sent_pulses = sent;
        events = 0;
        quiet.pulses = inverted ? -pulses : pulses;
        return true;
      }
    }
    return task == Task::following && follow_quietly(environment, quiet);
  }
  void undo(const QuietTick& quiet) {
    travel_pulses = quiet.travel;
    drive.sent_pulses = quiet.sent;
    if (quiet.followed) base_pulses = travel_pulses;
  }

  /// Runs one tick of an axis in a coordinated motion, instead of step(): the axis moves by `pulses`, evenly
  /// over the tick. Pulses left over after a reaction are not sent.
  std::int64_t carry(std::int64_t pulses, Tick tick, const Environment& environment) {
    const std::int64_t travel = travel_pulses + pulses;
    if (carries_quietly(environment) && travel >= watch_low && travel <= watch_high) [[likely]] {
      return carry_across(pulses);
    }
    return step_slow_path(tick, environment, pulses);
  }

  // ---- Many ticks in one step: motion/axis_fast_forward.cpp

  struct TravelRange {
    std::int64_t low = INT64_MIN;  // both ends included
    std::int64_t high = INT64_MAX;
  };
  /// Returns the last tick up to which the axis continues along its plan within `range` and nothing happens
  /// to it. `next` is the next tick, `limit` the latest to consider. Returns next - 1 if there is none.
  Tick quiet_until(Tick next, Tick limit, const Environment& environment, TravelRange range) const;
  /// Returns the travel after `tick`, which is at most quiet_until().
  std::int64_t travel_ahead(Tick tick) const {
    return base_pulses + drive.direction * drive.pulses_of_segment(tick);
  }
  /// Runs all ticks up to `tick`, at most quiet_until(), at once. The state and the sum of the pulses are the
  /// same as with single ticks.
  std::int64_t fast_forward_to(Tick tick);
  /// Returns true if carry() only counts while travel stays within watch_low and watch_high.
  bool carries_quietly(const Environment& environment) const {
    return task == Task::coordinated && is_undisturbed(environment);
  }
  /// Adds the pulses of several carry() ticks at once. Call it only while carries_quietly(), with pulses of
  /// one sign.
  std::int64_t carry_across(std::int64_t pulses) {
    if (pulses != 0) {
      drive.direction = pulses < 0 ? -1 : +1;
      last_direction = static_cast<std::int8_t>(drive.direction);
    }
    travel_pulses = base_pulses = travel_pulses + pulses;
    events = 0;
    return inverted ? -pulses : pulses;
  }

 private:
  friend class AxisTick;

  Cause forbidden(int direction, Signals ignored) const;
  std::int64_t step_slow_path(Tick tick, const Environment& environment,
                              std::optional<std::int64_t> pulses = {});
  bool follow_quietly(const Environment& environment, QuietTick& quiet);
  /// Returns true if nothing has changed since the last tick except the carried pulses, and all pulses sent
  /// are travel.
  bool is_undisturbed(const Environment& environment) const {
    return environment.version == seen_version && !must_recheck && settings.backlash_pulses <= 0 &&
           backlash_taken_pulses == 0;
  }

  // Starting and ending, at moments within a tick.
  Cause begin(Task what, int direction, std::int64_t distance_pulses, const SpeedLaw& speed, Instant at,
              bool for_homing = false);
  void go_on_by(const SpeedLaw& speed, Instant at);
  std::int64_t backlash_before(int direction) const;
  void know_encoder(const Environment& environment);
  void follow_encoder_count(Instant at);
  bool counts_by_encoder() const;
  Profile planned(const SpeedLaw& speed) const;  // plans the task from its beginning
  void drop(Instant at = {});
  void slow(Instant at, Cause why);
  void react(Reaction reaction, Cause why, Instant at);
  void end(Cause why, Instant at);

  // Inside a tick.
  // `direction`: direction in which the axis came here; 0: it has not moved
  void update_signals(const Environment& environment, Instant at, int direction);
  void see(Signals now_on, Instant at);
  void compare(Count count, std::int64_t value, Instant at, int direction);
  void watch(const Environment& environment);
  void raise(Event event, Instant at);
  void check_speed(std::int64_t sent_before, Instant from, Instant until);
  bool waits_for_constant_speed() const;

  // Homing: motion/homing_run.cpp.
  // true if the phase handles this signal, so the axis does not react to it
  bool homing_takes(Signal signal) const;
  void homing_sees(Signals changed, Instant at);  // `signals` contains the new signals
  void homing_comes_to_its_place(Instant at);     // called at the place where a phase ends by its distance
  void homing_slows(Cause why);                   // slows down to a stop for `why`, unless it already does
  void homing_stands(Cause why, Instant at);      // called when the phase's motion has ended
  Cause enter_phase(std::int8_t number, Instant at, bool running);
  Cause begin_phase(Instant at);
  /// Returns the travel at which the running phase ends, or nothing if it does not end at a place.
  std::optional<std::int64_t> homing_place() const;
  void go_to_phase(std::int8_t number, Instant at, bool running);
  void mark_reference();
  void end_homing(Cause why, Instant at);
};

}  // namespace understudy::motion
