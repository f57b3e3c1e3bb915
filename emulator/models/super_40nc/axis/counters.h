// How the counters of the axes count, and what latches them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis/axis_parameters.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/comparators.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "motion/axis_tick.h"

namespace understudy::emulator::models::super_40nc {

/// The axes before the tick.
struct BeforeTick {
  std::array<std::int64_t, kAxisCount> travel{};
  std::array<std::int8_t, kAxisCount> phase{};  // the phase of a homing
};

/// The input that the counters can count.
struct Counted {
  std::int64_t pulses = 0;
  std::int64_t backlash = 0;
  std::int64_t wheel = 0;
  std::int64_t encoder = 0;
  std::int64_t clock = 0;
};

/// Returns how much of the input COUNTER2 to COUNTER4 (`counter` 1 to 3) count, according to D9x19, D9x23 to
/// D9x25 and D9x29.
std::int64_t counts_of(const Settings& settings, int axis, int counter, const Counted& counted);

class Counters : protected Chips {
 public:
  Counters(const Chips& chips, Comparators& comparators, AxisParameters& parameters)
      : Chips(chips),
        comparators_(comparators),
        parameters_(parameters),
        has_clock_(chose(option("counter4_clock", "9_8304_mhz"))) {}

  BeforeTick begin_tick(Tick tick, std::int32_t wheel_counts);
  /// Counts the rest of a tick of an axis, except the encoder, which set_encoder() counts.
  void end_tick(int axis_number, const BeforeTick& before);
  /// Returns the input between the last count and a moment of the tick, at which the axis is at `place`.
  Counted counted_until(int axis_number, double at_s, const motion::AxisPlace& place) const;
  /// Counts until this moment of the tick.
  void count_until(int axis_number, double at_s);
  /// Counts the input of several ticks, or of part of a tick.
  void count(int axis_number, const Counted& counted);
  /// Sets the machine's encoder, which has moved by the pulses of this tick.
  void set_encoder(int axis_number, std::int64_t counts);
  /// Returns true if nothing about the axis changes until an event affects it.
  bool is_quiet(int axis_number) const;
  /// Returns true if every tick must be run, because a clock drives COUNTER4, or comparator 4 or 5 latches at
  /// the end of a tick.
  bool acts_each_tick(int axis) const;
  /// Clears counters at the end of homing, after its last tick has been counted.
  void clear_counters(int axis_number);
  void take_latch(int axis_number, std::int64_t travel, std::int64_t speed);
  /// Latches because of a comparator that has become true, unless it has already latched within the tick.
  void latch_by_comparator(int axis_number);
  /// Returns true if one of COUNTER2 to COUNTER4 is counting now. COUNTER4 may count only while the axis
  /// moves.
  bool counts_now(int axis_number, int which) const;
  /// Returns true if a clock drives COUNTER4 (D9x25 = 3).
  bool counts_a_clock(int axis) const;

 private:
  /// What has been counted of an axis so far in this tick.
  struct CountedSoFar {
    std::int64_t travel = 0;  // the travel up to which it has been counted
    std::int64_t wheel = 0;
    std::int64_t clock = 0;
  };

  void add_to_counters(int axis_number, const Counted& counted);
  void count_encoder(int axis_number, std::int64_t counts);
  void count_without_encoder(int axis_number, double at_s);
  void count_index(int axis_number, std::int8_t phase_before);

  Comparators& comparators_;
  AxisParameters& parameters_;
  bool has_clock_;  // cached choice: D9x25 = 3 counts a clock
  // Working data of a tick, not part of the state.
  Tick tick_ = 0;
  std::array<CountedSoFar, kAxisCount> so_far_{};
  std::int32_t wheel_of_tick_ = 0;
};

}  // namespace understudy::emulator::models::super_40nc
