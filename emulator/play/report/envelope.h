// One signal over time in a bounded number of points, however long it goes on: if there are too many values,
// the first, the least, the greatest and the last of each stretch of time are kept, each at its own time.
#pragma once

#include <cstddef>
#include <vector>

#include "base/simulated_time.h"

namespace understudy::emulator::play {

class Envelope {
 public:
  struct Point {
    Tick tick = 0;
    double value = 0;
    bool operator==(const Point&) const = default;
  };

  explicit Envelope(std::size_t most_stretches = 600) : most_stretches_(most_stretches) {}

  /// Ticks ascend; an earlier one, or the last one again, is left out.
  void add(Tick tick, double value);
  /// The last value again, at every tick up to `last`. Costs as many steps as there are stretches in it.
  void stay(Tick last);

  /// In the order of time. Where a value stays the same for a while only its first and last points are kept,
  /// so a line from point to point is what was added, or encloses it.
  std::vector<Point> points() const;
  /// Whether it ever had two values.
  bool varies() const { return !stretches_.empty() && least_ != greatest_; }
  double least() const { return least_; }
  double greatest() const { return greatest_; }

 private:
  struct Stretch {
    Point first;
    Point least;
    Point greatest;
    Point last;
  };
  void halve();

  std::size_t most_stretches_;
  Tick origin_ = 0;                 // where the first stretch begins
  Tick length_ = 1;                 // of each stretch
  std::vector<Stretch> stretches_;  // some may be missing: nothing was added then
  double least_ = 0;
  double greatest_ = 0;
};

}  // namespace understudy::emulator::play
