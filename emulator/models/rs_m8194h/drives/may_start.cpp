// Decides whether a drive begins, waits, is held or is void, according to the rows of transitions.h.
#include <cstddef>

#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/drives/drives.h"
#include "emulator/models/rs_m8194h/drives/transition_tables.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/external_drive.h"

namespace understudy::emulator::models::rs_m8194h {

bool Drives::is_obstructed(std::size_t axis, Obstacle obstacle, bool on_path) const {
  const AxisUnit& unit = chip_.unit(axis);
  switch (obstacle) {
    case Obstacle::emergency_state: return state_.emergency_state;
    case Obstacle::lock: return unit.locked;
    case Obstacle::path_lock:
      return unit.path_locked && (on_path || chose(option("v_lock_scope", "every_drive_of_these_axes")));
    case Obstacle::emergency_input: return chip_.is_active(axis, motion::Signal::emergency);
    case Obstacle::alarm: return chip_.is_active(axis, motion::Signal::alarm);
    case Obstacle::servo_off: return machine_options().drives_need_servo && !unit.basic.servo;
    case Obstacle::hold: return unit.held;
  }
  return false;
}

Start Drives::may_start(std::size_t axis, Starter who, bool on_path) const {
  const bool by_command = who == Starter::command;
  Start held = Start::starts;
  for (const ObstacleRow& row : kObstacleRows) {
    const Start outcome = by_command ? row.command : row.external;
    if (outcome == Start::starts || !is_obstructed(axis, row.obstacle, on_path)) continue;
    decisions().meet(kStartTable, start_state(row.obstacle), static_cast<std::size_t>(who));
    if (outcome == Start::is_void) return outcome;
    held = outcome;
  }
  if (by_command && chip_.unit(axis).external.mode != motion::ExternalDrive::Mode::off &&
      chose(option("exd_and_drives", "are_void"))) {
    return Start::is_void;
  }
  const Activity activity_now = chip_.activity(axis);
  decisions().meet(kStartTable, start_state(activity_now), static_cast<std::size_t>(who));
  const ActivityRow& row = kActivityRows[static_cast<std::size_t>(activity_now)];
  const Start outcome = by_command ? row.command : row.external;
  if (outcome != Start::waits) return outcome == Start::starts ? held : outcome;
  const bool in_stream = activity_now == Activity::path && chip_.paths().runs == Paths::Runs::stream;
  const bool is_void = (in_stream && chose(option("drive_in_open_stream", "is_void"))) ||
                       (!in_stream && chose(option("drive_of_moving_axis", "is_void")));
  return is_void ? Start::is_void : Start::waits;
}

Start Drives::may_start(AxisMask axes, Starter who) const {
  Start worst = Start::starts;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    const Start mine = may_start(a, who, true);
    if (mine == Start::is_void) return mine;
    if (mine == Start::waits || worst == Start::starts) worst = mine;
  }
  return worst;
}

void Drives::note_obstacles(AxisMask axes) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    for (const ObstacleRow& row : kObstacleRows) {
      if (row.sets_error && is_obstructed(a, row.obstacle, false)) chip_.add_errors(a, bit_of(row.error));
    }
  }
}

bool Drives::waits_behind_held(AxisMask axes) const {
  return chose(option("second_held_drive", "waits")) && holds_a_drive(axes);
}

bool Drives::keeps_first_held(AxisMask axes) const {
  return chose(option("second_held_drive", "is_void")) && holds_a_drive(axes);
}

bool Drives::holds_a_drive(AxisMask axes) const {
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (has(axes, a) && chip_.unit(a).held_drive.what != Drive::What::none) return true;
  }
  return (streams_.axes_of_held() & axes) != 0;
}

bool Drives::lacks_speed(std::size_t axis, Drive::What what) const {
  if (!machine_options().zero_speeds_drive_nothing || what == Drive::What::endless) return false;
  const AxisUnit& unit = chip_.unit(axis);
  return unit.speed.drive_pps == 0 || (what == Drive::What::home && unit.homing.home_pps == 0);
}

}  // namespace understudy::emulator::models::rs_m8194h
