// One axis of a controller, as a value: a pulse generator with its limits, signals, backlash and events.
//
//   commands ──> drive (profile on the clock) ──> travel ──> counters, comparators   <── surroundings
//                   ^ reactions to limits, alarm, emergency, homing <──────────────────────┘
//
// Travel is the sum of the pulses that the user's coordinate counts, in 64 bits, from power-up. Everything
// that looks at positions (soft limits, comparators, switches) does so in travel, so one window of two
// numbers says how far the axis may go before anything can happen: the tick in between is a cubic and two
// comparisons.
//
// Edges are met at their pulse, within the tick, as a chip meets them: motion/axis_tick.h. Where axes act on
// each other, motion/shared_tick.h brings them there together.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "motion/counter.h"
#include "motion/following.h"
#include "motion/homing.h"
#include "motion/move.h"
#include "motion/pulse_drive.h"
#include "motion/surroundings.h"

namespace understudy::motion {

/// How an axis answers to something it meets.
enum class Reaction : std::uint8_t { ignore, stop_at_once, slow_down };

/// What a motion ended by, or what it is refused for.
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
/// last three are raised only where AxisSettings::raises asks for them.
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
  pulse,             // one or more came out in the tick
  constant_started,  // C-STA: the first pulse at constant speed, and again after each change of speed
  constant_ended,    // C-END: the first pulse that no longer is at it, or the last one
};
inline constexpr std::size_t kEvents = 12;
using Events = std::uint16_t;
constexpr Events bit(Event event) { return static_cast<Events>(1U << static_cast<unsigned>(event)); }

/// When in its tick an event is. What has come about between two ticks is at the beginning of the next one.
enum class Moment : std::uint8_t {
  its_own,  // of the pulse, the end or the signal that it is raised by: Axis::event_at
  end,      // a motion that begins between two ticks is at its beginning at the end of the next; PULSE, too
};
/// The order of edges in a tick: by their moments; those of one moment by axis, and of one axis together.
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
/// Those of a moment, as a mask.
constexpr Events events_of(Moment moment) {
  Events mask = 0;
  for (std::size_t i = 0; i < kEvents; ++i) {
    if (kMoments[i] == moment) mask = static_cast<Events>(mask | 1U << i);
  }
  return mask;
}

enum class Count : std::uint8_t { command, encoder };

/// A position compare: an event each time the relation becomes true, by motion or because a number was
/// written. The relation is that of the count itself, so where the count wraps it changes, too.
struct Comparator {
  /// The last two become true only where the count comes to the value by rising, or by falling.
  enum class Relation : std::uint8_t { off, at_least, below, equal, equal_upwards, equal_downwards };

  Relation relation = Relation::off;
  Count count = Count::command;
  Reaction reaction = Reaction::ignore;  // of the axis itself; others' through motion/synchronous.h
  bool was_true = false;
  Counter counter{};  // which numbers `value` is meant in
  std::int64_t value = 0;

  bool operator==(const Comparator&) const = default;

  /// The only way of the count that it becomes true by; 0: any, and a number that is written as well.
  int way() const {
    return relation == Relation::equal_upwards ? +1 : relation == Relation::equal_downwards ? -1 : 0;
  }
  bool asks_for_one_place() const { return relation == Relation::equal || way() != 0; }

  bool holds(std::int64_t travel) const;
  /// Pulses (1 ...) in `direction` until it may change; nothing if it will not.
  std::optional<std::int64_t> steps_until_change(std::int64_t travel, int direction) const;
};

struct AxisSettings {
  Reaction at_limit_plus = Reaction::stop_at_once;
  Reaction at_limit_minus = Reaction::stop_at_once;
  Reaction at_soft_limit = Reaction::stop_at_once;
  std::optional<Reaction> at_soft_limit_minus = std::nullopt;  // nothing: the same
  Reaction at_alarm = Reaction::stop_at_once;
  Reaction at_emergency = Reaction::stop_at_once;
  Reaction at_mark_on = Reaction::ignore;  // the edges of the mark; the cause is `stopped`
  Reaction at_mark_off = Reaction::ignore;
  bool needs_servo = true;             // commands are refused and motion ends while the servo is off
  bool waits_for_in_position = false;  // a motion lasts until the in-position signal is on
  bool waits_beside_limits = false;    // a limit does not end it while that is all that it waits for
  // The last place allowed, of the travel or as the encoder counts; the pulse beyond it triggers. Nothing: no
  // soft limit.
  std::optional<std::int64_t> soft_limit_plus = std::nullopt;
  std::optional<std::int64_t> soft_limit_minus = std::nullopt;
  Count soft_limits_of = Count::command;
  Events raises = 0;  // of pulse, constant_started and constant_ended; while asked for they cost time
  // Extra pulses at the beginning of each reversal; they are output, but are not travel.
  std::int64_t backlash_pulses = 0;
  double backlash_speed_pps = 0;  // > 0 where there is backlash
  // They make up for slip: they come at every start of the drive, whatever its way.
  bool slips = false;

  Reaction at_soft_limit_of_minus() const { return at_soft_limit_minus.value_or(at_soft_limit); }

  bool operator==(const AxisSettings&) const = default;
};

/// Throws BadMotion for settings that no axis can have. Settings from outside are judged by it as well.
void check(const AxisSettings& settings);

/// What an axis was asked to do.
enum class Task : std::uint8_t {
  none,
  move,
  endless,
  hanging,
  following,
  coordinated,  // carried along a path with others (motion/coordinated.h)
};

struct alignas(64) Axis {
  // What every tick needs, first: with the beginning of the drive it is two cache lines.
  std::int64_t travel_pulses = 0;
  std::int64_t watch_low = 0;  // while travel stays within these, nothing can happen because of the position
  std::int64_t watch_high = 0;
  std::int64_t base_pulses = 0;  // travel where the drive's coordinate is 0
  std::uint32_t seen_version = 0;
  Events events = 0;          // of the last tick
  bool attentive = true;      // look at everything in the next tick
  bool inverted = false;      // pulses come out in the other sense
  Signals signals = 0;        // as last seen
  Events events_between = 0;  // since the last tick
  // The motion that was asked for. While backlash is taken up the drive runs that, and this waits.
  Task task = Task::none;
  Cause cause = Cause::none;       // of the last end, or of the stop under way
  std::int8_t last_direction = 0;  // of the last motion; 0 before the first
  bool servo_on = false;
  PulseDrive drive;

  AxisSettings settings;
  std::array<Comparator, 4> comparators{};
  std::int64_t encoder_pulses = 0;  // as told by set_encoder(), or known within the tick (EncoderLine)
  std::int64_t encoder_seen = 0;    // up to where comparators have looked
  std::int64_t backlash_sent = 0;   // all extra pulses so far, signed by direction
  std::int64_t play_pulses = 0;     // 0 .. backlash_pulses: how much of the backlash is taken up towards plus
  std::array<Instant, kEvents> event_at{};  // of those with a moment of their own, the last one
  double constant_pps = 0;                  // the constant speed of the last pulse; 0: it was not at one

  // Of the motion that was asked for.
  bool in_backlash = false;
  bool slowing = false;            // to a stop, for `cause`
  bool comes_back = false;         // and then back to the target, which was passed
  bool settling = false;           // all pulses sent, waiting for in-position
  bool encoder_is_known = false;   // the surroundings say what the encoder counts on the way
  std::int64_t target_pulses = 0;  // of a move: its whole distance, in the drive's coordinate
  SpeedLaw law;
  Follower follower;
  Homing homing;

  bool operator==(const Axis&) const = default;

  // ---- Commands, between ticks; `now` is the last tick that was stepped. A motion from rest is at its
  // beginning in the next tick; a change acts from now. All return Cause::none when taken, else why they are
  // refused; a refused one changes nothing. All throw BadMotion as motion/move.h says, and then nothing has
  // changed.

  /// A move by `distance_pulses`, signed, from where the axis is; a running motion is dropped. 0 ends it and
  /// is over at once.
  Cause move(std::int64_t distance_pulses, const SpeedLaw& speed, Tick now);
  /// Like the above, from a signed speed that the axis already has from another generator: on to the target,
  /// or, if that is too near or behind, to a stop and back to it.
  Cause move_on(double speed_pps, std::int64_t distance_pulses, const SpeedLaw& speed, Tick now);
  /// Without end in `way` (+1 or -1).
  Cause run(int way, const SpeedLaw& speed, Tick now);
  /// A move at speed 0: moving, but no pulse (Simple2-R3).
  Cause hang(int way);
  /// Follows what feed() brings, until stopped (motion/following.h).
  Cause follow(const Follower& by);
  void feed(std::int64_t counts);
  /// Takes part in a coordinated motion: carry() moves it, until arrive(), stop() or a reaction ends it.
  Cause take_part();
  void arrive(Instant at);

  /// Another law of speed from now on, for a move or an endless run; nothing when none runs or it is
  /// stopping.
  void change_speed(const SpeedLaw& speed, Tick now);
  /// Another distance for the running move, counted from where it began, in its direction. A target that is
  /// already passed, or too near, is overshot and returned to; with `stop_if_passed` (MCX314) the move ends
  /// at once if it is passed.
  void change_distance(std::int64_t distance_pulses, bool stop_if_passed, Tick now);
  /// An axis that follows or is carried stops at once, since its speed is not its own (motion/coordinated.h
  /// slows a path down).
  void slow_down(Tick now, Cause why = Cause::stopped);
  /// These three within a tick, at the moment to which it has been brought (motion/shared_tick.h).
  void slow_down(Instant at, Cause why = Cause::stopped) { slow(at, why); }
  void stop(Cause why, Instant at) {
    if (task != Task::none) end(why, at);
  }
  void change_speed(const SpeedLaw& speed, Instant at);
  /// Cancels a commanded slow_down() while the axis still moves: on to the target or the top speed of
  /// `speed`. Returns false if there is none to cancel; homing ends when it is slowed down.
  bool resume(const SpeedLaw& speed, Tick now);
  /// No pulse from now on.
  void stop(Cause why = Cause::stopped);
  void switch_servo(bool on);
  /// Homing by a table of phases (motion/homing.h). It lasts until Event::homed, or until Event::ended with
  /// Cause::homing_failed or stopped: homing.ended_by and ended_in say why and where. Commands for a motion
  /// of another kind end it; changes of speed and distance leave it as it is.
  Cause home(const HomingProgram& program, Tick now);

  void set_comparator(std::size_t number, const Comparator& comparator);
  void set_encoder(std::int64_t pulses);
  void set(const AxisSettings& changed);

  // ---- State

  bool moving() const { return task != Task::none || homing.active(); }
  /// Why a motion in `way` would be refused now; none if it may begin.
  Cause forbidden(int way) const { return forbidden(way, 0); }
  /// Likewise, for what forbids both ways (servo, emergency, alarm).
  Cause forbidden_anywhere() const;
  /// Of the count that the soft limits are meant in.
  std::int64_t soft_limit_place() const {
    return settings.soft_limits_of == Count::command ? travel_pulses : encoder_pulses;
  }
  /// Position in the drive's coordinate, speed and acceleration along the motion, after tick `now`.
  Sample sample(Tick now) const { return drive.sample({.tick = now}); }
  /// Pulses of the running move that are still to come.
  std::int64_t remaining_pulses() const {
    if (task != Task::move || settling) return 0;
    return in_backlash ? target_pulses : target_pulses - drive.sent_pulses;
  }
  /// The same, signed as they come out; 0 where it will not get there.
  std::int64_t pulses_to_come() const {
    if (slowing && !comes_back) return 0;
    return remaining_pulses() * drive.direction * (inverted ? -1 : +1);
  }

  // ---- The tick

  /// One tick, the next after the last one. Returns the pulses that come out, signed as they come out.
  std::int64_t step(Tick tick, const Surroundings& here) {
    QuietTick quiet;
    return step_quietly(tick, here, quiet) ? quiet.pulses : step_with_care(tick, here, quiet.followed);
  }

  /// What a tick in which nothing can happen has done, and from where: it can be taken back, to be stepped
  /// with care.
  struct QuietTick {
    std::int64_t pulses = 0;  // signed as they come out
    std::int64_t travel = 0;  // before it
    std::int64_t sent = 0;
    std::optional<std::int64_t> followed{};  // what a follower asked for, also of a tick that is not quiet
  };
  /// Does such a tick, or returns false.
  bool step_quietly(Tick tick, const Surroundings& here, QuietTick& quiet) {
    quiet.travel = travel_pulses;
    quiet.sent = drive.sent_pulses;
    if (tick < drive.next_look && here.version == seen_version && !attentive) [[likely]] {
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
    return task == Task::following && follow_quietly(here, quiet);
  }
  void take_back(const QuietTick& quiet) {
    travel_pulses = quiet.travel;
    drive.sent_pulses = quiet.sent;
    if (quiet.followed) base_pulses = travel_pulses;
  }

  /// One tick of an axis that takes part: instead of step(), goes by `pulses`, evenly over the tick. Pulses
  /// left over after a reaction are not sent.
  std::int64_t carry(std::int64_t pulses, Tick tick, const Surroundings& here) {
    const std::int64_t travel = travel_pulses + pulses;
    if (carries_quietly(here) && travel >= watch_low && travel <= watch_high) [[likely]] {
      return carry_across(pulses);
    }
    return step_with_care(tick, here, pulses);
  }

  // ---- Many ticks in one step: motion/axis_crossing.cpp

  struct TravelRange {
    std::int64_t low = INT64_MIN;  // both included
    std::int64_t high = INT64_MAX;
  };
  /// The last of the ticks from `next` on, which is the next one, and up to `most`, that may be crossed: the
  /// axis goes on along its plan through all of them, within `range`, and meets nothing. next - 1: none.
  Tick quiet_until(Tick next, Tick most, const Surroundings& here, TravelRange range) const;
  /// Travel after one of those.
  std::int64_t travel_ahead(Tick tick) const {
    return base_pulses + drive.direction * drive.pulses_of_segment(tick);
  }
  /// All ticks up to `tick`, one of those, at once: the state, and the sum of what comes out, are the same.
  std::int64_t cross_to(Tick tick);
  /// Whether carry() does nothing but count while travel stays within watch_low and watch_high.
  bool carries_quietly(const Surroundings& here) const {
    return task == Task::coordinated && is_undisturbed(here);
  }
  /// So many pulses of carry(), of one sign, in ticks of which that is true.
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

  Cause forbidden(int way, Signals ignored) const;
  std::int64_t step_with_care(Tick tick, const Surroundings& here, std::optional<std::int64_t> pulses = {});
  bool follow_quietly(const Surroundings& here, QuietTick& quiet);
  /// Nothing has changed since the last tick but what it is carried by, and all that it sends is travel.
  bool is_undisturbed(const Surroundings& here) const {
    return here.version == seen_version && !attentive && settings.backlash_pulses <= 0 && play_pulses == 0;
  }

  // Starting and ending, at moments within a tick.
  Cause begin(Task what, int way, std::int64_t distance_pulses, const SpeedLaw& speed, Instant at,
              bool for_homing = false);
  void go_on_by(const SpeedLaw& speed, Instant at);
  std::int64_t play_before(int way) const;
  void know_encoder(const Surroundings& here);
  void follow_encoder_count(Instant at);
  bool counts_by_encoder() const;
  Profile planned(const SpeedLaw& speed) const;  // of the task from its beginning
  void drop(Instant at = {});
  void slow(Instant at, Cause why);
  void react(Reaction reaction, Cause why, Instant at);
  void end(Cause why, Instant at);

  // Inside a tick.
  void meet(const Surroundings& here, Instant at, int way);  // by which it has come; 0: it has not moved
  void see(Signals now_on, Instant at);
  void compare(Count count, std::int64_t value, Instant at, int way);
  void watch(const Surroundings& here);
  void raise(Event event, Instant at);
  void look_at_speed(std::int64_t sent_before, Instant from, Instant until);
  bool waits_for_constant_speed() const;

  // Homing: motion/homing_run.cpp.
  bool homing_takes(Signal signal) const;         // the phase deals with it: the axis does not react
  void homing_sees(Signals changed, Instant at);  // `signals` are the new ones
  void homing_comes_to_its_place(Instant at);     // where a phase ends by its distance
  void homing_slows(Cause why);                   // ... down to a stop for `why`, or does so already
  void homing_stands(Cause why, Instant at);      // the phase's motion has ended
  Cause enter_phase(std::int8_t number, Instant at, bool running);
  Cause begin_phase(Instant at);
  /// The travel at which the phase that runs in motion ends; nothing where none does.
  std::optional<std::int64_t> homing_place() const;
  void go_to_phase(std::int8_t number, Instant at, bool running);
  void mark_reference();
  void end_homing(Cause why, Instant at);
};

}  // namespace understudy::motion
