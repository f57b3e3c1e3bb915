#include "motion/coordinated.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/path.h"
#include "motion/shared_tick.h"
#include "motion/tick.h"
#include "motion/unit_scale.h"

namespace understudy::motion {

namespace {

/// Rounds half away from zero, and saturates at 1e18.
std::int64_t nearest(double value) {
  const double size = std::abs(value);
  const auto whole = size < 1e18 ? static_cast<std::int64_t>(size + 0.5) : 1'000'000'000'000'000'000;
  return value < 0 ? -whole : whole;
}

/// Rounds towards zero, but a value that is just below a whole pulse because of rounding errors counts as
/// that pulse.
std::int64_t whole(double value) {
  constexpr double kAlmost = 1e-6;
  const double size = std::min(std::abs(value) + kAlmost, 1e18);
  return static_cast<std::int64_t>(value < 0 ? -size : size);
}

/// Returns null for kNone, and for an axis outside the span.
template <class AnyAxis>
AnyAxis* axis_at(std::int8_t number, std::span<AnyAxis> axes) {
  const bool there = number >= 0 && static_cast<std::size_t>(number) < axes.size();
  return there ? &axes[static_cast<std::size_t>(number)] : nullptr;
}

/// Within a tick, no path goes further than this before it reverses.
constexpr double kFarthestTurn_pulses = 1'000'000;

/// Returns true if an axis may leave its watch window and return within the tick, at the turning point of an
/// arc.
bool may_turn_beyond(const Axis& axis, std::int64_t travel, double reach_pulses) {
  const auto reach = static_cast<std::int64_t>(std::min(reach_pulses, 1e15));
  return travel > axis.watch_high - reach || travel < axis.watch_low + reach;
}

}  // namespace

std::int64_t Coordinated::travel_at(std::size_t i, double place_u) const {
  const UnitScale& by = scale[i];
  // Most units are one pulse, and even dividing by 1 takes time.
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
  run.stand_at(from);  // this statement and the next may throw
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

Coordinated::Ahead Coordinated::look_ahead(Tick tick, std::span<const Axis> axes,
                                           std::span<const Environment> environment, bool stays_engaged) {
  Ahead ahead;
  const Point& place = run.step(tick, &ahead.gone);
  ahead.is_quiet = !is_over(stays_engaged);
  const bool bends = run.bends(ahead.gone) || run.completed() > 0;
  bool has_edges_near = false;
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    const Axis* axis = axis_at(axis_of[i], axes);
    if (axis == nullptr) continue;
    const std::int64_t target = ahead.target[i] = travel_at(i, place[static_cast<Eigen::Index>(i)]);
    ahead.is_quiet = ahead.is_quiet && !axis->slowing && target >= axis->watch_low &&
                     target <= axis->watch_high &&
                     axis->carries_quietly(environment[static_cast<std::size_t>(axis_of[i])]);
    has_edges_near = has_edges_near || (bends && may_turn_beyond(*axis, target, kFarthestTurn_pulses));
  }
  if (!ahead.is_quiet || !has_edges_near) [[likely]]
    return ahead;
  // If the length is measured along the longest axis, the path is up to 1.8 times as long.
  const double length_u = 2 * std::max(0.0, ahead.gone.to_u - run.began_at(ahead.gone, tick));
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    const Axis* axis = axis_at(axis_of[i], axes);
    const double reach_pulses = length_u * std::abs(scale[i].pulses_per_unit()) + 2;
    if (axis != nullptr && may_turn_beyond(*axis, ahead.target[i], reach_pulses)) ahead.is_quiet = false;
  }
  return ahead;
}

void Coordinated::fast_forward(const Ahead& ahead, std::span<Axis> axes, std::span<std::int64_t> pulses) {
  for (std::size_t i = 0; i < axis_of.size(); ++i) {
    Axis* axis = axis_at(axis_of[i], axes);
    if (axis == nullptr) continue;
    pulses[static_cast<std::size_t>(axis_of[i])] += axis->carry_across(ahead.target[i] - axis->travel_pulses);
  }
}

void Coordinated::step(Tick tick, std::span<Axis> axes, std::span<const Environment> environment,
                       std::span<std::int64_t> pulses, bool stays_engaged) {
  step_together({.tick = tick, .axes = axes, .environment = environment, .pulses = pulses}, 0, this, nullptr,
                stays_engaged);
}

void Coordinated::settle(Tick tick, std::span<Axis> axes) {
  if (engaged && slowing_for != Cause::none && run.at_rest(tick)) stop(axes, slowing_for, {.tick = tick});
}

void Coordinated::let_go(std::span<Axis> axes, Instant at) {
  bool settling = false;
  for (const std::int8_t mine : axis_of) {
    Axis* axis = axis_at(mine, axes);
    if (axis == nullptr) continue;
    axis->arrive(at);
    settling = settling || axis->task == Task::coordinated;
  }
  if (settling) return;
  engaged = false;
  cause = Cause::arrived;
  run.abandon();
}

void Coordinated::slow_down(Tick now, Cause why) {
  if (!engaged || slowing_for != Cause::none) return;
  slowing_for = why;
  run.pause(now);
}

void Coordinated::stop(std::span<Axis> axes, Cause why, Instant at) {
  if (!engaged) return;
  engaged = false;
  cause = why;
  run.abandon();
  for (const std::int8_t mine : axis_of) {
    Axis* axis = axis_at(mine, axes);
    if (axis != nullptr && axis->task == Task::coordinated) axis->stop(why, at);
  }
}

}  // namespace understudy::motion
