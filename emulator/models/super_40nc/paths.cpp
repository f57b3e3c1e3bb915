// LIN and arcs of the C program: one profile along the path, with the least slope among its axes
// (《C11./C12.》 to 《C22.》), no faster than X12 of any axis, and the feed override at once.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/simulated_time.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/marks.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/ownership.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "emulator/models/super_40nc/settings.h"
#include "interpreter/super_40nc/events.h"
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

/// Returns D8005 within its limits.
double Super40nc::override_percent() const {
  constexpr double kMax = 100;
  const auto percent = static_cast<double>(registers().of(kept_d(d8::kFeedPercentage)));
  return chose(option("override_range", "0_to_100")) ? std::min(percent, kMax) : percent;
}

/// Returns F, scaled by D8005; a feed that is not above 0 is the least feed.
double Super40nc::path_feed() const {
  const double feed = std::max<std::int32_t>(state_.path_feed_lu_s, 1);
  return feed * state_.path_feed_scale * override_percent() / 100;
}

/// Returns the LU along a path for a unit of F.
double Super40nc::feed_scale(const motion::Path& path) const {
  static constexpr std::array<double, 4> kUnits{0.001, 0.01, 0.1, 1};
  const bool goes_by_decimals = chose(option("feed_unit", "0_001_mm_by_the_decimals_of_x"));
  const double unit =
      goes_by_decimals ? kUnits[static_cast<std::size_t>(registers().of(kept_x(d9x::kDotPosition)))] : 1.0;
  const motion::Point way = path.end - path.begin;
  const double of_xyz = way.head<3>().norm();
  const bool carries_u = way[3] != 0 && of_xyz > 0 && chose(option("vector_feed", "u_is_carried_along"));
  return carries_u ? unit * way.norm() / of_xyz : unit;
}

Grant Super40nc::ask_for_path(const std::array<bool, kAxisCount>& takes) {
  Grant worst = Grant::starts;
  for (int number = 0; number < kAxisCount; ++number) {
    if (!takes[static_cast<std::size_t>(number)]) continue;
    const Grant given = granted(axis(number).holder, Request::line);
    if (given == Grant::waits) return Grant::waits;
    if (given == Grant::refused) worst = Grant::refused;
  }
  if (worst == Grant::refused) report(Code::axis_taken, Mover::c);
  return worst;
}

/// Returns why an axis may not begin a path: it stands on a limit into which the path goes.
motion::Cause Super40nc::blocked_on_path(int axis_number, const motion::Path& path) const {
  if (const motion::Cause why = blocked_both_ways(axis_number); why != motion::Cause::none) return why;
  constexpr double kFirstPart = 1e-3;  // an arc may begin perpendicular to the axis
  const double ahead = path.at(path.length_u * kFirstPart)[axis_number] - path.begin[axis_number];
  if (ahead == 0) return chip(axis_number).forbidden_anywhere();
  return chip(axis_number).forbidden(ahead > 0 ? +1 : -1);
}

bool Super40nc::begin_path(const PathPlan& plan) {
  const Settings settings = registers();
  const bool takes_default = plan.feed_lu_per_s <= 0 && chose(option("feed_not_positive", "default_feed"));
  state_.path_feed_lu_s = takes_default ? settings.raw(kept_d(d9::kSystemSpeed)) : plan.feed_lu_per_s;
  motion::Coordinated path;
  state_.path_feed_scale = feed_scale(plan.path);
  // The limit of each axis along its own direction, in LU a second, and its acceleration.
  motion::Point most;
  most.setConstant(std::numeric_limits<double>::infinity());
  double target_lu_s = std::numeric_limits<double>::infinity();
  double fastest_pps = 0;
  double longest = 0;  // pulses of an axis for a LU of the path
  const auto number_of = [&](Kept kept) { return static_cast<double>(settings.of(kept)); };
  const bool goes_by_longest = chose(option("path_law", "slope_of_the_longest_axis"));
  double fastest_ppu = 1;
  const motion::Point direction = motion::greatest_direction(plan.path);
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    if (!plan.takes[n]) continue;
    prepare(number);
    const double ppu = pulses_per_lu(settings, number);
    path.axis_of[n] = static_cast<std::int8_t>(number);
    path.scale[n] = settings.scale(number);
    most[number] = settings.top_pps(number) / ppu;
    const double share = direction[number];
    if (share <= 0) continue;
    const double slope_lu_s = settings.pps(number, number_of(kept_d(d9::kTargetSpeed))) / ppu;
    if (!goes_by_longest) target_lu_s = std::min(target_lu_s, slope_lu_s);
    if (goes_by_longest && share * ppu > longest) target_lu_s = slope_lu_s;
    longest = std::max(longest, share * ppu);
    const double pps = share * std::max(state_.path_feed_lu_s, 1) * state_.path_feed_scale * ppu;
    if (pps > fastest_pps) {
      fastest_pps = pps;
      fastest_ppu = ppu;
    }
  }
  state_.path_limit_lu_s = motion::speed_within(plan.path, most);
  const double top = std::max(std::min(path_feed(), state_.path_limit_lu_s), 1e-3);
  const double step_lu_s = multiplier_of(std::max(fastest_pps, 1.0)) / fastest_ppu;
  const motion::SpeedLaw law = law_by(
      0, top, target_lu_s, number_of(kept_d(d9::kAccelerationTime)),
      settings.down_ms(number_of(kept_d(d9::kDecelerationTime)), number_of(kept_d(d9::kAccelerationTime))),
      number_of(kept_d(d9::kSAcceleration)) * step_lu_s, number_of(kept_d(d9::kSDeceleration)) * step_lu_s);
  path.run.append(plan.path, {}, before_motion());
  path.run.set_speed(law, before_motion());
  bool is_blocked = false;
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    const motion::Cause why = plan.takes[n] ? blocked_on_path(number, plan.path) : motion::Cause::none;
    if (why == motion::Cause::none) continue;
    is_blocked = axis(number).has_error = true;
    report(code_of(why), Mover::c);
  }
  if (is_blocked || path.begin(plan.path.begin, state_.chips, before_motion()) != motion::Cause::none) {
    return false;
  }
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    if (!plan.takes[n]) continue;
    AxisState& state = axis(number);
    state.mover = Mover::c;
    begun(number, motion::Cause::none, Activity::move);
    state.awaited = true;
    state.target_lu = plan.target_lu[n];
    const std::int64_t end = path.travel_at(n, plan.path.end[number]);
    state.rest = {.kind = RestKind::path, .travel = end};
    motion::SpeedLaw its_law = law;
    const double share = std::max(direction[number], 1e-9) * pulses_per_lu(settings, number);
    its_law.top_speed_u_s *= share;
    its_law.up.acceleration_u_s2 *= share;
    its_law.down.acceleration_u_s2 *= share;
    mirror_start(number, plan.mode, end - chip(number).travel_pulses, its_law);
  }
  state_.path = path;
  state_.path_is_held = false;
  begin_path_backlash(plan.path);
  apply_override();
  return true;
}

bool Super40nc::joins_paths() const {
  return options_.joins_paths && state_.path.engaged && registers().is_on(kept_d(d9::kContinuousPath));
}

bool Super40nc::has_room_on_path(const std::array<bool, kAxisCount>& takes) const {
  for (int number = 0; number < kAxisCount; ++number) {
    if (takes[static_cast<std::size_t>(number)] != is_on_path(number)) return false;
  }
  return !state_.path_is_held && state_.path.slowing_for == motion::Cause::none &&
         state_.path.run.queued() <= 1;
}

/// Appends a path without slowing down, whatever the corner; its own feed applies from now on.
void Super40nc::join_path(const PathPlan& plan) {
  const Settings settings = registers();
  motion::Point most;
  most.setConstant(std::numeric_limits<double>::infinity());
  state_.path.run.append(plan.path, {.rule = motion::Joint::Rule::join}, now());
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    if (!plan.takes[n]) continue;
    most[number] = settings.top_pps(number) / pulses_per_lu(settings, number);
    AxisState& state = axis(number);
    state.target_lu = plan.target_lu[n];
    state.rest.travel = state_.path.travel_at(n, plan.path.end[number]);
  }
  state_.path_feed_lu_s = std::max<std::int32_t>(plan.feed_lu_per_s, 1);
  state_.path_feed_scale = feed_scale(plan.path);
  state_.path_limit_lu_s = std::min(state_.path_limit_lu_s, motion::speed_within(plan.path, most));
  apply_override();
}

std::int64_t Super40nc::path_base_lu(int axis_number) const {
  return joins_paths() && is_on_path(axis_number) ? axis(axis_number).target_lu
                                                  : relative_base_lu(axis_number);
}

void Super40nc::apply_override() {
  if (chose(option("override_scope", "drv_as_well"))) {
    for (int number = 0; number < kAxisCount; ++number) {
      const AxisState& state = axis(number);
      const bool drives =
          state.holder == Activity::move && state.rest.kind == RestKind::move && !state.is_held;
      if (drives) chip(number).change_speed(drive_law(number, state.rest.rpm, state.mover), now());
    }
  }
  if (!state_.path.engaged) return;
  const double feed = path_feed();
  state_.path.run.set_override(feed > 0 ? 1 : 0, now());
  if (feed > 0) state_.path.run.set_top_speed(std::min(feed, state_.path_limit_lu_s), now());
}

void Super40nc::hold_path() {
  if (!state_.path.engaged) return;
  state_.path.run.pause(now());
  state_.path_is_held = true;
}

void Super40nc::go_on_path() {
  if (!state_.path.engaged || !state_.path_is_held) return;
  state_.path_is_held = false;
  for (int number = 0; number < kAxisCount; ++number) {
    if (is_on_path(number)) axis(number).holder = Activity::move;
  }
  if (!awaits_path()) state_.path.run.resume(now());
}

/// VDRV 0: slows down by the path's ramp, and ends.
void Super40nc::slow_path() { state_.path.slow_down(now()); }

void Super40nc::stop_path() {
  std::array<bool, kAxisCount> took{};
  for (int number = 0; number < kAxisCount; ++number) {
    took[static_cast<std::size_t>(number)] = is_on_path(number);
  }
  state_.path.stop(state_.chips, motion::Cause::stopped);
  state_.path = {};
  state_.path_is_held = false;
  for (AxisState& state : state_.axes) take_off(state, MarkEvent::path_ends);
  for (int number = 0; number < kAxisCount; ++number) {
    if (!took[static_cast<std::size_t>(number)]) continue;
    forget_end(number);
    axis(number).has_ended = true;
    let_go(number);
  }
}

void Super40nc::step_axes(Tick tick, std::int32_t wheel_counts, std::array<std::int64_t, kAxisCount>& sent) {
  const bool has_path = state_.path.engaged;
  if (has_path) step_path_backlash(tick, sent);
  std::array<std::int8_t, kAxisCount> ways{};
  std::uint32_t singles = 0;
  wheel_of_tick_ = wheel_counts;
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    ways[n] = state_.chips[n].last_direction;
    counted_[n] = {.travel = state_.chips[n].travel_pulses};
    if (!is_on_path(number)) singles |= 1U << n;
  }
  motion::step_together(
      {.tick = tick, .axes = state_.chips, .environment = state_.environment, .pulses = sent}, singles,
      &state_.path, this);
  if (!has_path) return;
  if (chose(option("backlash_scope", "also_where_an_arc_turns_round"))) step_arc_backlash(ways, sent);
  if (!state_.path.engaged || !state_.path_is_held || !state_.path.run.at_rest(tick)) return;
  for (int number = 0; number < kAxisCount; ++number) {
    if (is_on_path(number)) axis(number).holder = Activity::rest;
  }
}

/// Called when the path has arrived, or an axis of it has met something.
void Super40nc::path_ended() {
  const motion::Cause why = state_.path.cause;
  const bool has_arrived = why == motion::Cause::arrived;
  const Code code = code_of(why);
  for (int number = 0; number < kAxisCount; ++number) {
    AxisState& state = axis(number);
    take_off(state, MarkEvent::path_ends);
    if (state.rest.kind != RestKind::path) continue;
    forget_end(number);
    state.has_ended = true;
    if (code != Code::none && chip(number).cause == why) fail(number, code);
    let_go(number);
    state.stands_on_target = has_arrived && distance_to(number, state.target_lu) == 0;
  }
  state_.path = {};
  state_.path_is_held = false;
  state_.touched = true;
  if (has_arrived) show_finished(kPathSignal);
  using interpreter::super_40nc::Phase;
  const Phase phase = state_.steps.programs[0].phase;
  const bool is_awaited = phase == Phase::moving || phase == Phase::held;  // false while paths are joined
  if (code != Code::none) program_broken(Mover::c, -1, is_awaited, why);
}

}  // namespace understudy::emulator::models::super_40nc
