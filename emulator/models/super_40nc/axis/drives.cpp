#include "emulator/models/super_40nc/axis/drives.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/ownership.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "motion/homing.h"
#include "motion/homing_tables.h"
#include "motion/move.h"

namespace understudy::emulator::models::super_40nc {

namespace {

constexpr int kModePositionMove = 0x41;
constexpr int kModeTurning = 0x00;
constexpr int kModeTurningBack = 0x08;

}  // namespace

double Drives::override_percent() const {
  constexpr double kMax = 100;
  const auto percent = static_cast<double>(registers().of(stored_d(d8::kFeedPercentage)));
  return chose(option("override_range", "0_to_100")) ? std::min(percent, kMax) : percent;
}

/// Returns the speed law of a line: with the axis's own times, or, for C and depending on a choice, with the
/// times of C.
motion::SpeedLaw Drives::line_law(int axis, double rpm, Mover mover) const {
  const bool is_by_times_of_c = mover == Mover::c && chose(option("drv_of_c", "c11_to_c14"));
  const Settings settings = registers();
  return is_by_times_of_c ? settings.law_of_c(axis, rpm) : settings.law(axis, rpm);
}

motion::SpeedLaw Drives::drive_law(int axis, std::int32_t rpm, Mover mover) const {
  const bool is_scaled = chose(option("override_scope", "drv_as_well"));
  return line_law(axis, is_scaled ? rpm * override_percent() / 100 : rpm, mover);
}

bool Drives::begin_drive(int axis_number, std::int64_t target_lu, std::int32_t rpm, Mover mover) {
  AxisState& state = axis(axis_number);
  starts_.prepare(axis_number);
  state.mover = mover;  // if the motion cannot begin, D8095 shows the mover's line
  const std::int64_t distance = distance_to(axis_number, target_lu);
  const motion::SpeedLaw law = drive_law(axis_number, rpm, mover);
  starts_.begun(axis_number, chip(axis_number).move(distance, law, before_motion()), Activity::move);
  if (state.holder != Activity::move) {
    state.mover = Mover::hand;
    return false;
  }
  state.target_lu = target_lu;
  starts_.mirror_start(axis_number, kModePositionMove, distance, law);
  if (distance == 0) {
    starts_.let_go(axis_number);
    state.has_ended = state.stands_on_target = true;
    if (ground_.finishes_without_motion()) ground_.show_finished(static_cast<std::size_t>(axis_number));
    return true;
  }
  state.shows_finish = true;
  state.rest = {.kind = RestKind::move, .travel = chip(axis_number).travel_pulses + distance, .rpm = rpm};
  return true;
}

/// MRK with X16 = 0: a signal during the move resets the program, as a limit would, regardless of X33 and
/// X34.
bool Drives::begin_blind_mark(int axis_number, std::int64_t target_lu, std::int32_t rpm, Mover mover) {
  AxisState& state = axis(axis_number);
  if (chose(option("mark_without_distance", "a_plain_move"))) {
    return begin_drive(axis_number, target_lu, rpm, mover);
  }
  state.rest.limits_count = true;
  inputs_.update_environment(axis_number);
  const bool begins = begin_drive(axis_number, target_lu, rpm, mover);
  if (state.holder == Activity::move) {
    state.rest.limits_count = true;
  } else {
    state.rest = {};
    inputs_.update_environment(axis_number);
  }
  return begins;
}

bool Drives::begin_mark(int axis_number, std::int64_t distance, std::int64_t search, std::int32_t rpm,
                        Mover mover) {
  AxisState& state = axis(axis_number);
  const Settings settings = registers();
  state.rest = {.kind = RestKind::mark, .marks_positive = search > 0, .rpm = rpm};
  state.mover = mover;
  inputs_.update_environment(axis_number);
  starts_.prepare(axis_number);
  const motion::SpeedLaw fast = line_law(axis_number, rpm, mover);
  const motion::HomingProgram program = motion::super40nc_mark(
      {.distance_pulses = distance,
       .search_pulses = search,
       .fast = fast,
       .creep = line_law(axis_number,
                         static_cast<double>(settings.of(stored_x(d9x::kCreepSpeed), axis_number)), mover),
       .slows_behind = chose(option("mrk_course", "slows_behind_the_target")),
       .searches_all_the_way = chose(option("mrk_course", "signal_before_it_counts")),
       .mark_slows = chose(option("mrk_course", "stops_by_a_ramp")),
       .needs_edge = chose(option("mark_edge", "has_to_come_anew"))});
  starts_.begun(axis_number, chip(axis_number).home(program, before_motion()), Activity::move);
  if (state.holder != Activity::move) {
    starts_.let_go(axis_number);
    return false;
  }
  starts_.mirror_start(axis_number, kModePositionMove, distance, fast);
  state.shows_finish = true;
  return true;
}

bool Drives::begin_turning(int axis_number, std::int32_t rpm, Mover mover) {
  AxisState& state = axis(axis_number);
  starts_.prepare(axis_number);
  state.mover = mover;
  const motion::SpeedLaw law = line_law(axis_number, std::abs(static_cast<double>(rpm)), mover);
  starts_.begun(axis_number, chip(axis_number).run(direction_of(rpm), law, before_motion()), Activity::vdrv);
  if (state.holder != Activity::vdrv) {
    state.mover = Mover::hand;
    return false;
  }
  state.rest = {.kind = RestKind::turning, .rpm = rpm};
  starts_.mirror_start(axis_number, rpm < 0 ? kModeTurningBack : kModeTurning, 0, law);
  return true;
}

void Drives::change_turning(int axis_number, std::int32_t rpm, Mover mover) {
  AxisState& state = axis(axis_number);
  const motion::SpeedLaw law = line_law(axis_number, std::abs(static_cast<double>(rpm)), mover);
  if (!chip(axis_number).resume(law, now())) chip(axis_number).change_speed(law, now());
  state.mover = mover;
  state.rest.rpm = direction_of(state.rest.rpm) * std::abs(rpm);
  state.stop_awaited_by = Mover::hand;
}

}  // namespace understudy::emulator::models::super_40nc
