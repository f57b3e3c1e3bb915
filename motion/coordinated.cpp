#include "motion/coordinated.h"

#include <algorithm>
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

/// Towards zero; what is short of a pulse by rounding errors alone is one.
std::int64_t whole(double value) {
  constexpr double kAlmost = 1e-6;
  const double size = std::min(std::abs(value) + kAlmost, 1e18);
  return static_cast<std::int64_t>(value < 0 ? -size : size);
}

/// Nothing for kNone, and for an axis that the span does not have.
Axis* axis_at(std::int8_t number, std::span<Axis> axes) {
  const bool there = number >= 0 && static_cast<std::size_t>(number) < axes.size();
  return there ? &axes[static_cast<std::size_t>(number)] : nullptr;
}

/// As far as an axis may go out and back within a tick, at the turn of an arc.
bool is_near_edge(const Axis& axis, std::int64_t travel) {
  constexpr std::int64_t kNear_pulses = 256;
  return travel > axis.watch_high - kNear_pulses || travel < axis.watch_low + kNear_pulses;
}

}  // namespace

std::int64_t Coordinated::travel_at(std::size_t i, double place_u) const {
  const UnitScale& by = scale[i];
  // A unit is a pulse for most, and dividing by 1 takes its time all the same.
  if (by.multiplier == 1 && by.divider == 1) return zero_pulses[i] + nearest(place_u);
  const double pulses = place_u * static_cast<double>(by.multiplier) / static_cast<double>(by.divider);
  return zero_pulses[i] + (by.truncates ? whole(pulses) : nearest(pulses));
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
                                const PathRun::Stretch& gone, double from_u, double to_u) const {
  const bool is_upwards = travel > from_travel;
  const auto is_there = [&](double along_u) {
    const std::int64_t reached = travel_at(i, run.place_on(gone, along_u)[static_cast<Eigen::Index>(i)]);
    return is_upwards ? reached >= travel : reached <= travel;
  };
  if (travel == from_travel || is_there(from_u)) return from_u;
  return is_there(to_u) ? turnover(from_u, to_u, is_there).after : to_u;
}

/// Of axes that have an edge near; others need not know.
Coordinated::Excursions Coordinated::excursions(const Targets& target, const PathRun::Stretch& gone,
                                                Tick tick, std::span<const Axis> axes) const {
  Excursions found{};
  if (!run.bends(gone)) return found;
  const double from_u = run.began_at(gone, tick);
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    const auto number = static_cast<std::size_t>(axis_of[i]);
    if (axis_of[i] < 0 || number >= axes.size() || !is_near_edge(axes[number], target[i])) continue;
    const auto place = [&](double along_u) {
      return run.place_on(gone, along_u)[static_cast<Eigen::Index>(i)];
    };
    for (const double sense : {+1.0, -1.0}) {
      double low_u = from_u;
      double high_u = gone.to_u;
      constexpr int kThirds = 60;  // of a stretch: to the last digits
      for (int third = 0; third < kThirds; ++third) {
        const double first_u = low_u + (high_u - low_u) / 3;
        const double second_u = high_u - (high_u - low_u) / 3;
        (sense * place(first_u) < sense * place(second_u) ? low_u : high_u) =
            sense * place(first_u) < sense * place(second_u) ? first_u : second_u;
      }
      const std::int64_t travel = travel_at(i, place(low_u));
      const std::int64_t present = axes[number].travel_pulses;
      const bool is_beyond =
          sense > 0 ? travel > std::max(present, target[i]) : travel < std::min(present, target[i]);
      if (!is_beyond) continue;
      found[i] = Excursion{travel, low_u};
      break;
    }
  }
  return found;
}

/// Whether an axis comes back from beyond what is watched.
bool Coordinated::comes_back(const Targets& target, const PathRun::Stretch& gone, Tick tick,
                             std::span<const Axis> axes) const {
  const Excursions beyond = excursions(target, gone, tick, axes);
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    if (!beyond[i]) continue;
    const Axis& axis = axes[static_cast<std::size_t>(axis_of[i])];
    if (beyond[i]->travel < axis.watch_low || beyond[i]->travel > axis.watch_high) return true;
  }
  return false;
}

Coordinated::Stopped Coordinated::first_stopped(const Targets& target, const Excursions& beyond,
                                                const PathRun::Stretch& gone, Tick tick,
                                                std::span<const Axis> axes,
                                                std::span<const Surroundings> here) const {
  Stopped stopped;
  double first_u = 0;
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    const auto number = static_cast<std::size_t>(axis_of[i]);
    if (axis_of[i] < 0 || number >= axes.size()) continue;
    const Axis& axis = axes[number];
    if (axis.task != Task::coordinated) continue;
    Axis tried = axis;  // what stops it is its own affair
    tried.carry((beyond[i] ? beyond[i]->travel : target[i]) - tried.travel_pulses, tick, here[number]);
    if (tried.task == Task::coordinated) continue;
    const double from_u = run.began_at(gone, tick);
    const double along_u = along_where(i, tried.travel_pulses, axis.travel_pulses, gone, from_u,
                                       beyond[i] ? beyond[i]->along_u : gone.to_u);
    if (stopped.any && along_u > first_u) continue;
    if (!stopped.any || along_u < first_u) {
      stopped = {.place = run.place_on(gone, along_u), .any = true, .at_once = along_u <= from_u};
    }
    stopped.there[i] = true;
    first_u = along_u;
  }
  return stopped;
}

/// If an axis meets on its way what it has to slow down for, the path does so from that place on.
void Coordinated::slow_within(Targets& target, PathRun::Stretch& gone, Tick tick, std::span<const Axis> axes,
                              std::span<const Surroundings> here) {
  if (slowing_for != Cause::none || run.paused() || gone.chain_is_over) return;
  const Excursions beyond = excursions(target, gone, tick, axes);
  const double from_u = run.began_at(gone, tick);
  double first_u = gone.to_u;
  Cause why = Cause::none;
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    const auto number = static_cast<std::size_t>(axis_of[i]);
    if (axis_of[i] < 0 || number >= axes.size()) continue;
    const Axis& axis = axes[number];
    if (axis.task != Task::coordinated || axis.slowing) continue;
    const std::int64_t all = (beyond[i] ? beyond[i]->travel : target[i]) - axis.travel_pulses;
    const auto slows_by = [&](std::int64_t pulses) {
      Axis tried = axis;
      tried.carry(pulses, tick, here[number]);
      return tried.task == Task::coordinated && tried.slowing ? tried.cause : Cause::none;
    };
    const Cause its = slows_by(all);
    if (its == Cause::none) continue;
    std::int64_t least = 0;  // the first of its pulses by which it slows down
    for (std::int64_t most = all; least != most;) {
      const std::int64_t middle = least + (most - least) / 2;
      if (slows_by(middle) != Cause::none) {
        most = middle;
      } else {
        least = middle + (all < 0 ? -1 : +1);
      }
    }
    const double along_u = along_where(i, axis.travel_pulses + least, axis.travel_pulses, gone, from_u,
                                       beyond[i] ? beyond[i]->along_u : gone.to_u);
    if (why != Cause::none && along_u >= first_u) continue;
    first_u = along_u;
    why = its;
  }
  if (why == Cause::none || !run.pause_within(tick, first_u, gone)) return;
  slowing_for = why;
  const Point place = run.place_on(gone, gone.to_u);
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    if (axis_of[i] >= 0) target[i] = travel_at(i, place[static_cast<Eigen::Index>(i)]);
  }
}

/// Takes each axis to its target and gives what ended the motion of one, or Cause::none.
Cause Coordinated::carry(Targets target, const PathRun::Stretch& gone, Tick tick, std::span<Axis> axes,
                         std::span<const Surroundings> here, std::span<std::int64_t> pulses) {
  const Excursions beyond = excursions(target, gone, tick, axes);
  const Stopped stopped = first_stopped(target, beyond, gone, tick, axes, here);
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
      Events before = 0;
      if (beyond[i] && !stopped.any) {
        pulses[number] += axis->carry(beyond[i]->travel - axis->travel_pulses, tick, here[number]);
        before = axis->events;
      } else if (beyond[i] && stopped.there[i]) {
        target[i] = beyond[i]->travel;  // on its way there
      }
      if (axis->task == Task::coordinated) {
        pulses[number] += axis->carry(target[i] - axis->travel_pulses, tick, here[number]);
      }
      axis->events = static_cast<Events>(axis->events | before);
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
  bool has_edges_near = false;
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    const Axis* axis = axis_at(axis_of[i], axes);
    if (axis == nullptr) continue;
    target[i] = travel_at(i, place[static_cast<Eigen::Index>(i)]);
    is_quiet = is_quiet && !axis->slowing && target[i] >= axis->watch_low && target[i] <= axis->watch_high &&
               axis->carries_quietly(here[static_cast<std::size_t>(axis_of[i])]);
    has_edges_near = has_edges_near || is_near_edge(*axis, target[i]);
  }
  if (is_quiet && has_edges_near) [[unlikely]]
    is_quiet = !comes_back(target, gone, tick, axes);
  Cause ended_by = Cause::none;
  if (is_quiet) [[likely]] {
    for (std::size_t i = 0; i < axis_of.size(); ++i) {
      Axis* axis = axis_at(axis_of[i], axes);
      if (axis == nullptr) continue;
      pulses[static_cast<std::size_t>(axis_of[i])] += axis->carry_across(target[i] - axis->travel_pulses);
    }
  } else {
    slow_within(target, gone, tick, axes, here);
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
