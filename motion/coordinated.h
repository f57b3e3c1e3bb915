// Coordinated motion: a run along paths (motion/path_run.h) carries up to four axes.
//
// Each axis is at the whole pulse nearest to the path's place at every tick, so it is never more than half a
// pulse off.
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
  /// they are then, and the rest is abandoned; when the queue has run empty at rest, they are let go (unless
  /// the owner keeps them with `stays_engaged`). One that is to slow down slows all of them from there on.
  /// Where others act on them in mid tick: motion/shared_tick.h.
  void step(Tick tick, std::span<Axis> axes, std::span<const Surroundings> here,
            std::span<std::int64_t> pulses, bool stays_engaged = false);

  /// Slows down on the path from now on, and ends there for `why`; the rest is abandoned. An axis whose
  /// reaction is to slow down (to a limit, say) does the same to all.
  void slow_down(Tick now, Cause why = Cause::stopped);
  /// No pulse after this, for all of them.
  void stop(std::span<Axis> axes, Cause why = Cause::stopped, Instant at = {});

  using Targets = std::array<std::int64_t, kPathAxes>;  // the travel of each coordinate's axis
  /// The tick of the run alone, and whether all axes come to its end without anything in between.
  struct Ahead {
    PathRun::Stretch gone;
    Targets target{};
    bool is_quiet = false;
  };
  Ahead look_ahead(Tick tick, std::span<const Axis> axes, std::span<const Surroundings> here,
                   bool stays_engaged);
  /// Where that is so, takes them there.
  void cross(const Ahead& ahead, std::span<Axis> axes, std::span<std::int64_t> pulses);
  /// At the tick's end: one that has slowed down stands.
  void settle(Tick tick, std::span<Axis> axes);
  /// The queue has run empty: lets them go, as soon as all of them are in position.
  void let_go(std::span<Axis> axes, Instant at);
  bool is_over(bool stays_engaged) const {
    return slowing_for == Cause::none && run.queued() == 0 && !run.paused() && !stays_engaged;
  }

  bool takes(std::size_t axis) const;
  /// The signed speed of that axis after tick `now`; 0 if it takes no part.
  double speed_pps(std::size_t axis, Tick now) const;
  /// Pulses of that axis until the end of the path being run, signed as they come out; 0 if it takes no part,
  /// or will not get there.
  std::int64_t pulses_to_come(std::size_t axis, std::span<const Axis> axes) const;
  /// The travel of the axis of coordinate `i` at a place, rounded half away from zero.
  std::int64_t travel_at(std::size_t i, double place_u) const;
};

}  // namespace understudy::motion
