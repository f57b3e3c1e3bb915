#include "motion/coordinated.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "motion/axis.h"
#include "motion/bisection.h"
#include "motion/path.h"
#include "motion/surroundings.h"
#include "motion/tick.h"
#include "motion/unit_scale.h"

namespace understudy::motion {

namespace {

/// Half away from zero. Nobody counts beyond 1e18: it stays there.
std::int64_t nearest(double value) {
  const double size = std::abs(value);
  const auto whole = size < 1e18 ? static_cast<std::int64_t>(size + 0.5) : 1'000'000'000'000'000'000;
  return value < 0 ? -whole : whole;
}

/// Nothing for kNone, and for an axis that the span does not have.
Axis* axis_at(std::int8_t number, std::span<Axis> axes) {
  const bool there = number >= 0 && static_cast<std::size_t>(number) < axes.size();
  return there ? &axes[static_cast<std::size_t>(number)] : nullptr;
}

}  // namespace

std::int64_t Coordinated::travel_at(std::size_t i, double place_u) const {
  return zero_pulses[i] +
         nearest(place_u * static_cast<double>(scale[i].multiplier) / static_cast<double>(scale[i].divider));
}

bool Coordinated::takes(std::size_t axis) const {
  for (const std::int8_t mine : axis_of) {
    if (engaged && mine >= 0 && static_cast<std::size_t>(mine) == axis) return true;
  }
  return false;
}

double Coordinated::speed_pps(std::size_t axis, Tick now) const {
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    if (!engaged || axis_of[i] < 0 || static_cast<std::size_t>(axis_of[i]) != axis) continue;
    return run.velocity(now)[static_cast<Eigen::Index>(i)] * scale[i].pulses_per_unit();
  }
  return 0;
}

std::int64_t Coordinated::pulses_to_come(std::size_t axis, std::span<const Axis> axes) const {
  if (!engaged || !run.running() || slowing_for != Cause::none || axis >= axes.size()) return 0;
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    if (axis_of[i] < 0 || static_cast<std::size_t>(axis_of[i]) != axis) continue;
    const double end_u = run.path().end[static_cast<Eigen::Index>(i)];
    const std::int64_t pulses = travel_at(i, end_u) - axes[axis].travel_pulses;
    return axes[axis].inverted ? -pulses : pulses;
  }
  return 0;
}

Cause Coordinated::begin(const Point& from, std::span<Axis> axes, Tick now) {
  for (const std::int8_t mine : axis_of) {
    const Axis* axis = axis_at(mine, axes);
    if (axis == nullptr) continue;
    if (const Cause why_not = axis->forbidden_anywhere(); why_not != Cause::none) return why_not;
  }
  for (const UnitScale& factors : scale) (void)UnitScale::of(factors.multiplier, factors.divider);
  run.stand_at(from);  // these two may throw
  run.start(now);
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    Axis* axis = axis_at(axis_of[i], axes);
    if (axis == nullptr) continue;
    axis->take_part();
    zero_pulses[i] = 0;
    zero_pulses[i] = axis->travel_pulses - travel_at(i, from[static_cast<Eigen::Index>(i)]);
  }
  engaged = true;
  cause = slowing_for = Cause::none;
  return Cause::none;
}

/// Where on the path the first of its axes is stopped within a tick, and which ones are at that place.
struct Coordinated::Stopped {
  std::array<bool, kPathAxes> there{};
  Point place = Point::Zero();
  bool any = false;
  bool at_once = false;  // before any pulse of the tick
};

/// The length at which the axis of coordinate `i` comes to a travel that it passes on the stretch.
double Coordinated::along_where(std::size_t i, std::int64_t travel, std::int64_t from_travel,
                                const PathRun::Stretch& gone, double from_u) const {
  const bool is_upwards = travel > from_travel;
  const auto is_there = [&](double along_u) {
    const std::int64_t reached = travel_at(i, run.place_on(gone, along_u)[static_cast<Eigen::Index>(i)]);
    return is_upwards ? reached >= travel : reached <= travel;
  };
  if (travel == from_travel || is_there(from_u)) return from_u;
  return is_there(gone.to_u) ? turnover(from_u, gone.to_u, is_there).after : gone.to_u;
}

Coordinated::Stopped Coordinated::first_stopped(const Targets& target, const PathRun::Stretch& gone,
                                                Tick tick, std::span<const Axis> axes,
                                                std::span<const Surroundings> here) const {
  Stopped stopped;
  double first_u = 0;
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    const auto number = static_cast<std::size_t>(axis_of[i]);
    if (axis_of[i] < 0 || number >= axes.size()) continue;
    const Axis& axis = axes[number];
    if (axis.task != Task::coordinated) continue;
    Axis tried = axis;  // what stops it is its own affair
    tried.carry(target[i] - tried.travel_pulses, tick, here[number]);
    if (tried.task == Task::coordinated) continue;
    const double from_u = run.began_at(gone, tick);
    const double along_u = along_where(i, tried.travel_pulses, axis.travel_pulses, gone, from_u);
    if (stopped.any && along_u > first_u) continue;
    if (!stopped.any || along_u < first_u) {
      stopped = {.place = run.place_on(gone, along_u), .any = true, .at_once = along_u <= from_u};
    }
    stopped.there[i] = true;
    first_u = along_u;
  }
  return stopped;
}

/// Takes each axis to its target and gives what ended the motion of one, or Cause::none.
Cause Coordinated::carry(Targets target, const PathRun::Stretch& gone, Tick tick, std::span<Axis> axes,
                         std::span<const Surroundings> here, std::span<std::int64_t> pulses) {
  const Stopped stopped = first_stopped(target, gone, tick, axes, here);
  Cause ended_by = Cause::none;
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    Axis* axis = axis_at(axis_of[i], axes);
    if (axis == nullptr) continue;
    const auto number = static_cast<std::size_t>(axis_of[i]);
    if (axis->task == Task::coordinated) {
      if (stopped.any && !stopped.there[i]) {
        target[i] =
            stopped.at_once ? axis->travel_pulses : travel_at(i, stopped.place[static_cast<Eigen::Index>(i)]);
      }
      pulses[number] += axis->carry(target[i] - axis->travel_pulses, tick, here[number]);
    } else {
      // Stopped or begun otherwise between the ticks: it has its tick all the same.
      pulses[number] += axis->step(tick, here[number]);
    }
    const bool arrived = axis->task == Task::none && axis->cause == Cause::arrived;
    if (axis->task != Task::coordinated && !arrived && ended_by == Cause::none) {
      ended_by = axis->cause == Cause::none ? Cause::stopped : axis->cause;
    }
    if (axis->task == Task::coordinated && axis->slowing) slow_down(tick, axis->cause);
  }
  return ended_by;
}

void Coordinated::step(Tick tick, std::span<Axis> axes, std::span<const Surroundings> here,
                       std::span<std::int64_t> pulses, bool stays_engaged) {
  if (!engaged) return;
  PathRun::Stretch gone;
  const Point& place = run.step(tick, &gone);
  Targets target{};
  bool is_quiet = true;
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    const Axis* axis = axis_at(axis_of[i], axes);
    if (axis == nullptr) continue;
    target[i] = travel_at(i, place[static_cast<Eigen::Index>(i)]);
    is_quiet = is_quiet && !axis->slowing && target[i] >= axis->watch_low && target[i] <= axis->watch_high &&
               axis->carries_quietly(here[static_cast<std::size_t>(axis_of[i])]);
  }
  Cause ended_by = Cause::none;
  if (is_quiet) [[likely]] {
    for (std::size_t i = 0; i < axis_of.size(); ++i) {
      Axis* axis = axis_at(axis_of[i], axes);
      if (axis == nullptr) continue;
      pulses[static_cast<std::size_t>(axis_of[i])] += axis->carry_across(target[i] - axis->travel_pulses);
    }
  } else {
    ended_by = carry(target, gone, tick, axes, here, pulses);
  }
  if (ended_by != Cause::none) {
    stop(axes, ended_by);
  } else if (slowing_for != Cause::none && run.at_rest(tick)) {
    stop(axes, slowing_for);
  } else if (run.queued() == 0 && !run.paused() && !stays_engaged) {
    bool settling = false;
    for (const std::int8_t mine : axis_of) {
      Axis* axis = axis_at(mine, axes);
      if (axis == nullptr) continue;
      axis->arrive();
      settling = settling || axis->task == Task::coordinated;
    }
    if (settling) return;
    engaged = false;
    cause = Cause::arrived;
    run.abandon();
  }
}

void Coordinated::slow_down(Tick now, Cause why) {
  if (!engaged || slowing_for != Cause::none) return;
  slowing_for = why;
  run.pause(now);
}

void Coordinated::stop(std::span<Axis> axes, Cause why) {
  if (!engaged) return;
  engaged = false;
  cause = why;
  run.abandon();
  for (const std::int8_t mine : axis_of) {
    Axis* axis = axis_at(mine, axes);
    if (axis != nullptr && axis->task == Task::coordinated) axis->stop(why);
  }
}

}  // namespace understudy::motion
