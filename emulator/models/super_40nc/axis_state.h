// An axis of a SUPER-40NC, as a value: the chip's motor and counters, who holds it, and what the controller
// remembers of its motions.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/models/super_40nc/ownership.h"
#include "motion/axis.h"
#include "motion/counter.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

/// Where the hand-wheel is turned on.
enum class WheelSource : std::uint8_t { none, mpg_line, contact_1, contact_10, contact_100, selector };

/// Who moves an axis: a step program or the PLC, in the order of their areas, or somebody by hand.
enum class Mover : std::uint8_t { c, x, y, z, u, plc, hand };

/// What a program's motion is, as far as it is to go on behind a pause.
enum class RestKind : std::uint8_t { none, move, path, mark, turning, home };
struct Rest {
  RestKind kind = RestKind::none;
  std::int64_t travel = 0;    // of the chip: where it is to come to
  std::int64_t distance = 0;  // MRK: to the target, and behind it
  std::int64_t search = 0;
  bool searches = false;
  bool marks_positive = false;
  std::int32_t rpm = 0;       // MRK, VDRV
  bool limits_count = false;  // MRK with X16 = 0: its signals are limits, whatever X33 and X34 say

  bool operator==(const Rest&) const = default;
};

inline constexpr std::size_t kCounters = 4;
inline constexpr std::size_t kComparators = 5;

struct AxisState {
  std::int64_t sent_pulses = 0;      // in the last tick, in the motor's sense
  std::int64_t followed_pulses = 0;  // of the travel, in the last tick
  // COUNTER1 goes by the travel; the others count as D9x23 to D9x25 say.
  motion::Counter command{.range = motion::Counter::Range::bits28};
  std::array<std::int32_t, kCounters - 1> counts{};
  std::array<std::int32_t, kCounters> latched{};
  std::int32_t index_count = 0;  // C signals of the last home
  bool latch_was_on = false;
  std::uint8_t clears = 0;                            // COUNTER2 to 4, when the tick's counts are in
  std::uint8_t compares_by_tick = 0;                  // comparators that the chip's do not do
  motion::Events latching = 0;                        // of the chip's comparators, whose event latches
  std::array<std::int64_t, kComparators> compared{};  // what those have seen last
  std::int64_t offset_lu = 0;                         // of the work coordinate against the machine's
  motion::UnitScale scale_seen{};                     // CMX and CDV as they were taken last
  std::int64_t encoder_counts = 0;
  std::int64_t backlash_seen = 0;  // of the motor's
  std::int64_t path_backlash = 0;  // that comes before its path begins, signed by the way it goes
  std::int64_t arc_backlash = 0;   // that still comes on its path, where it has turned round
  double arc_backlash_part = 0;    // of a pulse, from the ticks before

  Holder holder = Holder::nobody;
  bool asked_by_contact = false;  // the jog, by M8x03 or M8x04
  Mover mover = Mover::hand;
  bool awaited = false;                 // by the mover's line
  Mover stop_awaited_by = Mover::hand;  // of VDRV 0: whose line; hand: of none
  bool shows_finish = false;            // Y0 to Y3 when it arrives
  bool is_held = false;                 // by a pause
  Rest rest;
  std::array<std::int8_t, 2> jog_keys{};  // the keys + and - that are down: which way each jogs
  std::int8_t plc_jog_way = 0;            // that the PLC asked for in its last scan
  bool asked_by_plc = false;              // the same by PJG or MJG
  bool masked = false;                    // of the motion that runs: pulses do not come out
  bool homed = false;
  bool zeroed = false;
  bool has_ended = false;  // a motion, since the last start
  bool has_error = false;
  std::int8_t order = 0;  // of the panel's HOME or ZERO key that started it; 0: none
  double step_pps = 1;    // of the chip's speeds, by the last start

  // Relative targets go on from the last one while the axis stands on it.
  bool stands_on_target = false;
  std::int64_t target_lu = 0;

  WheelSource wheel = WheelSource::none;
  std::int32_t wheel_lu = 0;     // a count, of an MPG line
  std::int32_t wheel_edges = 0;  // that do not make a count yet

  bool operator==(const AxisState&) const = default;

  bool moves() const { return holder != Holder::nobody && holder != Holder::rest; }
};

}  // namespace understudy::emulator::models::super_40nc
