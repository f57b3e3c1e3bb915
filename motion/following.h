// Following: an axis follows another source of counts (a hand wheel, an encoder) by a ratio.
//
// All numbers are integers. The remainder of each division is kept, so nothing is lost, however long the axis
// follows.
#pragma once

#include <cstdint>

namespace understudy::motion {

struct Follower {
  // pulses = counts * numerator / denominator. The sign of the numerator is the direction; with 0, the axis
  // does not move.
  std::int64_t numerator = 1;
  std::int64_t denominator = 1;
  // Counts are gathered for this many ticks. Their pulses are sent evenly over the next period of the same
  // length.
  std::int32_t period_ticks = 1;
  std::int64_t top_speed_pps = 0;  // 0: no limit
  std::int64_t slope_pps = 0;      // the largest change of speed from period to period; 0: no limit
  // True: pulses held back by the limits are sent later, and the axis slows down in time to stop at its
  // position. False: they are dropped.
  bool catches_up = false;

  // State.
  std::int64_t gathered = 0;         // counts of this period so far
  std::int64_t left_over = 0;        // remainder of the division, in counts * numerator: 0 .. denominator - 1
  std::int64_t behind_pulses = 0;    // pulses still to be caught up
  std::int64_t period_pulses = 0;    // pulses to be sent in this period
  std::int32_t phase = 0;            // ticks of this period that are done
  std::int64_t speed_left_over = 0;  // remainder of the speed limit's division, in pulses / 1000

  bool operator==(const Follower&) const = default;

  /// Throws BadMotion unless the denominator is 1 .. 2^31-1, the numerator within +-(2^31-1), the period 1 ..
  /// 1000 and the limits not negative.
  void check() const;

  void feed(std::int64_t counts) { gathered += counts; }

  /// Returns the pulses of the next tick, signed.
  std::int64_t step();

  /// Returns true if no counts are gathered and no pulses remain.
  bool quiet() const;
};

}  // namespace understudy::motion
