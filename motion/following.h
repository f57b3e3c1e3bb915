// Following: an axis that goes where something else goes (a hand-wheel, an encoder), by a ratio.
//
// Whole numbers only: what a ratio leaves over is kept, so nothing is lost however long it follows.
#pragma once

#include <cstdint>

namespace understudy::motion {

struct Follower {
  // pulses = counts * numerator / denominator; the numerator's sign is the direction, 0 stands still.
  std::int64_t numerator = 1;
  std::int64_t denominator = 1;
  // Counts are gathered for this many ticks, and their pulses come out evenly over the next as many.
  std::int32_t period_ticks = 1;
  std::int64_t top_speed_pps = 0;  // no faster than this; 0: no bound
  std::int64_t slope_pps = 0;      // and the speed changes by at most this from period to period; 0: no bound
  // Pulses held back by the bounds are sent later, and it slows down in time for where it should be; else
  // they are forgotten.
  bool catches_up = false;

  // State.
  std::int64_t gathered = 0;         // counts of this period
  std::int64_t left_over = 0;        // of the division, in counts * numerator: 0 .. denominator - 1
  std::int64_t behind_pulses = 0;    // to be caught up
  std::int64_t period_pulses = 0;    // to come out in this period
  std::int32_t phase = 0;            // ticks of this period done
  std::int64_t speed_left_over = 0;  // of the bound's division, in pulses / 1000

  bool operator==(const Follower&) const = default;

  /// Throws BadMotion: denominator 1 .. 2^31-1, numerator as large at most, period 1 .. 1000, bounds not
  /// negative.
  void check() const;

  void feed(std::int64_t counts) { gathered += counts; }

  /// The pulses of the next tick, signed.
  std::int64_t step();

  /// Nothing gathered, and nothing to come.
  bool quiet() const;
};

}  // namespace understudy::motion
