// The machine around a controller's axis: how far it travels, where its switches are, what its encoder
// counts, and the drive that turns its motor. Positions are pulses of the motor, on the machine's own scale:
// where it stands at first is part of its setup.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/simulated_time.h"

namespace understudy::emulator::world {

/// Positions first to last, both included.
struct PulseSpan {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

/// A servo drive between the controller and the motor. Without one every pulse is a step.
struct DriveSetup {
  /// From being enabled to Ready; pulses before that are lost.
  Tick ready_after = 0;
  /// The level of the controller's servo output that enables it.
  bool enabled_by = true;
  /// Whether the alarm contact opens with an alarm (and is closed without one), or closes with it.
  bool alarm_opens = false;
};

/// The contacts around an axis, by the names that a bench calls them.
enum class Contact : std::uint8_t {
  home,
  lower_limit,
  upper_limit,
  alarm,
  ready,
  near_home,
  mark,
  index,  // the encoder's
};
inline constexpr std::array<std::string_view, 8> kContactNames{
    "home", "lower_limit", "upper_limit", "alarm", "ready", "near_home", "mark", "index"};

/// A switch that the machine passes.
struct SwitchSetup {
  PulseSpan on;
  std::int64_t hysteresis_pulses = 0;  // it lets go only this far outside
  bool opens = false;                  // where it is on, and is closed elsewhere
  int input = -1;                      // to which it is wired; -1: the model's own
};

/// The encoder's index: on for `width` pulses of the motor from every `at + k * period`.
struct IndexSetup {
  std::int64_t at = 0;
  std::int64_t width = 1;
  std::int64_t period = 0;
  int input = -1;
};

struct PlantSetup {
  /// Where the machine stands at first.
  std::int64_t position_pulses = 0;
  /// Hard stops: the machine does not pass them, pulses beyond are lost steps.
  std::optional<PulseSpan> travel;
  /// Where the home switch is on.
  std::optional<PulseSpan> home;
  std::optional<SwitchSetup> near_home;
  std::optional<SwitchSetup> mark;
  /// The limit switches: on at the position and beyond.
  std::optional<std::int64_t> lower_limit;
  std::optional<std::int64_t> upper_limit;
  /// A switch that is on lets go only this far outside the place where it came on.
  std::int64_t home_hysteresis_pulses = 0;
  std::int64_t limit_hysteresis_pulses = 0;
  /// Whether the switch opens where it is on (and is closed elsewhere).
  bool home_opens = false;
  bool limits_open = false;
  /// The controller's inputs that the switches are wired to, by their terminals; -1: the model's own.
  int home_input = -1;
  int lower_limit_input = -1;
  int upper_limit_input = -1;
  int encoder_counts_per_revolution = 0;  // 0: no encoder
  int pulses_per_revolution = 1;
  bool encoder_reversed = false;
  std::optional<IndexSetup> index;
  /// The encoder is on a separate wheel, which turn() turns and no motor does.
  bool has_wheel = false;
  std::optional<DriveSetup> drive;
};

/// What is wrong with a machine.
struct MachineFaults {
  bool stalled = false;             // the motor is blocked: every pulse is lost
  std::int64_t loses_one_in = 0;    // one pulse in this many is lost; 0: none
  std::int64_t slipped_pulses = 0;  // how far it has been pushed by force since the last tick
  bool alarm = false;               // the cause of the drive's alarm, which outlasts it until it is cleared
  std::int64_t encoder_noise_counts = 0;  // this many too many
  bool operator==(const MachineFaults&) const = default;
};

/// The inputs of a drive, by the names that a bench calls them.
enum class DriveInput : std::uint8_t { servo, alarm_clear };
inline constexpr std::array<std::string_view, 2> kDriveInputNames{"servo", "alarm_clear"};

/// What they are given by the controller, or by wires.
struct DriveInputs {
  bool servo = false;
  bool alarm_clear = false;

  bool& operator[](DriveInput which) { return which == DriveInput::servo ? servo : alarm_clear; }
  bool operator==(const DriveInputs&) const = default;
};

class alignas(64) PlantAxis {
 public:
  explicit PlantAxis(PlantSetup setup = {})
      : encoder_{.pulses_at_0 = setup.position_pulses,
                 .counts_per_revolution = setup.encoder_counts_per_revolution,
                 .pulses_per_revolution = setup.pulses_per_revolution,
                 .reversed = setup.encoder_reversed},
        setup_(setup) {
    state_.position_pulses = setup_.position_pulses;
    move_switches(setup_.position_pulses);
  }

  /// Moves this many steps, as far as the stops let it; the rest is lost.
  void move(std::int64_t steps);
  /// One tick: the pulses of the controller, and its outputs at its end, which only a drive heeds. Wires lead
  /// to a drive as well.
  void step(Tick tick, std::int64_t pulses, DriveInputs inputs);
  /// Does a tick in which nothing changes but the place, and the encoder with it, as in almost every tick: it
  /// costs one cache line. Returns false for any other tick, and does nothing.
  bool step_quietly(std::int64_t pulses) {
    const std::int64_t place = state_.position_pulses + pulses;
    if (place < quiet_from_ || place > quiet_to_) return false;
    state_.position_pulses = place;
    return true;
  }
  /// Where a place of the machine leaves everything else as it is, for as long as its controller's outputs
  /// do; empty where each pulse must be looked at.
  PulseSpan places_alike() const;
  /// This many pulses at once, within that: what as many quiet ticks do.
  void cross(std::int64_t pulses) { state_.position_pulses += pulses; }
  /// From now on a switch that it has passed within a tick has been on. (Else only the places at the ends of
  /// ticks count, as for a controller that looks at levels.)
  void look_between_ticks() { looks_between_ = true; }
  /// From now on its drive's alarm is cleared by disabling it: nothing leads to its alarm-clear input.
  void clear_alarm_by_disabling() { clears_by_disabling_ = true; }
  /// What wires give an input of its drive. Returns whether that is another level.
  bool set_wired(DriveInput which, bool is_on);
  /// What its controller had given its drive in the last tick that it looked.
  DriveInputs seen_inputs() const { return state_.seen; }
  /// Whether each pulse is a step.
  bool steps_all() const {
    return !state_.faults.stalled && state_.faults.loses_one_in == 0 && !in_alarm() &&
           (!setup_.drive || state_.ready);
  }
  /// Where a switch is on, for as long as nothing about the machine changes; nothing where it never is or
  /// does not move with the machine. The index is not one: it is on again and again.
  std::optional<SwitchSetup> way_of(Contact which) const;
  /// Turns the encoder's wheel, evenly over this many ticks from the next one on; what is left of an earlier
  /// turn is added.
  void turn(std::int64_t counts, Tick ticks);
  MachineFaults& faults() {
    disturb();
    return state_.faults;
  }
  void set_faults(const MachineFaults& faults) { this->faults() = faults; }
  const MachineFaults& faults() const { return state_.faults; }

  std::int64_t position_pulses() const { return state_.position_pulses; }
  /// Pulses of the controller that moved nothing, in either direction.
  std::int64_t lost_pulses() const { return state_.lost_pulses; }
  bool at_home() const { return state_.at_home; }
  bool at_lower_limit() const { return state_.at_lower_limit; }
  bool at_upper_limit() const { return state_.at_upper_limit; }
  bool at_near_home() const { return state_.at_near_home; }
  bool at_mark() const { return state_.at_mark; }
  bool at_index() const;
  bool has_drive() const { return setup_.drive.has_value(); }
  bool in_alarm() const { return state_.alarm_latched || state_.faults.alarm; }
  bool ready() const { return state_.ready; }
  /// Whether a contact is closed. One that the machine does not have is open.
  bool contact(Contact which) const;
  bool has_contact(Contact which) const;
  bool has_encoder() const { return encoder_.counts_per_revolution != 0; }
  /// From where the machine stood at first. Rounded towards minus infinity, so that a slow turn through 0
  /// counts evenly; a reversed encoder counts the same edges the other way. Wraps at 62 bits, so that the
  /// difference of two fits.
  std::int64_t encoder_counts() const;
  /// Like the above, after a quiet step.
  std::int64_t quiet_encoder_counts() const { return encoder_.counts_at(state_.position_pulses); }
  /// The same after this many more pulses.
  std::int64_t encoder_counts_after(std::int64_t pulses) const {
    return encoder_.counts_at(state_.position_pulses + pulses);
  }

  /// The first tick after `done` at which something changes by itself; kNever if nothing does.
  Tick next_active_tick(Tick done) const;

  const PlantSetup& setup() const { return setup_; }
  bool same_state(const PlantAxis& other) const { return state_ == other.state_; }

  // --- its state: all of it but the setup ------------------------------------------------------
  struct State {
    std::int64_t position_pulses = 0;
    std::int64_t lost_pulses = 0;     // magnitude
    std::int64_t pulses_to_lose = 0;  // made since one was lost
    std::int64_t loses_one_in = 0;    // what they were counted for
    bool at_home = false;
    bool at_lower_limit = false;
    bool at_upper_limit = false;
    bool at_near_home = false;
    bool at_mark = false;
    bool alarm_latched = false;
    bool ready = false;
    DriveInputs wired;
    DriveInputs seen;  // of its controller
    Tick enabled_at = kNever;
    MachineFaults faults;
    std::int64_t wheel_counts = 0;
    // The wheel's turn: counts, the ticks that they take, and how many of those are left.
    std::int64_t turn_counts = 0;
    Tick turn_ticks = 0;
    Tick ticks_to_turn = 0;
    bool operator==(const State&) const = default;
  };
  const State& save() const { return state_; }
  /// Throws StateError if no machine can be in that state.
  static void check(const State& state);
  /// Like check(); if it throws, nothing has changed.
  void restore(const State& state);

 private:
  /// The part of the setup that an encoder's count is made from.
  struct Encoder {
    std::int64_t pulses_at_0 = 0;
    int counts_per_revolution = 0;
    int pulses_per_revolution = 1;
    bool reversed = false;

    /// Modulo 2^64.
    std::uint64_t wide_counts_at(std::int64_t position_pulses) const;
    std::int64_t counts_at(std::int64_t position_pulses) const {
      return in_62_bits(wide_counts_at(position_pulses));
    }
    static std::int64_t in_62_bits(std::uint64_t counts) {
      return static_cast<std::int64_t>(counts << 2) >> 2;  // the low ones, with their sign
    }
  };

  /// The next tick has to look at everything.
  void disturb() {
    quiet_from_ = 1;
    quiet_to_ = 0;
  }
  /// Finds out how far it may go before it has to.
  void find_quiet_places();
  /// Returns how far it really moved.
  std::int64_t shift(std::int64_t steps);
  void step_drive(Tick tick, DriveInputs inputs);
  std::int64_t pulses_that_step(std::int64_t pulses);
  void turn_wheel();
  /// As they stand after a way from there.
  void move_switches(std::int64_t from);
  // Where the switches are on, as they stand now: one that is on lets go later than it came on.
  PulseSpan home_span() const;
  std::int64_t lower_limit_end() const;
  std::int64_t upper_limit_end() const;
  SwitchSetup home_switch() const {
    return {*setup_.home, setup_.home_hysteresis_pulses, setup_.home_opens, setup_.home_input};
  }

  // What a quiet tick needs is on the first cache line, `position_pulses` included. The quiet places are no
  // state: they follow from it.
  std::int64_t quiet_from_ = 1;
  std::int64_t quiet_to_ = 0;
  Encoder encoder_;
  State state_;
  PlantSetup setup_;
  // Of its controller, and of the bench's wires.
  bool looks_between_ = false;
  bool clears_by_disabling_ = false;
};

}  // namespace understudy::emulator::world
