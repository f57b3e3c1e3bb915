// A path and the axes that it carries, in a tick during which something may happen to one of them. It
// proceeds from edge to edge along the path, as motion/axis_tick.h does for a single axis.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "motion/axis.h"
#include "motion/axis_tick.h"
#include "motion/coordinated.h"
#include "motion/move.h"
#include "motion/pulse_drive.h"

namespace understudy::motion {

class PathTick {
 public:
  // the tick of each coordinate's axis, which has already begun; null if the coordinate has no axis
  using Parts = std::array<AxisTick*, kPathAxes>;

  /// Begins the tick. If an axis has ended since the last tick, all axes end.
  PathTick(Coordinated& path, const Coordinated::Ahead& ahead, Tick tick, std::span<Axis> axes,
           const Parts& parts, bool stays_engaged);

  /// Returns the next moment at which something may happen, or else the end of the tick.
  const Instant& next();
  /// Goes to next() and handles what happens there.
  void step_events();
  bool is_over() const { return is_over_; }
  /// Goes to a moment that is not after next().
  void go_to(Instant at);
  /// Returns the travel to which go_to(at) would bring the axis of coordinate `i`.
  std::int64_t travel_at(std::size_t i, const Instant& at) const;
  /// Slows down the path from the present moment on, by the ramps of `by`.
  void slow_down(Cause why, const SpeedLaw& by);
  /// Checks the axes again after another object has changed them.
  void rearm() {
    check_axes();
    is_found_ = false;
  }

 private:
  void find_next();
  std::optional<double> first_beyond(std::size_t i) const;
  std::optional<double> first_beyond(std::size_t i, double from_u, double to_u) const;
  double along_at(const Instant& at) const;
  void carry_to(double along_u, Instant at);
  void check_axes();
  Axis* axis(std::size_t i) const {
    return parts_[i] != nullptr ? &axes_[static_cast<std::size_t>(path_.axis_of[i])] : nullptr;
  }

  Coordinated& path_;
  PathRun::Stretch gone_;
  Coordinated::Targets target_;
  Tick tick_;
  std::span<Axis> axes_;
  Parts parts_;
  Instant at_;
  double along_u_;
  bool ends_in_it_;  // the last path ends in this tick
  bool is_over_ = false;
  bool is_found_ = false;
  Instant moment_{};  // when the next edge happens; edge_u_ is where
  std::optional<double> edge_u_{};
};

}  // namespace understudy::motion
