// Models the machine on a controller's axis: its travel, its switches, its encoder, and the drive that turns
// its motor. Positions are motor pulses on the machine's own scale. The initial position is part of the
// setup.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/simulated_time.h"

namespace understudy::emulator::world {

/// Positions from first to last; both are included.
struct PulseSpan {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

/// A servo drive between the controller and the motor. Without a drive, every pulse is a step.
struct DriveSetup {
  /// The number of ticks between enabling and Ready. Earlier pulses are lost.
  Tick ready_after = 0;
  /// The level of the controller's servo output that enables the drive.
  bool enabled_by = true;
  /// True if the alarm contact opens in an alarm; false if it closes.
  bool alarm_opens = false;
};

/// The contacts of an axis, by their names in a bench.
enum class Contact : std::uint8_t {
  home,
  lower_limit,
  upper_limit,
  alarm,
  ready,
  near_home,
  mark,
  index,  // the encoder's index
};
inline constexpr std::array<std::string_view, 8> kContactNames{
    "home", "lower_limit", "upper_limit", "alarm", "ready", "near_home", "mark", "index"};

/// A switch that the machine passes.
struct SwitchSetup {
  PulseSpan on;
  std::int64_t hysteresis_pulses = 0;  // it releases only this far outside its range
  bool opens = false;                  // true: the contact opens when the switch is on
  int input = -1;                      // the connected input; -1: according to the model
};

/// The encoder's index: on for `width` motor pulses from each `at + k * period`.
struct IndexSetup {
  std::int64_t at = 0;
  std::int64_t width = 1;
  std::int64_t period = 0;
  int input = -1;
};

struct PlantSetup {
  /// The machine's position at the start of the run.
  std::int64_t position_pulses = 0;
  /// Hard stops. The machine cannot pass them; pulses beyond them are lost steps.
  std::optional<PulseSpan> travel;
  /// The positions at which the home switch is on.
  std::optional<PulseSpan> home;
  std::optional<SwitchSetup> near_home;
  std::optional<SwitchSetup> mark;
  /// Limit switches are on at their position and beyond.
  std::optional<std::int64_t> lower_limit;
  std::optional<std::int64_t> upper_limit;
  /// A switch that is on releases only this far outside the range in which it goes on.
  std::int64_t home_hysteresis_pulses = 0;
  std::int64_t limit_hysteresis_pulses = 0;
  /// True if the contact is open when the switch is on, and closed otherwise.
  bool home_opens = false;
  bool limits_open = false;
  /// The controller's inputs to which the switches are connected, by terminal number; -1: according to the
  /// model.
  int home_input = -1;
  int lower_limit_input = -1;
  int upper_limit_input = -1;
  int encoder_counts_per_revolution = 0;  // 0: no encoder
  int pulses_per_revolution = 1;
  bool encoder_reversed = false;
  std::optional<IndexSetup> index;
  /// The encoder is on a separate wheel, which only turn() rotates.
  bool has_wheel = false;
  std::optional<DriveSetup> drive;
};

/// The active faults of a machine.
struct MachineFaults {
  bool stalled = false;             // every pulse is lost, because the motor is blocked
  std::int64_t loses_one_in = 0;    // one pulse in this many is lost; 0: none
  std::int64_t slipped_pulses = 0;  // how far it has been pushed since the last tick
  bool alarm = false;  // the drive's alarm has a cause; the alarm itself remains until it is cleared
  std::int64_t encoder_noise_counts = 0;  // by how much the encoder count is too high
  bool operator==(const MachineFaults&) const = default;
};

/// The inputs of a drive, by their names in a bench.
enum class DriveInput : std::uint8_t { servo, alarm_clear };
inline constexpr std::array<std::string_view, 2> kDriveInputNames{"servo", "alarm_clear"};

/// The levels that the controller or wires set at the inputs of a drive.
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

  /// Moves by this many steps, as far as the stops allow. The other steps are lost.
  void move(std::int64_t steps);
  /// Runs one tick with the controller's pulses and with its outputs at the end of the tick, which only a
  /// drive uses. Wires can also be connected to the drive.
  void step(Tick tick, std::int64_t pulses, DriveInputs inputs);
  /// Runs a tick in which only the position and the encoder change, as in almost all ticks. This accesses one
  /// cache line. For any other tick, returns false and does nothing.
  bool step_quietly(std::int64_t pulses) {
    const std::int64_t place = state_.position_pulses + pulses;
    if (place < quiet_from_ || place > quiet_to_) return false;
    state_.position_pulses = place;
    return true;
  }
  /// Returns the range of positions in which the machine can move without any other change, as long as the
  /// controller's outputs do not change. The range is empty if each pulse must be checked.
  PulseSpan places_alike() const;
  /// Moves by this many pulses at once, within places_alike(). The result is the same as after as many quiet
  /// ticks.
  void fast_forward(std::int64_t pulses) { state_.position_pulses += pulses; }
  /// From now on, a switch that the machine passes within a tick counts as having been on. (Otherwise, only
  /// the positions at the ends of ticks count, as for a controller that samples levels.)
  void check_between_ticks() { checks_between_ = true; }
  /// From now on, disabling the drive clears its alarm, because nothing is connected to its alarm-clear
  /// input.
  void clear_alarm_by_disabling() { clears_by_disabling_ = true; }
  /// Sets the level of a drive input that wires drive. Returns true if the level has changed.
  bool set_wired(DriveInput which, bool is_on);
  /// Returns the levels from the controller in the last tick in which the drive ran.
  DriveInputs seen_inputs() const { return state_.seen; }
  /// Returns true if each pulse is a step.
  bool steps_all() const {
    return !state_.faults.stalled && state_.faults.loses_one_in == 0 && !in_alarm() &&
           (!setup_.drive || state_.ready);
  }
  /// Returns the positions at which a switch is on, given its current state. Returns nothing if the switch is
  /// never on or does not move with the machine. The index is not such a switch, because it repeats.
  std::optional<SwitchSetup> switch_of(Contact which) const;
  /// Turns the encoder's wheel evenly over this many ticks, beginning with the next one. The rest of an
  /// earlier turn is added.
  void turn(std::int64_t counts, Tick ticks);
  MachineFaults& faults() {
    disturb();
    return state_.faults;
  }
  void set_faults(const MachineFaults& faults) { this->faults() = faults; }
  const MachineFaults& faults() const { return state_.faults; }

  std::int64_t position_pulses() const { return state_.position_pulses; }
  /// Returns the number of the controller's pulses, in both directions, that did not move the machine.
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
  /// Returns true if a contact is closed. A contact that the machine does not have is open, except that an
  /// injected alarm closes the alarm contact.
  bool contact(Contact which) const;
  bool has_contact(Contact which) const;
  bool has_encoder() const { return encoder_.counts_per_revolution != 0; }
  /// Returns the counts relative to the initial position. They are rounded towards minus infinity, so that a
  /// slow turn through 0 counts evenly. A reversed encoder counts the same edges in the other direction. The
  /// count wraps at 62 bits, so that the difference of two counts does not overflow.
  std::int64_t encoder_counts() const;
  /// Like encoder_counts(), but valid only after a quiet step.
  std::int64_t quiet_encoder_counts() const { return encoder_.counts_at(state_.position_pulses); }
  /// Returns the counts after this many more pulses.
  std::int64_t encoder_counts_after(std::int64_t pulses) const {
    return encoder_.counts_at(state_.position_pulses + pulses);
  }

  /// Returns the first tick after `done` in which something changes without further input, or kNever.
  Tick next_active_tick(Tick done) const;

  const PlantSetup& setup() const { return setup_; }
  bool same_state(const PlantAxis& other) const { return state_ == other.state_; }

  // --- its state, which is everything except the setup ------------------------------------------
  struct State {
    std::int64_t position_pulses = 0;
    std::int64_t lost_pulses = 0;     // in both directions
    std::int64_t pulses_to_lose = 0;  // pulses since the last lost pulse
    std::int64_t loses_one_in = 0;    // the `one_in` of the fault when they were counted
    bool at_home = false;
    bool at_lower_limit = false;
    bool at_upper_limit = false;
    bool at_near_home = false;
    bool at_mark = false;
    bool alarm_latched = false;
    bool ready = false;
    DriveInputs wired;
    DriveInputs seen;  // the levels from the controller in the last tick
    Tick enabled_at = kNever;
    MachineFaults faults;
    std::int64_t wheel_counts = 0;
    // The turn of the wheel: its counts, its length in ticks, and the remaining ticks.
    std::int64_t turn_counts = 0;
    Tick turn_ticks = 0;
    Tick ticks_to_turn = 0;
    bool operator==(const State&) const = default;
  };
  const State& save() const { return state_; }
  /// Throws StateError if no machine can be in that state.
  static void check(const State& state);
  /// Checks the state, then puts it into effect. If it throws, nothing has changed.
  void restore(const State& state);

 private:
  /// The part of the setup that determines the encoder count.
  struct Encoder {
    std::int64_t pulses_at_0 = 0;
    int counts_per_revolution = 0;
    int pulses_per_revolution = 1;
    bool reversed = false;

    /// Returns the count modulo 2^64.
    std::uint64_t wide_counts_at(std::int64_t position_pulses) const;
    std::int64_t counts_at(std::int64_t position_pulses) const {
      return in_62_bits(wide_counts_at(position_pulses));
    }
    static std::int64_t in_62_bits(std::uint64_t counts) {
      return static_cast<std::int64_t>(counts << 2) >> 2;  // the low 62 bits, with their sign
    }
  };

  /// Ensures that the next tick checks everything.
  void disturb() {
    quiet_from_ = 1;
    quiet_to_ = 0;
  }
  /// Computes how far the machine can move before everything must be checked.
  void find_quiet_places();
  /// Returns how far the machine has actually moved.
  std::int64_t shift(std::int64_t steps);
  void step_drive(Tick tick, DriveInputs inputs);
  std::int64_t pulses_that_step(std::int64_t pulses);
  void turn_wheel();
  /// Updates the switches after a move that began at `from`.
  void move_switches(std::int64_t from);
  // Return the ranges in which the switches are on, given their current state: a switch that is on stays on
  // within its hysteresis.
  PulseSpan home_span() const;
  std::int64_t lower_limit_end() const;
  std::int64_t upper_limit_end() const;
  SwitchSetup home_switch() const {
    return {*setup_.home, setup_.home_hysteresis_pulses, setup_.home_opens, setup_.home_input};
  }

  // The members that a quiet tick needs are on the first cache line, up to `position_pulses`. The quiet range
  // is not part of the state, because it follows from the state.
  std::int64_t quiet_from_ = 1;
  std::int64_t quiet_to_ = 0;
  Encoder encoder_;
  State state_;
  PlantSetup setup_;
  // Settings that depend on the controller and on the bench's wires.
  bool checks_between_ = false;
  bool clears_by_disabling_ = false;
};

}  // namespace understudy::emulator::world
