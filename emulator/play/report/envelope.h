// Represents a signal over time with a limited number of points. If there are too many values, it keeps the
// first, the smallest, the largest and the last value of each stretch of time, with their own times.
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

  explicit Envelope(std::size_t max_stretches = 600) : max_stretches_(max_stretches) {}

  /// Adds a value. Ticks must increase: a value at an earlier tick, or a second value at the last tick, is
  /// ignored.
  void add(Tick tick, double value);
  /// Repeats the last value at every tick up to `last`. This costs only one operation per stretch.
  void stay(Tick last);

  /// Returns the points in chronological order. As long as a value does not change, only its first and last
  /// points are kept. A line through the points either equals the signal or encloses it.
  std::vector<Point> points() const;
  /// Returns true if there were at least two different values.
  bool varies() const { return !stretches_.empty() && min_ != max_; }
  double min() const { return min_; }
  double max() const { return max_; }

 private:
  struct Stretch {
    Point first;
    Point min;
    Point max;
    Point last;
  };
  void halve();

  std::size_t max_stretches_;
  Tick origin_ = 0;                 // the beginning of the first stretch
  Tick length_ = 1;                 // the length of each stretch
  std::vector<Stretch> stretches_;  // stretches in which nothing was added may be missing
  double min_ = 0;
  double max_ = 0;
};

}  // namespace understudy::emulator::play
