// An axis of a SUPER-40NC as a value: the chip's motor and counters, the holder of the axis, and what the
// controller stores about its motions.
#pragma once

#include <array>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/counter.h"
#include "motion/environment.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

/// The setting with which the hand wheel moves an axis.
enum class WheelSource : std::uint8_t { none, mpg_line, contact_1, contact_10, contact_100, selector };

/// The kind of a program motion that a pause has interrupted and that will continue afterwards.
enum class RestKind : std::uint8_t { none, move, path, mark, turning, home };
struct Rest {
  RestKind kind = RestKind::none;
  std::int64_t travel = 0;    // the chip's travel at the target
  std::int64_t distance = 0;  // MRK: distance to the target; `search` is the distance after it
  std::int64_t search = 0;
  bool searches = false;
  bool marks_positive = false;
  std::int32_t rpm = 0;       // MRK, VDRV
  bool limits_count = false;  // MRK with X16 = 0: its signals act as limits, regardless of X33 and X34

  bool operator==(const Rest&) const = default;
};

inline constexpr std::size_t kCounters = 4;
inline constexpr std::size_t kComparators = 5;

struct AxisState {
  std::int64_t sent_pulses = 0;      // pulses of the last tick, in the motor's direction
  std::int64_t followed_pulses = 0;  // travel during the last tick
  // COUNTER1 follows the travel; the others count the input that D9x23 to D9x25 select.
  motion::Counter command{.range = motion::Counter::Range::bits28};
  std::array<std::int32_t, kCounters - 1> counts{};
  std::array<std::int32_t, kCounters> latched{};
  std::int32_t index_count = 0;  // C signals (EZ) of the last homing
  bool latch_was_on = false;
  std::uint8_t clears = 0;            // which of COUNTER2 to 4 to clear when the tick has been counted
  std::uint8_t compares_by_tick = 0;  // comparators that are checked in every tick, not by the chip
  motion::Events latching = 0;        // the chip's comparator events that latch
  std::array<std::int64_t, kComparators>
      compared{};                  // the last values seen by the comparators that are checked in every tick
  std::int64_t offset_lu = 0;      // work coordinate minus machine coordinate
  motion::UnitScale scale_seen{};  // the last applied CMX and CDV
  std::int64_t encoder_counts = 0;
  std::int64_t backlash_seen = 0;  // the motor's backlash pulses that have been counted
  std::int64_t path_backlash = 0;  // backlash still to be sent before its path, with sign
  std::int64_t arc_backlash = 0;   // backlash still to be sent on its path, after a reversal
  double arc_backlash_part = 0;    // fraction of a pulse that remains from earlier ticks

  Activity holder = Activity::nobody;
  bool asked_by_contact = false;  // M8x03 or M8x04 requested the jog
  Mover mover = Mover::hand;
  bool awaited = false;                 // the mover's line is waiting for the end of the motion
  Mover stop_awaited_by = Mover::hand;  // the program whose line is waiting for VDRV 0; hand: none
  bool shows_finish = false;            // outputs Y0 to Y3 go on when it arrives
  bool is_held = false;                 // held by a pause
  Rest rest;
  std::array<std::int8_t, 2> jog_keys{};  // jog direction of each pressed key, + and -; 0: not pressed
  std::int8_t plc_jog_direction = 0;      // jog direction requested in the PLC's last scan
  bool asked_by_plc = false;              // PJG or MJG requested the jog
  bool masked = false;                    // the pulses of the current motion are not sent
  bool homed = false;
  bool zeroed = false;
  bool has_ended = false;  // a motion has ended since the last start
  bool has_error = false;
  std::int8_t order = 0;  // order number of the panel's HOME or ZERO key that started it; 0: none
  double step_pps = 1;    // pps per step of the chip's speeds at the last start

  // The axis is at its last target, to which relative targets are added.
  bool stands_on_target = false;
  std::int64_t target_lu = 0;

  WheelSource wheel = WheelSource::none;
  std::int32_t wheel_lu = 0;     // length per count, during an MPG line
  std::int32_t wheel_edges = 0;  // edges that do not yet make up a count

  bool operator==(const AxisState&) const = default;

  bool moves() const { return holder != Activity::nobody && holder != Activity::rest; }
};

/// An operation of the panel's HOME or ZERO key, which starts the axes in the sequence of their order
/// numbers.
struct OrderKey {
  bool runs = false;
  std::int8_t order = 0;  // order number of the axes that are moving now
  bool has_failed = false;

  bool operator==(const OrderKey&) const = default;
};

/// All axes, and the path on which the chip carries some of them.
struct AxesState {
  std::int32_t wheel_edges = 0;  // MPG, as sampled
  std::array<motion::Axis, kAxisCount> chips{};
  std::array<motion::Environment, kAxisCount> environment{};
  std::array<AxisState, kAxisCount> axes{};
  motion::Coordinated path;  // LIN and arcs of C
  bool path_is_held = false;
  OrderKey homing_by_key;
  OrderKey zeroing_by_key;
  std::array<Tick, kAxisCount> erc_until{};
  std::array<bool, kAxisCount> clears_seen{};   // CLR, as sampled
  std::array<bool, kAxisCount> latches_seen{};  // LTC

  bool operator==(const AxesState&) const = default;
};

}  // namespace understudy::emulator::models::super_40nc
