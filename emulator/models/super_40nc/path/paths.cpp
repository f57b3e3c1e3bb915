// A path has one profile along its length, with the smallest slope of its axes (《C11./C12.》 to 《C22.》),
// and no axis exceeds its X12. The feed override takes effect immediately.
#include "emulator/models/super_40nc/path/paths.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/marks.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/move.h"
#include "motion/path.h"
#include "motion/path_limits.h"
#include "motion/path_run.h"
#include "motion/shared_tick.h"

namespace understudy::emulator::models::super_40nc {

namespace {

double pulses_per_lu(const Settings& settings, int axis) { return settings.scale(axis).pulses_per_unit(); }

}  // namespace

/// Returns F, scaled by D8005. If F is not above 0, returns the minimum feed.
double Paths::path_feed() const {
  const double feed = std::max<std::int32_t>(state_.path_feed_lu_s, 1);
  return feed * state_.path_feed_scale * parts_.drives.override_percent() / 100;
}

/// Returns the LU along a path per unit of F.
double Paths::feed_scale(const motion::Path& path) const {
  static constexpr std::array<double, 4> kUnits{0.001, 0.01, 0.1, 1};
  const bool goes_by_decimals = chose(option("feed_unit", "0_001_mm_by_the_decimals_of_x"));
  const double unit =
      goes_by_decimals ? kUnits[static_cast<std::size_t>(registers().of(stored_x(d9x::kDotPosition)))] : 1.0;
  const motion::Point travel = path.end - path.begin;
  const double of_xyz = travel.head<3>().norm();
  const bool carries_u = travel[3] != 0 && of_xyz > 0 && chose(option("vector_feed", "u_is_carried_along"));
  return carries_u ? unit * travel.norm() / of_xyz : unit;
}

Grant Paths::ask_for_path(const std::array<bool, kAxisCount>& takes) {
  Grant worst = Grant::starts;
  for (int number = 0; number < kAxisCount; ++number) {
    if (!takes[static_cast<std::size_t>(number)]) continue;
    const Grant given = granted(axis(number).holder, Request::line);
    if (given == Grant::waits) return Grant::waits;
    if (given == Grant::refused) worst = Grant::refused;
  }
  if (worst == Grant::refused) ground_.report(Code::axis_taken, Mover::c);
  return worst;
}

/// Returns why an axis cannot start a path: it is at a limit, and the path moves towards that limit.
motion::Cause Paths::blocked_on_path(int axis_number, const motion::Path& path) const {
  if (const motion::Cause why = parts_.starts.blocked_both_ways(axis_number); why != motion::Cause::none)
    return why;
  constexpr double kFirstPart = 1e-3;  // an arc may begin perpendicular to the axis
  const double ahead = path.at(path.length_u * kFirstPart)[axis_number] - path.begin[axis_number];
  if (ahead == 0) return chip(axis_number).forbidden_anywhere();
  return chip(axis_number).forbidden(ahead > 0 ? +1 : -1);
}

/// Prepares the axes of a path, and returns its speed law, in which the limit of each axis applies to its own
/// direction.
motion::SpeedLaw Paths::prepare_axes(const PathPlan& plan, motion::Coordinated& path) {
  const Settings settings = registers();
  motion::Point max;
  max.setConstant(std::numeric_limits<double>::infinity());
  double target_lu_s = std::numeric_limits<double>::infinity();
  double fastest_pps = 0;
  double longest = 0;  // the maximum number of pulses of an axis per LU of the path
  const auto number_of = [&](StoredRegister kept) { return static_cast<double>(settings.of(kept)); };
  const bool goes_by_longest = chose(option("path_law", "slope_of_the_longest_axis"));
  double fastest_ppu = 1;
  const motion::Point direction = motion::greatest_direction(plan.path);
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    if (!plan.takes[n]) continue;
    parts_.starts.prepare(number);
    const double ppu = pulses_per_lu(settings, number);
    path.axis_of[n] = static_cast<std::int8_t>(number);
    path.scale[n] = settings.scale(number);
    max[number] = settings.top_pps(number) / ppu;
    const double share = direction[number];
    if (share <= 0) continue;
    const double slope_lu_s = settings.pps(number, number_of(stored_d(d9::kTargetSpeed))) / ppu;
    if (!goes_by_longest) target_lu_s = std::min(target_lu_s, slope_lu_s);
    if (goes_by_longest && share * ppu > longest) target_lu_s = slope_lu_s;
    longest = std::max(longest, share * ppu);
    const double pps = share * std::max(state_.path_feed_lu_s, 1) * state_.path_feed_scale * ppu;
    if (pps > fastest_pps) {
      fastest_pps = pps;
      fastest_ppu = ppu;
    }
  }
  state_.path_limit_lu_s = motion::speed_within(plan.path, max);
  const double top = std::max(std::min(path_feed(), state_.path_limit_lu_s), 1e-3);
  const double step_lu_s = multiplier_of(std::max(fastest_pps, 1.0)) / fastest_ppu;
  return law_by(0, top, target_lu_s, number_of(stored_d(d9::kAccelerationTime)),
                settings.down_ms(number_of(stored_d(d9::kDecelerationTime)),
                                 number_of(stored_d(d9::kAccelerationTime))),
                number_of(stored_d(d9::kSAcceleration)) * step_lu_s,
                number_of(stored_d(d9::kSDeceleration)) * step_lu_s);
}

/// Returns true if a limit or an alarm of one of its axes forbids the path.
bool Paths::is_blocked(const PathPlan& plan) {
  bool is_blocked = false;
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    const motion::Cause why = plan.takes[n] ? blocked_on_path(number, plan.path) : motion::Cause::none;
    if (why == motion::Cause::none) continue;
    is_blocked = axis(number).has_error = true;
    ground_.report(code_of(why), Mover::c);
  }
  return is_blocked;
}

void Paths::take_axis(int number, const PathPlan& plan, const motion::Coordinated& path,
                      const motion::SpeedLaw& law) {
  const auto n = static_cast<std::size_t>(number);
  AxisState& state = axis(number);
  state.mover = Mover::c;
  parts_.starts.begun(number, motion::Cause::none, Activity::move);
  state.awaited = true;
  state.target_lu = plan.target_lu[n];
  const std::int64_t end = path.travel_at(n, plan.path.end[number]);
  state.rest = {.kind = RestKind::path, .travel = end};
  motion::SpeedLaw its_law = law;
  const motion::Point direction = motion::greatest_direction(plan.path);
  const double share = std::max(direction[number], 1e-9) * pulses_per_lu(registers(), number);
  its_law.top_speed_u_s *= share;
  its_law.up.acceleration_u_s2 *= share;
  its_law.down.acceleration_u_s2 *= share;
  parts_.starts.mirror_start(number, plan.mode, end - chip(number).travel_pulses, its_law);
}

bool Paths::begin_path(const PathPlan& plan) {
  const bool takes_default = plan.feed_lu_per_s <= 0 && chose(option("feed_not_positive", "default_feed"));
  state_.path_feed_lu_s = takes_default ? registers().raw(stored_d(d9::kSystemSpeed)) : plan.feed_lu_per_s;
  state_.path_feed_scale = feed_scale(plan.path);
  motion::Coordinated path;
  const motion::SpeedLaw law = prepare_axes(plan, path);
  path.run.append(plan.path, {}, before_motion());
  path.run.set_speed(law, before_motion());
  if (is_blocked(plan) || path.begin(plan.path.begin, axes_.chips, before_motion()) != motion::Cause::none) {
    return false;
  }
  for (int number = 0; number < kAxisCount; ++number) {
    if (plan.takes[static_cast<std::size_t>(number)]) take_axis(number, plan, path, law);
  }
  axes_.path = path;
  axes_.path_is_held = false;
  backlash_.begin_path_backlash(plan.path);
  apply_override();
  return true;
}

bool Paths::joins_paths() const {
  namespace language = interpreter::super_40nc;
  const bool may_join =
      ground_.language_options().chose(language::option("continuous_path", "corners_are_run_through"));
  return may_join && axes_.path.engaged && registers().is_on(stored_d(d9::kContinuousPath));
}

bool Paths::has_room_on_path(const std::array<bool, kAxisCount>& takes) const {
  for (int number = 0; number < kAxisCount; ++number) {
    if (takes[static_cast<std::size_t>(number)] != is_on_path(number)) return false;
  }
  return !axes_.path_is_held && axes_.path.slowing_for == motion::Cause::none && axes_.path.run.queued() <= 1;
}

/// Appends a path without slowing down, whatever the corner. From now on, its own feed applies.
void Paths::join_path(const PathPlan& plan) {
  const Settings settings = registers();
  motion::Point max;
  max.setConstant(std::numeric_limits<double>::infinity());
  axes_.path.run.append(plan.path, {.rule = motion::Joint::Rule::join}, now());
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    if (!plan.takes[n]) continue;
    max[number] = settings.top_pps(number) / pulses_per_lu(settings, number);
    AxisState& state = axis(number);
    state.target_lu = plan.target_lu[n];
    state.rest.travel = axes_.path.travel_at(n, plan.path.end[number]);
  }
  state_.path_feed_lu_s = std::max<std::int32_t>(plan.feed_lu_per_s, 1);
  state_.path_feed_scale = feed_scale(plan.path);
  state_.path_limit_lu_s = std::min(state_.path_limit_lu_s, motion::speed_within(plan.path, max));
  apply_override();
}

std::int64_t Paths::path_base_lu(int axis_number) const {
  return joins_paths() && is_on_path(axis_number) ? axis(axis_number).target_lu
                                                  : relative_base_lu(axis_number);
}

void Paths::apply_override() {
  if (chose(option("override_scope", "drv_as_well"))) {
    for (int number = 0; number < kAxisCount; ++number) {
      const AxisState& state = axis(number);
      const bool drives =
          state.holder == Activity::move && state.rest.kind == RestKind::move && !state.is_held;
      if (drives)
        chip(number).change_speed(parts_.drives.drive_law(number, state.rest.rpm, state.mover), now());
    }
  }
  if (!axes_.path.engaged) return;
  const double feed = path_feed();
  axes_.path.run.set_override(feed > 0 ? 1 : 0, now());
  if (feed > 0) axes_.path.run.set_top_speed(std::min(feed, state_.path_limit_lu_s), now());
}

void Paths::hold_path() {
  if (!axes_.path.engaged) return;
  axes_.path.run.pause(now());
  axes_.path_is_held = true;
}

void Paths::resume_path() {
  if (!axes_.path.engaged || !axes_.path_is_held) return;
  axes_.path_is_held = false;
  for (int number = 0; number < kAxisCount; ++number) {
    if (is_on_path(number)) axis(number).holder = Activity::move;
  }
  if (!backlash_.awaits_path()) axes_.path.run.resume(now());
}

void Paths::slow_path() { axes_.path.slow_down(now()); }

void Paths::stop_path() {
  std::array<bool, kAxisCount> took{};
  for (int number = 0; number < kAxisCount; ++number) {
    took[static_cast<std::size_t>(number)] = is_on_path(number);
  }
  axes_.path.stop(axes_.chips, motion::Cause::stopped);
  axes_.path = {};
  axes_.path_is_held = false;
  for (AxisState& state : axes_.axes) take_off(state, MarkEvent::path_ends);
  for (int number = 0; number < kAxisCount; ++number) {
    if (!took[static_cast<std::size_t>(number)]) continue;
    forget_end(number);
    axis(number).has_ended = true;
    parts_.starts.let_go(number);
  }
}

void Paths::step_axes(Tick tick, std::array<std::int64_t, kAxisCount>& sent) {
  const bool has_path = axes_.path.engaged;
  if (has_path) backlash_.step_path_backlash(tick, sent);
  std::array<std::int8_t, kAxisCount> directions{};
  std::uint32_t singles = 0;
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    directions[n] = axes_.chips[n].last_direction;
    if (!is_on_path(number)) singles |= 1U << n;
  }
  motion::step_together({.tick = tick,
                         .axes = axes_.chips,
                         .environment = axes_.environment,
                         .pulses = sent,
                         .watched = parts_.edges.watched()},
                        singles, &axes_.path, &parts_.edges);
  if (!has_path) return;
  if (chose(option("backlash_scope", "also_where_an_arc_turns_round"))) {
    backlash_.step_arc_backlash(directions, sent);
  }
  if (!axes_.path.engaged || !axes_.path_is_held || !axes_.path.run.at_rest(tick)) return;
  for (int number = 0; number < kAxisCount; ++number) {
    if (is_on_path(number)) axis(number).holder = Activity::rest;
  }
}

std::optional<motion::Cause> Paths::path_ended() {
  const motion::Cause why = axes_.path.cause;
  const bool has_arrived = why == motion::Cause::arrived;
  const Code code = code_of(why);
  for (int number = 0; number < kAxisCount; ++number) {
    AxisState& state = axis(number);
    take_off(state, MarkEvent::path_ends);
    if (state.rest.kind != RestKind::path) continue;
    forget_end(number);
    state.has_ended = true;
    if (code != Code::none && chip(number).cause == why) parts_.starts.fail(number, code);
    parts_.starts.let_go(number);
    state.stands_on_target = has_arrived && distance_to(number, state.target_lu) == 0;
  }
  axes_.path = {};
  axes_.path_is_held = false;
  ground_.touch();
  if (has_arrived) ground_.show_finished(kPathSignal);
  return code == Code::none ? std::nullopt : std::optional(why);
}

}  // namespace understudy::emulator::models::super_40nc
