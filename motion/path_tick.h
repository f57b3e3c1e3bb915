// A path and the axes that it carries, in a tick in which something can happen to one of them: from edge to
// edge along the path, like motion/axis_tick.h for one axis.
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
  using Parts = std::array<AxisTick*, kPathAxes>;  // of each coordinate's axis, begun; null where it has none

  /// Begins it: where one of the axes has ended since the last tick all of them end.
  PathTick(Coordinated& path, const Coordinated::Ahead& ahead, Tick tick, std::span<Axis> axes,
           const Parts& parts, bool stays_engaged);

  /// The next moment in the tick at which something can happen; its end where nothing can.
  const Instant& next();
  /// On to next(), and through what is to happen there.
  void look();
  bool is_over() const { return is_over_; }
  /// On to a moment that is not beyond next().
  void go_to(Instant at);
  /// Slows down from the moment on to which it has been brought, by the ramps of `by`.
  void slow_down(Cause why, const SpeedLaw& by);
  /// Somebody else has changed its axes.
  void look_again() {
    heed_axes();
    is_found_ = false;
  }

 private:
  void find_next();
  std::optional<double> first_beyond(std::size_t i) const;
  std::optional<double> first_beyond(std::size_t i, double from_u, double to_u) const;
  void carry_to(double along_u, Instant at);
  void heed_axes();
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
  bool ends_in_it_;  // its last path
  bool is_over_ = false;
  bool is_found_ = false;
  Instant moment_{};  // of what is next, and where it is
  std::optional<double> edge_u_{};
};

}  // namespace understudy::motion
