// Motion of programs: DRV, MRK, HOM, VDRV and MPG of step programs, DRV, HOM, PJG and MJG of the PLC; how it
// is held, continued and stopped. Paths are in paths.cpp.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/ownership.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "motion/axis.h"
#include "motion/homing.h"
#include "motion/homing_tables.h"
#include "motion/move.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::super_40nc {

namespace {

constexpr int kModePositionMove = 0x41;
constexpr int kModeTurning = 0x00;
constexpr int kModeTurningBack = 0x08;

int way_of(std::int64_t distance) { return distance < 0 ? -1 : +1; }

}  // namespace

std::int64_t Super40nc::relative_base_lu(int axis_number) const {
  const AxisState& state = axis(axis_number);
  const bool goes_on = state.stands_on_target && !chose(option("relative_base", "present_position"));
  return goes_on ? state.target_lu : work_lu(axis_number);
}

std::int64_t Super40nc::distance_to(int axis_number, std::int64_t target_lu) const {
  const motion::UnitScale scale = registers().scale(axis_number);
  return scale.to_pulses(target_lu - axis(axis_number).offset_lu).value_or(0) - machine_pulses(axis_number);
}

/// Returns the law of a line: by the axis's own times, whichever program it is in.
motion::SpeedLaw Super40nc::line_law(int axis, double rpm, Mover mover) const {
  const bool is_by_times_of_c = mover == Mover::c && chose(option("drv_of_c", "c11_to_c14"));
  const Settings settings = registers();
  return is_by_times_of_c ? settings.law_of_c(axis, rpm) : settings.law(axis, rpm);
}

/// Returns the law of DRV, which the feed override does not scale unless that is chosen.
motion::SpeedLaw Super40nc::drive_law(int axis, std::int32_t rpm, Mover mover) const {
  const bool is_scaled = chose(option("override_scope", "drv_as_well"));
  return line_law(axis, is_scaled ? rpm * override_percent() / 100 : rpm, mover);
}

bool Super40nc::begin_drive(int axis_number, std::int64_t target_lu, std::int32_t rpm, Mover mover) {
  AxisState& state = axis(axis_number);
  prepare(axis_number);
  state.mover = mover;  // its line is reported in D8095 if the motion cannot begin
  const std::int64_t distance = distance_to(axis_number, target_lu);
  const motion::SpeedLaw law = drive_law(axis_number, rpm, mover);
  begun(axis_number, chip(axis_number).move(distance, law, before_motion()), Activity::move);
  if (state.holder != Activity::move) {
    state.mover = Mover::hand;
    return false;
  }
  state.target_lu = target_lu;
  mirror_start(axis_number, kModePositionMove, distance, law);
  if (distance == 0) {
    let_go(axis_number);
    state.has_ended = state.stands_on_target = true;
    if (finishes_without_motion()) show_finished(static_cast<std::size_t>(axis_number));
    return true;
  }
  state.shows_finish = true;
  state.rest = {.kind = RestKind::move, .travel = chip(axis_number).travel_pulses + distance, .rpm = rpm};
  return true;
}

/// MRK with X16 = 0: a signal on the way resets the program, as a limit would, regardless of X33 and X34.
bool Super40nc::begin_blind_mark(int axis_number, std::int64_t target_lu, std::int32_t rpm, Mover mover) {
  AxisState& state = axis(axis_number);
  if (chose(option("mark_without_distance", "a_plain_move"))) {
    return begin_drive(axis_number, target_lu, rpm, mover);
  }
  state.rest.limits_count = true;
  update_environment(axis_number);
  const bool begins = begin_drive(axis_number, target_lu, rpm, mover);
  if (state.holder == Activity::move) {
    state.rest.limits_count = true;
  } else {
    state.rest = {};
    update_environment(axis_number);
  }
  return begins;
}

bool Super40nc::begin_mark(int axis_number, std::int64_t distance, std::int64_t search, std::int32_t rpm,
                           Mover mover) {
  AxisState& state = axis(axis_number);
  const Settings settings = registers();
  state.rest = {.kind = RestKind::mark, .marks_positive = search > 0, .rpm = rpm};
  state.mover = mover;
  update_environment(axis_number);
  prepare(axis_number);
  const motion::SpeedLaw fast = line_law(axis_number, rpm, mover);
  const motion::HomingProgram program = motion::super40nc_mark(
      {.distance_pulses = distance,
       .search_pulses = search,
       .fast = fast,
       .creep = line_law(axis_number, static_cast<double>(settings.of(kept_x(d9x::kCreepSpeed), axis_number)),
                         mover),
       .slows_behind = chose(option("mrk_course", "slows_behind_the_target")),
       .looks_all_the_way = chose(option("mrk_course", "signal_before_it_counts")),
       .mark_slows = chose(option("mrk_course", "stops_by_a_ramp")),
       .needs_edge = chose(option("mark_edge", "has_to_come_anew"))});
  begun(axis_number, chip(axis_number).home(program, before_motion()), Activity::move);
  if (state.holder != Activity::move) {
    let_go(axis_number);
    return false;
  }
  mirror_start(axis_number, kModePositionMove, distance, fast);
  state.shows_finish = true;
  return true;
}

bool Super40nc::begin_turning(int axis_number, std::int32_t rpm, Mover mover) {
  AxisState& state = axis(axis_number);
  prepare(axis_number);
  state.mover = mover;
  const motion::SpeedLaw law = line_law(axis_number, std::abs(static_cast<double>(rpm)), mover);
  begun(axis_number, chip(axis_number).run(way_of(rpm), law, before_motion()), Activity::vdrv);
  if (state.holder != Activity::vdrv) {
    state.mover = Mover::hand;
    return false;
  }
  state.rest = {.kind = RestKind::turning, .rpm = rpm};
  mirror_start(axis_number, rpm < 0 ? kModeTurningBack : kModeTurning, 0, law);
  return true;
}

void Super40nc::change_turning(int axis_number, std::int32_t rpm, Mover mover) {
  AxisState& state = axis(axis_number);
  const motion::SpeedLaw law = line_law(axis_number, std::abs(static_cast<double>(rpm)), mover);
  if (!chip(axis_number).resume(law, now())) chip(axis_number).change_speed(law, now());
  state.mover = mover;
  state.rest.rpm = way_of(state.rest.rpm) * std::abs(rpm);
  state.stop_awaited_by = Mover::hand;
}

/// VDRV 0. Returns true if the axis has to come to rest first.
bool Super40nc::end_by_ramp(int axis_number, Mover mover) {
  AxisState& state = axis(axis_number);
  if (state.holder == Activity::nobody) return false;
  if (state.holder == Activity::rest || state.holder == Activity::wheel || is_on_path(axis_number)) {
    if (is_on_path(axis_number)) {
      slow_path();
    } else {
      stop_axis(axis_number);
      return false;
    }
  } else {
    chip(axis_number).slow_down(now());
  }
  state.is_held = false;
  state.stop_awaited_by = mover;
  return true;
}

/// Stops by STP, a STOP key or M8x02.
void Super40nc::stop_by_command(int axis_number) {
  if (!chose(option("stp_stops", "by_its_ramp")) || (is_on_path(axis_number) && state_.path_is_held)) {
    return stop_axis(axis_number);
  }
  if (!end_by_ramp(axis_number, Mover::hand)) return;
  for (int number = 0; number < kAxisCount; ++number) {
    if (number != axis_number && !(is_on_path(axis_number) && is_on_path(number))) continue;
    axis(number).mover = Mover::hand;
    axis(number).awaited = axis(number).shows_finish = false;
  }
}

// ---- held, and on again

void Super40nc::hold_axis(int axis_number) {
  AxisState& state = axis(axis_number);
  if (state.holder == Activity::wheel || state.holder == Activity::rest) return;
  if (state.holder == Activity::vdrv && chose(option("pause_scope", "not_vdrv_nor_the_wheel"))) return;
  if (state.holder == Activity::home && chose(option("pause_home", "the_search_ends_first"))) return;
  motion::Axis& motor = chip(axis_number);
  if (state.rest.kind == RestKind::mark && motor.homing.active()) {
    const motion::HomingPhase& row = motor.homing.row();
    const bool searches = row.does == motion::HomingPhase::Does::search;
    state.rest.travel =
        motor.homing.began_pulses + (searches ? row.direction * row.within_pulses : row.distance_pulses);
    state.rest.searches = searches;
  }
  if (state.holder == Activity::home) state.rest = {.kind = RestKind::home};
  state.is_held = true;
  motor.slow_down(now());
}

/// Called when a held axis has come to rest; it waits.
void Super40nc::rest_axis(int axis_number) {
  AxisState& state = axis(axis_number);
  if (state.rest.kind == RestKind::mark) {
    const std::int64_t left = state.rest.travel - chip(axis_number).travel_pulses;
    const std::int64_t search = search_pulses(axis_number);
    state.rest.distance = state.rest.searches ? 0 : left;
    state.rest.search = state.rest.searches ? left : search;
  }
  state.holder = Activity::rest;
}

void Super40nc::go_on_axis(int axis_number) {
  AxisState& state = axis(axis_number);
  motion::Axis& motor = chip(axis_number);
  if (!state.is_held) return;
  state.is_held = false;
  if (state.holder != Activity::rest && state.rest.kind != RestKind::home &&
      state.rest.kind != RestKind::mark && motor.resume(motor.law, now())) {
    return;
  }
  if (state.holder != Activity::rest) rest_axis(axis_number);
  motor.stop();
  forget_end(axis_number);
  const Rest rest = state.rest;
  const Mover mover = state.mover;
  const bool is_awaited = state.awaited;
  const std::int64_t target_lu = state.target_lu;
  const motion::SpeedLaw law = motor.law;
  state.holder = Activity::nobody;
  switch (rest.kind) {
    case RestKind::none:
    case RestKind::path: break;
    case RestKind::move: {
      const std::int64_t distance = rest.travel - motor.travel_pulses;
      prepare(axis_number);
      begun(axis_number, motor.move(distance, law, before_motion()), Activity::move);
      if (state.holder != Activity::move) break;
      state.rest = rest;
      state.target_lu = target_lu;
      state.shows_finish = true;
      if (distance != 0) break;
      let_go(axis_number);
      state.has_ended = state.stands_on_target = true;
      show_finished(static_cast<std::size_t>(axis_number));
      return;
    }
    case RestKind::mark:
      if (rest.search != 0) begin_mark(axis_number, rest.distance, rest.search, rest.rpm, mover);
      break;
    case RestKind::turning: begin_turning(axis_number, rest.rpm, mover); break;
    case RestKind::home: start_home(axis_number); break;
  }
  if (state.holder == Activity::nobody) return cannot_go_on(axis_number, rest, mover, is_awaited);
  state.mover = mover;
  state.awaited = is_awaited;
}

/// Resets the program, as if the axis had met in motion what it stands at now.
void Super40nc::cannot_go_on(int axis_number, const Rest& rest, Mover mover, bool is_awaited) {
  const motion::Axis& motor = chip(axis_number);
  let_go(axis_number);
  const bool is_void = rest.kind == RestKind::mark && rest.search == 0;
  const bool may_fail = rest.kind == RestKind::home && chose(option("home_failure", "the_program_goes_on"));
  if (mover >= Mover::plc || is_void || may_fail) return;
  motion::Cause why = blocked_both_ways(axis_number);
  if (why == motion::Cause::none) {
    const std::int64_t ahead = rest.kind == RestKind::turning ? rest.rpm
                               : rest.kind == RestKind::move  ? rest.travel - motor.travel_pulses
                               : rest.distance != 0           ? rest.distance
                                                              : rest.search;
    why = rest.kind == RestKind::home ? motion::Cause::homing_failed : motor.forbidden(way_of(ahead));
  }
  program_broken(mover, axis_number, is_awaited, why);
}

/// Returns X16, for MRK.
std::int64_t Super40nc::search_pulses(int axis) const {
  const Settings settings = registers();
  const Value distance = settings.of(kept_x(d9x::kLowSpeedLength), axis);
  const bool is_in_pulses = chose(option("mark_distance_unit", "pulses"));
  return is_in_pulses ? distance : settings.scale(axis).to_pulses(distance).value_or(0);
}

/// Drops an end between ticks that has been handled.
void Super40nc::forget_end(int axis) {
  motion::Axis& motor = chip(axis);
  motor.events_between =
      static_cast<motion::Events>(motor.events_between & ~motion::bit(motion::Event::ended));
}

/// Stops all axes that a program moves, after one of them has met something.
void Super40nc::break_program(Mover mover, int but_for) {
  for (int number = 0; number < kAxisCount; ++number) {
    AxisState& state = axis(number);
    if (number == but_for || state.mover != mover || state.holder == Activity::nobody ||
        state.holder == Activity::wheel) {
      continue;
    }
    const bool ramp = registers().is_on(kept_x(d9x::kOtStop), number) && state.holder != Activity::rest;
    state.is_held = state.awaited = state.shows_finish = false;
    if (ramp) {
      chip(number).slow_down(now());
    } else {
      stop_axis(number);
    }
  }
}

void Super40nc::stop_all_of(Mover mover) {
  for (int number = 0; number < kAxisCount; ++number) {
    if (axis(number).mover == mover) stop_axis(number);
  }
}

bool Super40nc::is_awaited_by(Mover mover) const {
  return std::any_of(state_.axes.begin(), state_.axes.end(), [&](const AxisState& state) {
    return (state.mover == mover && state.awaited) || state.stop_awaited_by == mover;
  });
}

}  // namespace understudy::emulator::models::super_40nc
