// LIN and arcs of the C program, on which the chip carries several axes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis/axis_parts.h"
#include "emulator/models/super_40nc/path/path_backlash.h"
#include "emulator/models/super_40nc/path/path_state.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/move.h"
#include "motion/path.h"

namespace understudy::emulator::models::super_40nc {

/// A LIN or an arc, in the machine coordinate.
struct PathPlan {
  motion::Path path;
  std::array<bool, kAxisCount> takes{};
  std::array<std::int64_t, kAxisCount> target_lu{};  // the target in the work coordinate
  std::int32_t feed_lu_per_s = 0;
  int mode = 0;  // the value of the chip's PRMD
};

class Paths : protected Chips {
 public:
  Paths(AxisParts& parts, PathState& state)
      : Chips(parts.chips), parts_(parts), state_(state), backlash_(parts.chips, state) {}

  /// Returns the common grant of all axes of a path.
  Grant ask_for_path(const std::array<bool, kAxisCount>& takes);
  /// Returns true if the path has begun; otherwise, reports its error.
  bool begin_path(const PathPlan& plan);
  /// Returns true if a new path continues the current one (D9005).
  bool joins_paths() const;
  /// Returns true if the current path has room for another piece with the same axes.
  bool has_room_on_path(const std::array<bool, kAxisCount>& takes) const;
  void join_path(const PathPlan& plan);
  /// Returns where the next LIN or arc begins.
  std::int64_t path_base_lu(int axis_number) const;
  void apply_override();

  void hold_path();
  void resume_path();
  /// Executes VDRV 0: slows down by the path's ramp and ends.
  void slow_path();
  void stop_path();
  /// Stops all axes of the path because of `why`. path_ended() is called afterwards.
  void break_off(motion::Cause why) { axes_.path.stop(axes_.chips, why); }
  void slow_path_for(motion::Cause why) { axes_.path.slow_down(now(), why); }
  void step_axes(Tick tick, std::array<std::int64_t, kAxisCount>& sent);
  /// Called when the path has arrived, or one of its axes has encountered an obstacle. Returns what has ended
  /// the program that is waiting for the path.
  std::optional<motion::Cause> path_ended();

 private:
  double path_feed() const;
  double feed_scale(const motion::Path& path) const;
  motion::SpeedLaw prepare_axes(const PathPlan& plan, motion::Coordinated& path);
  bool is_blocked(const PathPlan& plan);
  motion::Cause blocked_on_path(int axis_number, const motion::Path& path) const;
  void take_axis(int number, const PathPlan& plan, const motion::Coordinated& path,
                 const motion::SpeedLaw& law);

  AxisParts& parts_;
  PathState& state_;
  PathBacklash backlash_;
};

}  // namespace understudy::emulator::models::super_40nc
