// Events on the axes of a SUPER-40NC within a tick, at the exact pulse (motion/shared_tick.h): latches at the
// DOG and at the chip's comparators; comparators of numbers other than the travel or an encoder (COUNTER3,
// the hand wheel's counts, the remaining distance, the speed); and the pins LTC and CLR, if a switch of the
// machine is connected to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_inputs.h"
#include "emulator/models/super_40nc/axis/chip_pins.h"
#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/counters.h"
#include "emulator/models/super_40nc/rows/terminals.h"
#include "motion/axis.h"
#include "motion/axis_tick.h"
#include "motion/pulse_drive.h"
#include "motion/shared_tick.h"

namespace understudy::emulator::models::super_40nc {

class TickEdges final : protected Chips, public motion::EdgeOwner {
 public:
  TickEdges(const Chips& chips, AxisInputs& inputs, Counters& counters, ChipPins& pins)
      : Chips(chips), inputs_(inputs), counters_(counters), pins_(pins) {}

  void begin_tick(Tick tick, bool wheel_turns);
  /// Returns a mask of the axes that have comparators or pins which the axes themselves do not evaluate.
  std::uint32_t watched() const { return watched_; }

  void at_edge(motion::SharedTick& tick, std::size_t axis, motion::Events events) override;
  std::optional<motion::Instant> next_moment(motion::SharedTick& tick, const motion::Instant& until) override;
  void at_moment(motion::SharedTick& tick) override;

 private:
  /// An axis at a moment of the tick, in seconds.
  struct Sample {
    double at_s = 0;
    motion::AxisPlace place{};
    Counted since{};  // since the counters were last updated
    std::int64_t number = 0;
  };
  /// What a comparator waits for in this tick.
  struct Question {
    int axis = 0;
    std::size_t which = 0;
    Value source = 0;
    Value method = 0;
    std::int64_t set = 0;
  };

  /// The result of the last next_moment(): a comparator or a pin.
  struct Found {
    int axis = 0;
    std::optional<std::size_t> comparator{};
    ChipPin pin = kClearPin;
  };

  motion::Instant instant(double at_s) const;
  double seconds(const motion::Instant& at) const;
  void latch(const motion::SharedTick& tick, int axis);

  Question question(int axis, std::size_t which) const;
  bool is_answered(const Question& of, std::int64_t before, std::int64_t present) const;
  bool may_be_answered(const Question& of, const Sample& from, const Sample& to) const;
  std::int64_t number(const Question& of, const Sample& sample) const;
  std::int64_t speed(int axis, double at_s) const;
  Sample sample(motion::SharedTick& tick, const Question& of, double at_s) const;
  std::optional<double> first_answer(motion::SharedTick& tick, const Question& of, const Sample& from,
                                     const Sample& to) const;
  std::optional<double> first_speed(motion::SharedTick& tick, const Question& of, const Sample& from,
                                    const Sample& to) const;
  std::optional<double> next_comparison(motion::SharedTick& tick, const Question& of, double from_s,
                                        double to_s) const;
  std::optional<double> next_flip(motion::SharedTick& tick, int axis, ChipPin pin, double from_s,
                                  double to_s) const;
  void compare(motion::SharedTick& tick, const Question& of);
  void stop(motion::SharedTick& tick, int axis, bool by_ramp, motion::Cause why);

  AxisInputs& inputs_;
  Counters& counters_;
  ChipPins& pins_;
  // Working data of a tick, not part of the state.
  Tick tick_ = 0;
  std::uint32_t watched_ = 0;
  Found found_{};
};

}  // namespace understudy::emulator::models::super_40nc
