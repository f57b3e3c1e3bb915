// How the counters of the axes count, and what latches them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis/axis_parameters.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/comparators.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "motion/axis.h"
#include "motion/shared_tick.h"

namespace understudy::emulator::models::super_40nc {

/// The axes before a tick.
struct BeforeTick {
  std::array<std::int64_t, kAxisCount> travel{};
  std::array<std::int8_t, kAxisCount> phase{};  // of a homing
};

class Counters final : protected Chips, public motion::EdgeOwner {
 public:
  Counters(const Chips& chips, Comparators& comparators, AxisParameters& parameters)
      : Chips(chips), comparators_(comparators), parameters_(parameters) {}

  BeforeTick begin_tick(std::int32_t wheel_counts);
  /// Counts the rest of a tick of an axis, and latches.
  void end_tick(int axis_number, const BeforeTick& before);
  /// Counts the pulses of one or several ticks, and those of the wheel; set_encoder() counts the encoder.
  void count(int axis_number, std::int64_t travel_before, std::int64_t wheel_counts, Tick clock_ticks = 1);
  /// Sets the machine's encoder, which has moved by the pulses of this tick.
  void set_encoder(int axis_number, std::int64_t counts);
  /// Returns true if nothing of the axis changes until something happens to it.
  bool is_quiet(int axis_number) const;
  /// Returns true if a clock drives COUNTER4, or COUNTER4 or the comparators 4 and 5 latch at the end of a
  /// tick: such ticks are run.
  bool acts_each_tick(int axis) const;
  /// Clears counters at the end of a home, after the counts of its last tick.
  void clear_counters(int axis_number);
  void take_latch(int axis_number, std::int64_t travel);

 private:
  /// What has been counted of an axis so far in the current tick.
  struct CountedSoFar {
    std::int64_t travel = 0;  // travel up to which it has been counted
    std::int64_t wheel = 0;   // wheel counts so far
  };

  void at_edge(motion::SharedTick& tick, std::size_t axis, motion::Events events) override;
  /// Returns true if a clock drives COUNTER4 (D9x25 = 3).
  bool counts_a_clock(int axis) const;
  void add_to_counter(const Settings& settings, int axis_number, int which, std::int64_t counts);
  bool counts_now(const Settings& settings, int axis_number) const;
  void count_encoder(int axis_number, std::int64_t counts);
  void count_until(const motion::SharedTick& tick, int axis_number);
  void count_index(int axis_number, std::int8_t phase_before);
  void latch_by_comparator(int axis_number);

  Comparators& comparators_;
  AxisParameters& parameters_;
  // Working values of a tick; none of them is state.
  std::array<CountedSoFar, kAxisCount> counted_{};
  std::int32_t wheel_of_tick_ = 0;
};

}  // namespace understudy::emulator::models::super_40nc
