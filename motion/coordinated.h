// Coordinated motion: a run along paths (motion/path_run.h) carries up to four axes.
//
// At every tick, each axis is at the whole pulse nearest to the path's place, so the error is at most half a
// pulse.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "motion/axis.h"
#include "motion/path_run.h"
#include "motion/unit_scale.h"

namespace understudy::motion {

struct Coordinated {
  static constexpr std::int8_t kNone = -1;

  PathRun run;
  // For each coordinate of the path, 0 .. 3, `axis_of` names the axis that moves with it, as an index into
  // the span given to the tick, or kNone. An axis that is not in the span is omitted.
  std::array<std::int8_t, kPathAxes> axis_of{kNone, kNone, kNone, kNone};
  std::array<UnitScale, kPathAxes> scale{};
  std::array<std::int64_t, kPathAxes> zero_pulses{};  // travel of the axis where its coordinate is 0

  // State.
  bool engaged = false;
  Cause cause = Cause::none;        // why the last motion ended
  Cause slowing_for = Cause::none;  // why the axes are slowing down to stop on the path; none: they are not

  bool operator==(const Coordinated&) const = default;

  /// Takes over the axes in `axis_of` and begins the queued paths. `from` is the present place of the axes,
  /// in path units. If one axis is refused, all are, and nothing changes. Throws BadMotion if the place is
  /// not finite or differs from the beginning of the first path, and for an invalid scale.
  Cause begin(const Point& from, std::span<Axis> axes, Tick now);

  /// Runs one tick of the axes that took part before the tick, instead of their own step(). `environment` and
  /// `pulses` have one element for each of `axes`. The pulses sent are added to `pulses`, with the sign of
  /// the output. When one axis is stopped, for any reason, all axes stop at their present positions and the
  /// rest of the path is abandoned. When the queue runs empty at rest, the axes are released, unless the
  /// owner keeps them with `stays_engaged`. An axis that must decelerate slows down all axes from that point
  /// on. If axes act on each other within a tick, use motion/shared_tick.h.
  void step(Tick tick, std::span<Axis> axes, std::span<const Environment> environment,
            std::span<std::int64_t> pulses, bool stays_engaged = false);

  /// Decelerates on the path from now on and ends there because of `why`; the rest of the path is abandoned.
  /// An axis whose reaction is to decelerate (at a limit, for example) does the same to all axes.
  void slow_down(Tick now, Cause why = Cause::stopped);
  /// Stops all axes: no further pulse is sent.
  void stop(std::span<Axis> axes, Cause why = Cause::stopped, Instant at = {});

  using Targets = std::array<std::int64_t, kPathAxes>;  // the travel of each coordinate's axis
  /// The result of a tick of the run alone: the stretch of path, the targets of the axes, and whether all
  /// axes reach their targets without an event in between.
  struct Ahead {
    PathRun::Stretch gone;
    Targets target{};
    bool is_quiet = false;
  };
  Ahead look_ahead(Tick tick, std::span<const Axis> axes, std::span<const Environment> environment,
                   bool stays_engaged);
  /// Moves the axes to the targets of a quiet look_ahead().
  void fast_forward(const Ahead& ahead, std::span<Axis> axes, std::span<std::int64_t> pulses);
  /// Called at the end of the tick. Ends the motion if it has slowed down to a stop.
  void settle(Tick tick, std::span<Axis> axes);
  /// Releases the axes when the queue is empty and all axes are in position.
  void let_go(std::span<Axis> axes, Instant at);
  bool is_over(bool stays_engaged) const {
    return slowing_for == Cause::none && run.queued() == 0 && !run.paused() && !stays_engaged;
  }

  bool takes(std::size_t axis) const;
  /// Returns the signed speed of that axis after tick `now`, or 0 if it takes no part.
  double speed_pps(std::size_t axis, Tick now) const;
  /// Returns how many pulses that axis will send until the end of the current path, with the sign of the
  /// output. Returns 0 if the axis takes no part or will not get there.
  std::int64_t pulses_to_come(std::size_t axis, std::span<const Axis> axes) const;
  /// Returns the travel of the axis of coordinate `i` at a place, rounded half away from zero.
  std::int64_t travel_at(std::size_t i, double place_u) const;
};

}  // namespace understudy::motion
