// Coordinated motion: a run along paths (motion/path_run.h) carries up to four axes.
//
// Each axis is at the whole pulse nearest to the path's place at every tick, so it is never more than half a
// pulse off.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "motion/axis.h"
#include "motion/path_run.h"
#include "motion/unit_scale.h"

namespace understudy::motion {

struct Coordinated {
  static constexpr std::int8_t kNone = -1;

  PathRun run;
  // For each coordinate of the path, 0 .. 3: the axis that moves with it, in the span given to the tick, or
  // kNone. One that the span does not have is left out.
  std::array<std::int8_t, kPathAxes> axis_of{kNone, kNone, kNone, kNone};
  std::array<UnitScale, kPathAxes> scale{};
  std::array<std::int64_t, kPathAxes> zero_pulses{};  // travel of the axis where its coordinate is 0

  // State.
  bool engaged = false;
  Cause cause = Cause::none;        // of the last end
  Cause slowing_for = Cause::none;  // slowing down on the path, to stop for this

  bool operator==(const Coordinated&) const = default;

  /// Takes the axes along `axis_of` and begins what is queued. `from` is the place they are at, in path
  /// units. If one axis is refused, all are; then nothing has changed. Throws BadMotion for a place that is
  /// not finite or not where the first path begins, and for an invalid scale.
  Cause begin(const Point& from, std::span<Axis> axes, Tick now);

  /// One tick of the axes that take part before it, instead of their own step(); `here` and `pulses` (added
  /// to, signed as they come out) go with `axes`. When one is stopped, for whatever reason, all stop where
  /// they are, and the rest is abandoned; when the queue has run empty at rest, they are let go (unless the
  /// owner keeps them with `stays_engaged`). One that is stopped by what it meets within the tick stops the
  /// others at that place of the path; one that is to slow down slows all of them from there on.
  void step(Tick tick, std::span<Axis> axes, std::span<const Surroundings> here,
            std::span<std::int64_t> pulses, bool stays_engaged = false);

  /// Slows down on the path from now on, and ends there for `why`; the rest is abandoned. An axis whose
  /// reaction is to slow down (to a limit, say) does the same to all.
  void slow_down(Tick now, Cause why = Cause::stopped);
  /// No pulse after this, for all of them.
  void stop(std::span<Axis> axes, Cause why = Cause::stopped);

  bool takes(std::size_t axis) const;
  /// The signed speed of that axis after tick `now`; 0 if it takes no part.
  double speed_pps(std::size_t axis, Tick now) const;
  /// Pulses of that axis until the end of the path being run, signed as they come out; 0 if it takes no part,
  /// or will not get there.
  std::int64_t pulses_to_come(std::size_t axis, std::span<const Axis> axes) const;
  /// The travel of the axis of coordinate `i` at a place, rounded half away from zero.
  std::int64_t travel_at(std::size_t i, double place_u) const;

 private:
  struct Stopped;
  using Targets = std::array<std::int64_t, kPathAxes>;  // the travel of each coordinate's axis
  /// Where an axis has turned round within the tick, beyond where it began and where it ends.
  struct Excursion {
    std::int64_t travel = 0;
    double along_u = 0;
  };
  using Excursions = std::array<std::optional<Excursion>, kPathAxes>;
  Excursions excursions(const Targets& target, const PathRun::Stretch& gone, Tick tick,
                        std::span<const Axis> axes) const;
  bool comes_back(const Targets& target, const PathRun::Stretch& gone, Tick tick,
                  std::span<const Axis> axes) const;
  Stopped first_stopped(const Targets& target, const Excursions& beyond, const PathRun::Stretch& gone,
                        Tick tick, std::span<const Axis> axes, std::span<const Surroundings> here) const;
  Cause carry(Targets target, const PathRun::Stretch& gone, Tick tick, std::span<Axis> axes,
              std::span<const Surroundings> here, std::span<std::int64_t> pulses);
  void slow_within(Targets& target, PathRun::Stretch& gone, Tick tick, std::span<const Axis> axes,
                   std::span<const Surroundings> here);
  double along_where(std::size_t i, std::int64_t travel, std::int64_t from_travel,
                     const PathRun::Stretch& gone, double from_u, double to_u) const;
};

}  // namespace understudy::motion
