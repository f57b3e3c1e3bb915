// The axes of a SUPER-40NC as values, and everything that follows from them alone: counters, positions,
// speeds. Each part of the axes is such a view with its own functions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/axis/transition_tables.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/terminals.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::super_40nc {

class Chips : protected OnGround {
 public:
  Chips(Ground& ground, AxesState& axes)
      : OnGround(ground),
        axes_(axes),
        lines_wait_(chose(option("axis_conflicts", "programs_always_wait"))),
        has_chip_pins_(chose(option("pins_fitted", "also_clr_ltc_and_erc"))) {}

  AxisState& axis(int number) { return axes_.axes[static_cast<std::size_t>(number)]; }
  const AxisState& axis(int number) const { return axes_.axes[static_cast<std::size_t>(number)]; }
  motion::Axis& chip(int number) { return axes_.chips[static_cast<std::size_t>(number)]; }
  const motion::Axis& chip(int number) const { return axes_.chips[static_cast<std::size_t>(number)]; }
  motion::Environment& environment(int axis) { return axes_.environment[static_cast<std::size_t>(axis)]; }
  const motion::Environment& environment(int axis) const {
    return axes_.environment[static_cast<std::size_t>(axis)];
  }
  bool is_on_path(int axis) const { return axes_.path.takes(static_cast<std::size_t>(axis)); }
  bool has_chip_pins() const { return has_chip_pins_; }
  /// Returns the sampled level of CLR or LTC.
  bool pin_seen(int axis, ChipPin pin) const {
    return (pin == kClearPin ? axes_.clears_seen : axes_.latches_seen)[static_cast<std::size_t>(axis)];
  }
  /// Returns true if CLR is holding counters at 0 (D9x09).
  bool holds_cleared(int axis) const;
  /// Returns true if CLR is holding one of COUNTER1 to COUNTER4 (`which` 0 to 3) at 0.
  bool is_held_cleared(int axis, int which) const;
  bool has_signal(int number, motion::Signal signal) const {
    return (chip(number).signals & motion::bit(signal)) != 0;
  }

  // --- positions
  /// Returns COUNTER1.
  std::int64_t machine_pulses(int number) const {
    return axis(number).command.at(chip(number).travel_pulses);
  }
  std::int32_t counter(int axis_number, int number) const;
  /// Returns the position that D8x17 shows, in the work coordinate.
  std::int64_t work_lu(int axis_number) const;
  std::int64_t relative_base_lu(int axis_number) const;
  /// Returns the pulses to the target. They are not 0 if PSET, another D8x40 or CMX has moved a target that
  /// was already reached.
  std::int64_t distance_to(int axis_number, std::int64_t target_lu) const;
  std::int64_t remaining_pulses(int axis_number) const;
  std::int64_t braking_pulses(int axis) const;
  std::int64_t search_pulses(int axis) const;
  std::int64_t place_pulses(int axis) const;
  std::int64_t pulses_to_come(int axis_number) const;

  // --- speeds
  /// Returns the value of D8x64.
  std::int32_t operation_of(int axis_number) const;
  /// Returns the speed in the axis's own direction.
  double commanded_pps(int axis_number) const;
  /// Returns the speed in the motor's direction.
  double speed_pps(int axis_number) const;
  /// Returns the speed in the chip's speed steps (D8x70).
  std::int32_t chip_speed(int axis_number) const;

  // --- which motion controls an axis
  /// Looks up the table in ownership.h, with the selected options.
  Grant granted(Activity holder, Request request) const {
    note_request(holder, request);
    return grant(holder, request, lines_wait_);
  }
  /// Records a request that is executed without consulting the table.
  void note_request(Activity holder, Request request) const {
    ground_.decisions().meet(kOwnershipTable, static_cast<std::size_t>(holder),
                             static_cast<std::size_t>(request));
  }
  bool is_awaited_by(Mover mover) const;

 protected:
  /// Discards the end of a motion that happened between ticks, after it has been handled.
  void forget_end(int axis);

  AxesState& axes_;

 private:
  // Cached choices.
  bool lines_wait_;
  bool has_chip_pins_;
};

/// The modes of D9x09.
enum ClearMode : std::uint8_t { kAtOn, kAtOff, kWhileOn, kWhileOff };

/// The values of D8x64, as numbered by the chip.
enum Operation : std::int32_t {
  kStopped = 0,
  kBacklash = 7,
  kByWheel = 8,
  kAtFa = 9,
  kAtFl = 10,
  kSpeedingUp = 11,
  kAtFh = 12,
  kSlowingDown = 13,
  kAtInp = 14,  // all pulses are sent; the axis waits for INP
};

/// Wraps a sum to 32 bits, like the chip.
inline std::int32_t wrapped(std::int64_t number) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(number));
}
inline int direction_of(std::int64_t distance) { return distance < 0 ? -1 : +1; }
inline bool is_bit(std::int32_t mask, int bit) { return (mask >> bit & 1) != 0; }

}  // namespace understudy::emulator::models::super_40nc
