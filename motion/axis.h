// One axis of a controller, as a value: a pulse generator with its limits, signals, backlash and events.
//
//   commands ──> drive (profile on the clock) ──> travel ──> counters, comparators   <── environment
//                   ^ reactions to limits, alarm, emergency, homing <──────────────────────┘
//
// Travel is the 64-bit sum, since power-up, of the pulses that count in the user's coordinate. Soft limits,
// comparators and switches all refer to travel, so a window of two numbers determines how far the axis can
// move before anything can happen. A tick inside the window costs a cubic and two comparisons.
//
// Edges are handled at their pulse within the tick, as in a chip (motion/axis_tick.h). If axes act on each
// other, motion/shared_tick.h brings them to the same moment.
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

/// What happened in a tick, or between this tick and the previous one; one bit each. The first eight are the
/// MCX314's factors of synchronous action, in its order, with comparators 0 to 3 as P>=C+, P<C+, P<C- and
/// P>=C-. The last three are raised only if AxisSettings::raises includes them.
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
  pulse,             // one or more pulses were sent in the tick
  constant_started,  // C-STA: the first pulse at constant speed, and again after each change of speed
  constant_ended,    // C-END: the first pulse that is no longer at constant speed, or the last pulse
};
inline constexpr std::size_t kEvents = 12;
using Events = std::uint16_t;
constexpr Events bit(Event event) { return static_cast<Events>(1U << static_cast<unsigned>(event)); }

/// When an event happens in its tick. Events between two ticks belong to the beginning of the second tick.
enum class Moment : std::uint8_t {
  its_own,  // at the pulse, end or signal that raises it: Axis::event_at
  end,      // at the tick's end: for a motion that begins between two ticks, and for PULSE
};
/// The moment of each event. Within a tick, edges are handled in the order of their moments. At the same
/// moment, the axes are handled one by one, each with all its events.
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
/// Returns the mask of the events that have this moment.
constexpr Events events_of(Moment moment) {
  Events mask = 0;
  for (std::size_t i = 0; i < kEvents; ++i) {
    if (kMoments[i] == moment) mask = static_cast<Events>(mask | 1U << i);
  }
  return mask;
}

enum class Count : std::uint8_t { command, encoder };

/// A position comparator. It raises an event each time the relation becomes true, either by motion or because
/// a number was written. It compares the count itself, so the relation also changes where the count wraps
/// around.
struct Comparator {
  /// The last two become true only when the count reaches the value while it rises or falls, respectively.
  enum class Relation : std::uint8_t { off, at_least, below, equal, equal_upwards, equal_downwards };

  Relation relation = Relation::off;
  Count count = Count::command;
  Reaction reaction = Reaction::ignore;  // of this axis only; other axes react through motion/synchronous.h
  bool was_true = false;
  Counter counter{};  // the counter to which `value` refers
  std::int64_t value = 0;

  bool operator==(const Comparator&) const = default;

  /// Returns the only direction of the count in which the relation can become true. Returns 0 if it can
  /// become true in both directions and by a written number.
  int sense() const {
    return relation == Relation::equal_upwards ? +1 : relation == Relation::equal_downwards ? -1 : 0;
  }
  bool asks_for_one_place() const { return relation == Relation::equal || sense() != 0; }

  bool holds(std::int64_t travel) const;
  /// Returns how many pulses (1 or more) in `direction` are needed until the relation may change, or nothing
  /// if it will not change.
  std::optional<std::int64_t> steps_until_change(std::int64_t travel, int direction) const;
};

struct AxisSettings {
  Reaction at_limit_plus = Reaction::stop_at_once;
  Reaction at_limit_minus = Reaction::stop_at_once;
  Reaction at_soft_limit = Reaction::stop_at_once;
  std::optional<Reaction> at_soft_limit_minus = std::nullopt;  // nothing: as at_soft_limit
  Reaction at_alarm = Reaction::stop_at_once;
  Reaction at_emergency = Reaction::stop_at_once;
  Reaction at_mark_on = Reaction::ignore;  // the mark's edges; the cause is `stopped`
  Reaction at_mark_off = Reaction::ignore;
  bool needs_servo = true;             // true: commands are refused and motion ends while the servo is off
  bool waits_for_in_position = false;  // a motion lasts until the in-position signal is on
  bool waits_beside_limits = false;    // true: a limit does not end a wait for in-position
  // The last allowed position, in travel or in encoder counts. The next pulse triggers the limit. Nothing: no
  // soft limit.
  std::optional<std::int64_t> soft_limit_plus = std::nullopt;
  std::optional<std::int64_t> soft_limit_minus = std::nullopt;
  Count soft_limits_of = Count::command;
  Events raises = 0;  // which of pulse, constant_started and constant_ended to raise; each one costs time
  // Extra pulses at the beginning of each reversal. They are sent but do not count as travel.
  std::int64_t backlash_pulses = 0;
  double backlash_speed_pps = 0;  // must be > 0 if there is backlash
  // True: the extra pulses compensate for slip, and are sent at every start of the drive in either direction.
  bool slips = false;

  Reaction at_soft_limit_of_minus() const { return at_soft_limit_minus.value_or(at_soft_limit); }

  bool operator==(const AxisSettings&) const = default;
};

/// Throws BadMotion for settings that no axis can have. Also use it for settings from outside.
void check(const AxisSettings& settings);

/// The command that an axis is executing.
enum class Task : std::uint8_t {
  none,
  move,
  endless,
  hanging,
  following,
  coordinated,  // carried along a path with other axes (motion/coordinated.h)
};

struct alignas(64) Axis {
  // Every tick needs these members, so they come first; with the beginning of `drive` they fill two cache
  // lines.
  std::int64_t travel_pulses = 0;
  std::int64_t watch_low = 0;  // while travel stays within these, no event can happen because of the position
  std::int64_t watch_high = 0;
  std::int64_t base_pulses = 0;  // travel where the drive's coordinate is 0
  std::uint32_t seen_version = 0;
  Events events = 0;          // events of the last tick
  bool must_recheck = true;   // true: check everything in the next tick
  bool inverted = false;      // true: pulses come out in the opposite direction
  Signals signals = 0;        // the last known signals
  Events events_between = 0;  // events since the last tick
  // The commanded motion. While backlash is taken up, the drive executes the backlash and this motion is
  // waiting.
  Task task = Task::none;
  Cause cause = Cause::none;       // why the last motion ended, or why it is being stopped now
  std::int8_t last_direction = 0;  // direction of the last motion; 0 before the first
  bool servo_on = false;
  PulseDrive drive;

  AxisSettings settings;
  std::array<Comparator, 4> comparators{};
  std::int64_t encoder_pulses = 0;          // set by set_encoder(), or computed within the tick (EncoderLine)
  std::int64_t encoder_seen = 0;            // the count up to which comparators are checked
  std::int64_t backlash_sent = 0;           // all extra pulses so far, signed by direction
  std::int64_t backlash_taken_pulses = 0;   // 0 .. backlash_pulses: the part taken up towards plus
  std::array<Instant, kEvents> event_at{};  // when each event with Moment::its_own last happened
  double constant_pps = 0;  // the constant speed at the last pulse; 0: the speed was not constant

  // State of the commanded motion.
  bool in_backlash = false;
  bool slowing = false;            // slowing down to a stop because of `cause`
  bool comes_back = false;         // after stopping, the axis returns to the target that it has passed
  bool settling = false;           // all pulses are sent; the axis waits for in-position
  bool encoder_is_known = false;   // the environment determines the encoder count along the travel
  std::int64_t target_pulses = 0;  // the whole distance of a move, in the drive's coordinate
  SpeedLaw law;
  Follower follower;
  Homing homing;

  bool operator==(const Axis&) const = default;

  // ---- Commands. Call them between ticks; `now` is the last tick that was stepped. A motion from rest
  // begins in the next tick, and a change takes effect immediately. All commands return Cause::none if
  // accepted, otherwise the reason for the refusal. They throw BadMotion in the same cases as motion/move.h.
  // A command that is refused or throws changes nothing.

  /// Moves by `distance_pulses` (signed) from the present position. A running motion is dropped. A distance
  /// of 0 ends a running motion immediately.
  Cause move(std::int64_t distance_pulses, const SpeedLaw& speed, Tick now);
  /// Like move(), but begins with a signed speed that the axis already has from another generator. The axis
  /// continues to the target; if the target is too near or behind, the axis stops and returns to it.
  Cause move_on(double speed_pps, std::int64_t distance_pulses, const SpeedLaw& speed, Tick now);
  /// Runs without end in `direction` (+1 or -1).
  Cause run(int direction, const SpeedLaw& speed, Tick now);
  /// Begins a move at speed 0: the axis counts as moving, but sends no pulse (Simple2-R3).
  Cause move_at_zero_speed(int direction);
  /// Follows the counts passed to feed() until it is stopped (motion/following.h).
  Cause follow(const Follower& by);
  void feed(std::int64_t counts);
  /// Joins a coordinated motion: carry() moves the axis until arrive(), stop() or a reaction ends the motion.
  Cause take_part();
  void arrive(Instant at);

  /// Changes the speed law of a move or an endless run from now on. Does nothing if the axis does neither, or
  /// is stopping.
  void change_speed(const SpeedLaw& speed, Tick now);
  /// Changes the distance of the running move. The distance counts from where the move began, in its
  /// direction. If the target is already passed or too near, the axis overshoots and returns. With
  /// `stop_if_passed` (MCX314), the move ends at once if the target is passed.
  void change_distance(std::int64_t distance_pulses, bool stop_if_passed, Tick now);
  /// Slows down to a stop. An axis that follows or is carried stops at once, because its speed comes from
  /// another source (motion/coordinated.h slows down paths).
  void slow_down(Tick now, Cause why = Cause::stopped);
  /// The next three functions act within a tick, at the moment to which the axis has been brought
  /// (motion/shared_tick.h).
  void slow_down(Instant at, Cause why = Cause::stopped) { slow(at, why); }
  void stop(Cause why, Instant at) {
    if (task != Task::none) end(why, at);
  }
  void change_speed(const SpeedLaw& speed, Instant at);
  /// Cancels a commanded slow_down() while the axis is still moving, and continues to the target or to the
  /// top speed of `speed`. Returns false if there is nothing to cancel. Homing ends when it is slowed down,
  /// so it cannot be resumed.
  bool resume(const SpeedLaw& speed, Tick now);
  /// Stops at once: no further pulse is sent.
  void stop(Cause why = Cause::stopped);
  void switch_servo(bool on);
  /// Homes by a table of phases (motion/homing.h). Homing lasts until Event::homed, or until Event::ended
  /// with Cause::homing_failed or stopped. homing.ended_by and ended_in contain the reason and the phase.
  /// Commands for another kind of motion end homing; changes of speed and distance do not affect it.
  Cause home(const HomingProgram& program, Tick now);

  void set_comparator(std::size_t number, const Comparator& comparator);
  void set_encoder(std::int64_t pulses);
  void set(const AxisSettings& changed);

  // ---- State

  bool moving() const { return task != Task::none || homing.active(); }
  /// Returns why a motion in `direction` would be refused now, or none if it would be accepted.
  Cause forbidden(int direction) const { return forbidden(direction, 0); }
  /// Like forbidden(), but only for reasons that forbid both directions (servo, emergency, alarm).
  Cause forbidden_anywhere() const;
  /// Returns the count that the soft limits refer to.
  std::int64_t soft_limit_place() const {
    return settings.soft_limits_of == Count::command ? travel_pulses : encoder_pulses;
  }
  /// Returns the position in the drive's coordinate, and the speed and acceleration along the motion, after
  /// tick `now`.
  Sample sample(Tick now) const { return drive.sample({.tick = now}); }
  /// Returns how many pulses of the running move are still to be sent.
  std::int64_t remaining_pulses() const {
    if (task != Task::move || settling) return 0;
    return in_backlash ? target_pulses : target_pulses - drive.sent_pulses;
  }
  /// Like remaining_pulses(), but with the sign of the output; 0 if the move will not reach its target.
  std::int64_t pulses_to_come() const {
    if (slowing && !comes_back) return 0;
    return remaining_pulses() * drive.direction * (inverted ? -1 : +1);
  }

  // ---- The tick

  /// Runs the next tick. Returns the number of pulses sent, with the sign of the output.
  std::int64_t step(Tick tick, const Environment& environment) {
    QuietTick quiet;
    return step_quietly(tick, environment, quiet) ? quiet.pulses
                                                  : step_slow_path(tick, environment, quiet.followed);
  }

  /// The result of a tick in which nothing can happen, and the state before it. Such a tick can be undone and
  /// stepped again in the general way.
  struct QuietTick {
    std::int64_t pulses = 0;  // the pulses, with the sign of the output
    std::int64_t travel = 0;  // the travel before the tick
    std::int64_t sent = 0;
    // the pulses that the follower requested, even in a tick that is not quiet
    std::optional<std::int64_t> followed{};
  };
  /// Runs a quiet tick. Returns false if something may happen in the tick.
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

  /// Runs one tick of an axis in a coordinated motion, instead of step(). The axis moves by `pulses`, evenly
  /// over the tick. Pulses that remain after a reaction are not sent.
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
  /// Returns the last tick up to which the axis continues along its plan within `range` without any event.
  /// `next` is the next tick, `limit` the last tick to consider. Returns next - 1 if there is no such tick.
  Tick quiet_until(Tick next, Tick limit, const Environment& environment, TravelRange range) const;
  /// Returns the travel after `tick`, which must not be later than quiet_until().
  std::int64_t travel_ahead(Tick tick) const {
    return base_pulses + drive.direction * drive.pulses_of_segment(tick);
  }
  /// Runs all ticks up to `tick` in one step; `tick` must not be later than quiet_until(). The state and the
  /// sum of the pulses are the same as with single ticks.
  std::int64_t fast_forward_to(Tick tick);
  /// Returns true if carry() does nothing but count while travel stays within watch_low and watch_high.
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
  /// Returns true if nothing but the carried pulses has changed since the last tick, and all pulses sent
  /// count as travel.
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
  Profile planned(const SpeedLaw& speed) const;  // plans the whole task
  void drop(Instant at = {});
  void slow(Instant at, Cause why);
  void react(Reaction reaction, Cause why, Instant at);
  void end(Cause why, Instant at);

  // These run within a tick. `direction` is the direction in which the axis arrived; 0: it has not moved.
  void update_signals(const Environment& environment, Instant at, int direction);
  void see(Signals now_on, Instant at);
  void compare(Count count, std::int64_t value, Instant at, int direction);
  void watch(const Environment& environment);
  void raise(Event event, Instant at);
  void check_speed(std::int64_t sent_before, Instant from, Instant until);
  bool waits_for_constant_speed() const;

  // Homing: motion/homing_run.cpp. homing_takes() returns true if the phase handles this signal, so the axis
  // does not react to it.
  bool homing_takes(Signal signal) const;
  void homing_sees(Signals changed, Instant at);  // `signals` contains the new signals
  void homing_comes_to_its_place(Instant at);     // called where a phase ends by its distance
  void homing_slows(Cause why);                   // slows down to a stop for `why`, unless it already does
  void homing_stands(Cause why, Instant at);      // called when the phase's motion has ended
  Cause enter_phase(std::int8_t number, Instant at, bool running);
  Cause begin_phase(Instant at);
  /// Returns the travel at which the current phase ends, or nothing if no position ends it.
  std::optional<std::int64_t> homing_place() const;
  void go_to_phase(std::int8_t number, Instant at, bool running);
  void mark_reference();
  void end_homing(Cause why, Instant at);
};

}  // namespace understudy::motion
