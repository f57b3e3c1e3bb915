#include "motion/path_tick.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "motion/axis.h"
#include "motion/axis_tick.h"
#include "motion/bisection.h"
#include "motion/coordinated.h"
#include "motion/move.h"
#include "motion/pulse_drive.h"
#include "motion/tick.h"

namespace understudy::motion {

PathTick::PathTick(Coordinated& path, const Coordinated::Ahead& ahead, Tick tick, std::span<Axis> axes,
                   const Parts& parts, bool stays_engaged)
    : path_(path),
      gone_(ahead.gone),
      target_(ahead.target),
      tick_(tick),
      axes_(axes),
      parts_(parts),
      at_{.tick = tick - 1},
      along_u_(std::min(path.run.began_at(ahead.gone, tick), ahead.gone.to_u)),
      ends_in_it_(path.is_over(stays_engaged)) {
  check_axes();
}

const Instant& PathTick::next() {
  if (!is_found_) find_next();
  return moment_;
}

void PathTick::find_next() {
  is_found_ = true;
  moment_ = {.tick = tick_};
  edge_u_.reset();
  if (!path_.engaged) return;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto beyond_u = first_beyond(i);
    if (beyond_u && (!edge_u_ || *beyond_u < *edge_u_)) edge_u_ = beyond_u;
  }
  const bool ends = ends_in_it_ && gone_.course && !edge_u_;
  if (!edge_u_ && !ends) return;
  const Instant found = path_.run.moment_at(gone_, tick_, edge_u_.value_or(gone_.to_u));
  moment_ = is_before(found, at_) ? at_ : found;
}

/// Returns the first place on the rest of the path at which an axis leaves its watch window.
std::optional<double> PathTick::first_beyond(std::size_t i) const {
  const Axis* const mine = axis(i);
  if (mine == nullptr || mine->task != Task::coordinated || mine->settling) return std::nullopt;
  parts_[i]->watch();
  for (double from_u = along_u_; from_u < gone_.to_u;) {
    const double to_u = path_.run.end_of_span(gone_, from_u);
    // Within a span, a coordinate may reverse once.
    const auto axis_number = static_cast<Eigen::Index>(i);
    const double direction = path_.run.direction_at(gone_, from_u, axis_number);
    const double before_u = std::nextafter(to_u, 0.0);
    const auto has_turned = [&](double along_u) {
      return direction * path_.run.direction_at(gone_, along_u, axis_number) < 0;
    };
    if (before_u > from_u && has_turned(before_u)) {
      const double turn_u = turnover(from_u, before_u, has_turned).after;
      if (const auto found = first_beyond(i, from_u, turn_u)) return found;
      from_u = turn_u;
    }
    if (const auto found = first_beyond(i, from_u, to_u)) return found;
    from_u = to_u;
  }
  return std::nullopt;
}

/// Like first_beyond(i), on a stretch on which the coordinate keeps its direction.
std::optional<double> PathTick::first_beyond(std::size_t i, double from_u, double to_u) const {
  const Axis& mine = *axis(i);
  const auto travel = [&](double along_u) {
    // At the end of the tick, the axis is at the position determined by the run.
    if (along_u >= gone_.to_u) return target_[i];
    return path_.travel_at(i, path_.run.place_on(gone_, along_u)[static_cast<Eigen::Index>(i)]);
  };
  const std::int64_t last = travel(to_u);
  if (last >= mine.watch_low && last <= mine.watch_high) return std::nullopt;
  const auto is_beyond = [&](double along_u) {
    return last > mine.watch_high ? travel(along_u) > mine.watch_high : travel(along_u) < mine.watch_low;
  };
  return is_beyond(from_u) ? from_u : turnover(from_u, to_u, is_beyond).after;
}

/// Moves all axes to their places at `along_u`. The axes handle everything in between.
void PathTick::carry_to(double along_u, Instant at) {
  along_u_ = along_u;
  at_ = at;
  const bool is_all = along_u >= gone_.to_u;
  const Point place = is_all ? Point(Point::Zero()) : path_.run.place_on(gone_, along_u);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Axis* const mine = axis(i);
    if (mine == nullptr || mine->task != Task::coordinated) continue;
    const std::int64_t target = is_all ? target_[i] : path_.travel_at(i, place[static_cast<Eigen::Index>(i)]);
    parts_[i]->go_by(target - mine->travel_pulses, at);
  }
  is_found_ = false;
}

/// Handles what has happened to the axes. An axis that is stopped stops all axes here; an axis that must slow
/// down slows down the path.
void PathTick::check_axes() {
  if (!path_.engaged) return;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Axis* const mine = axis(i);
    if (mine == nullptr || mine->task == Task::coordinated) continue;
    const bool arrived = mine->task == Task::none && mine->cause == Cause::arrived;
    if (!arrived) return path_.stop(axes_, mine->cause == Cause::none ? Cause::stopped : mine->cause, at_);
  }
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Axis* const mine = axis(i);
    if (mine != nullptr && mine->task == Task::coordinated && mine->slowing) {
      slow_down(mine->cause, path_.run.speed());
    }
  }
}

void PathTick::step_events() {
  const Instant at = next();
  const auto edge_u = edge_u_;
  carry_to(edge_u.value_or(gone_.to_u), at);
  check_axes();
  if (edge_u) return;
  is_over_ = true;
  if (path_.engaged && ends_in_it_ && path_.is_over(false)) path_.let_go(axes_, at);
}

double PathTick::along_at(const Instant& at) const {
  const double along_u = std::clamp(path_.run.along_at(gone_, at), along_u_, std::max(gone_.to_u, along_u_));
  // Rounding must not carry an axis over the next edge.
  return edge_u_ ? std::min(along_u, *edge_u_) : along_u;
}

std::int64_t PathTick::travel_at(std::size_t i, const Instant& at) const {
  const Axis* const mine = axis(i);
  if (!path_.engaged || is_over_ || mine->task != Task::coordinated) return mine->travel_pulses;
  const double along_u = along_at(at);
  if (along_u >= gone_.to_u) return target_[i];
  return path_.travel_at(i, path_.run.place_on(gone_, along_u)[static_cast<Eigen::Index>(i)]);
}

void PathTick::go_to(Instant at) {
  if (!path_.engaged || is_over_) return;
  carry_to(along_at(at), at);
  check_axes();
}

void PathTick::slow_down(Cause why, const SpeedLaw& by) {
  if (!path_.engaged || path_.slowing_for != Cause::none) return;
  path_.slowing_for = why;
  if (!path_.run.pause_within(tick_, along_u_, by, gone_)) {
    path_.run.pause(tick_);
    return;
  }
  ends_in_it_ = false;
  const Point place = path_.run.place_on(gone_, gone_.to_u);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    target_[i] = path_.travel_at(i, place[static_cast<Eigen::Index>(i)]);
  }
  is_found_ = false;
}

}  // namespace understudy::motion
