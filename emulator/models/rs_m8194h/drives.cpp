// Drives of single axes: whether they begin, wait, are held or void (transitions.h), and how they begin.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/paths.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/transitions.h"
#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/homing.h"
#include "motion/homing_tables.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// 7.4.12.
constexpr double kMaxScanTriggers_hz = 100'000;

int way_of_step(std::uint8_t step) { return step == 1 ? +1 : step == 2 ? -1 : 0; }

/// What the manual leaves open about homing.
struct HomingOptions {
  bool fails_at_limit_in_step_1 = false;
  bool limit_is_near_home = false;
  bool turns_at_soft_limits = false;
};

motion::HomingProgram homing_of(const AxisUnit& unit, const SpeedRules& rules, const HomingOptions& options) {
  motion::Rsm8194hHoming how;
  for (std::size_t i = 0; i < how.ways.size(); ++i) how.ways[i] = way_of_step(unit.homing.steps[i]);
  how.drive = law_of(unit, rules);
  how.home = law_at(unit, unit.homing.home_pps, rules);
  how.offset_pulses = unit.homing.offset_pulses;
  how.limit_is_home = unit.homing.limit_is_home;
  how.limit_is_near_home = unit.homing.limit_is_home && options.limit_is_near_home;
  how.soft_limits_lead_on = options.turns_at_soft_limits;
  motion::HomingProgram program = motion::rsm8194h_homing(how);
  const bool has_step_1 = how.ways[0] != 0;
  if (has_step_1 && options.fails_at_limit_in_step_1) program.phases[0].if_limit = motion::HomingPhase::kFail;
  return program;
}

}  // namespace

Activity Module::activity(std::size_t axis) const {
  const motion::Axis& motor = state_.motors[axis];
  if (motor.homing.active()) return Activity::homing;
  if (state_.paths.together.takes(axis)) return Activity::path;
  return motor.moving() ? Activity::single : Activity::idle;
}

bool Module::is_driving(std::size_t axis) const { return activity(axis) != Activity::idle; }

/// ERROR_CODE as it is read.
std::uint16_t Module::error_code(std::size_t axis) const {
  std::uint16_t code = state_.units[axis].error_code;
  if (!chose(option("error_bits", "also_by_active_inputs"))) return code;
  constexpr struct {
    motion::Signal signal;
    ErrorBit bit;
  } kInputs[] = {{motion::Signal::limit_plus, ErrorBit::limit_plus},
                 {motion::Signal::limit_minus, ErrorBit::limit_minus},
                 {motion::Signal::alarm, ErrorBit::alarm},
                 {motion::Signal::emergency, ErrorBit::emergency}};
  for (const auto& each : kInputs) {
    if (is_active(axis, each.signal)) code |= bit_of(each.bit);
  }
  return code;
}

AxisMask Module::driving() const {
  AxisMask mask = 0;
  for (std::size_t a = 0; a < kAxes; ++a) mask |= is_driving(a) ? mask_of(a) : AxisMask{0};
  return mask;
}

bool Module::is_active(std::size_t axis, motion::Signal signal) const {
  return (state_.environment[axis].at(state_.motors[axis].travel_pulses, state_.motors[axis].signals) &
          motion::bit(signal)) != 0;
}

bool Module::is_obstructed(std::size_t axis, Obstacle obstacle, bool on_path) const {
  const AxisUnit& unit = state_.units[axis];
  switch (obstacle) {
    case Obstacle::emergency_state: return state_.emergency_state;
    case Obstacle::lock: return unit.locked;
    case Obstacle::path_lock:
      return unit.path_locked && (on_path || chose(option("v_lock_scope", "every_drive_of_these_axes")));
    case Obstacle::emergency_input: return is_active(axis, motion::Signal::emergency);
    case Obstacle::alarm: return is_active(axis, motion::Signal::alarm);
    case Obstacle::servo_off: return machine_.drives_need_servo && !unit.basic.servo;
    case Obstacle::hold: return unit.held;
  }
  return false;
}

Start Module::may_start(std::size_t axis, Starter who, bool on_path) const {
  const bool by_command = who == Starter::command;
  Start held = Start::starts;
  for (const ObstacleRow& row : kObstacleRows) {
    const Start outcome = by_command ? row.command : row.external;
    if (outcome == Start::starts || !is_obstructed(axis, row.obstacle, on_path)) continue;
    if (outcome == Start::is_void) return outcome;
    held = outcome;
  }
  if (by_command && state_.units[axis].external.mode != motion::ExternalDrive::Mode::off &&
      chose(option("exd_and_drives", "are_void"))) {
    return Start::is_void;
  }
  const Activity activity_now = activity(axis);
  const ActivityRow& row = kActivityRows[static_cast<std::size_t>(activity_now)];
  const Start outcome = by_command ? row.command : row.external;
  if (outcome != Start::waits) return outcome == Start::starts ? held : outcome;
  const bool in_stream = activity_now == Activity::path && state_.paths.runs == Paths::Runs::stream;
  const bool is_void = (in_stream && chose(option("drive_in_open_stream", "is_void"))) ||
                       (!in_stream && chose(option("drive_of_moving_axis", "is_void")));
  return is_void ? Start::is_void : Start::waits;
}

Start Module::may_start(AxisMask axes, Starter who) const {
  Start worst = Start::starts;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    const Start mine = may_start(a, who, true);
    if (mine == Start::is_void) return mine;
    if (mine == Start::waits || worst == Start::starts) worst = mine;
  }
  return worst;
}

void Module::note_obstacles(AxisMask axes) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    for (const ObstacleRow& row : kObstacleRows) {
      if (row.sets_error && is_obstructed(a, row.obstacle, false))
        state_.units[a].error_code |= bit_of(row.error);
    }
  }
}

/// Of a drive that starts: what it has left behind it.
void Module::forget_errors(std::size_t axis) {
  if (chose(option("error_bits_end", "nothing"))) return;
  state_.units[axis].error_code &= static_cast<std::uint16_t>(~kClearedByDrive);
}

/// By choice, of a drive that would be held: another one of its axes is held already.
bool Module::waits_behind_held(AxisMask axes) const {
  return chose(option("second_held_drive", "waits")) && holds_a_drive(axes);
}
bool Module::keeps_first_held(AxisMask axes) const {
  return chose(option("second_held_drive", "is_void")) && holds_a_drive(axes);
}

bool Module::holds_a_drive(AxisMask axes) const {
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (has(axes, a) && state_.units[a].held_drive.what != Drive::What::none) return true;
  }
  return (axes_of_held_path() & axes) != 0;
}

/// By choice, CONTINUE_MOVE goes on at another speed, or, the other way, behind a stop. Whether it does.
bool Module::takes_place_of_endless(std::size_t axis, const Drive& what) {
  motion::Axis& motor = state_.motors[axis];
  const bool is_again = what.what == Drive::What::endless && activity(axis) == Activity::single &&
                        motor.task == motion::Task::endless;
  if (!is_again || !chose(option("continue_move_again", "takes_its_place"))) return false;
  const bool is_same_direction =
      !motor.slowing && what.value != 0 && (what.value < 0) == (motor.drive.direction < 0);
  if (is_same_direction) {
    AxisUnit& unit = state_.units[axis];
    const auto drive_pps = static_cast<std::uint32_t>(std::abs(std::int64_t{what.value}));
    if (chose(option("continue_move_speed", "yes"))) unit.speed.drive_pps = drive_pps;
    motor.change_speed(law_at(unit, drive_pps, machine_.speed), now());
  } else {
    motor.slow_down(now());
    state_.units[axis].held_drive = what;
  }
  return true;
}

Took Module::drive(AxisMask axes, const Drive& what) {
  AxisMask taken = 0;
  for (std::size_t a = 0; a < kAxes; ++a) {
    const bool may = has(axes, a) && may_start(a, Starter::command) == Start::waits;
    if (may && takes_place_of_endless(a, what)) taken |= mask_of(a);
  }
  axes &= static_cast<AxisMask>(~taken);
  // Then one that moves takes it along, and starts with it when it stands.
  const bool is_each_its_own = chose(option("mask_drive", "axis_by_axis")) && (axes & (axes - 1)) != 0;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    const Start mine = may_start(a, Starter::command);
    const bool takes_it_along =
        mine == Start::waits && is_each_its_own && state_.units[a].held_drive.what == Drive::What::none;
    if (takes_it_along) continue;
    if (mine == Start::waits || (mine == Start::is_held && waits_behind_held(mask_of(a)))) return Took::waits;
  }
  if (chose(option("mask_drive", "is_void_if_one_is"))) {
    for (std::size_t a = 0; a < kAxes; ++a) {
      if (!has(axes, a) || may_start(a, Starter::command) != Start::is_void) continue;
      note_obstacles(axes);
      return Took::done;
    }
  }
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    switch (may_start(a, Starter::command)) {
      case Start::starts: start(a, what); break;
      case Start::is_void: note_obstacles(mask_of(a)); break;
      case Start::is_held:
        // The later one replaces what was held of this axis, or comes too late.
        if (keeps_first_held(mask_of(a))) break;
        state_.units[a].held_drive = what;
        if (has(axes_of_held_path(), a)) drop_held_path();
        break;
      case Start::waits: state_.units[a].held_drive = what; break;  // takes it along
    }
  }
  return Took::done;
}

motion::SpeedLaw Module::law_of(std::size_t axis) const {
  return rs_m8194h::law_of(state_.units[axis], machine_.speed);
}

bool Module::lacks_speed(std::size_t axis, Drive::What what) const {
  if (!machine_.zero_speeds_drive_nothing || what == Drive::What::endless) return false;
  const AxisUnit& unit = state_.units[axis];
  return unit.speed.drive_pps == 0 || (what == Drive::What::home && unit.homing.home_pps == 0);
}

void Module::start(std::size_t axis, const Drive& what, bool without_ramps) {
  AxisUnit& unit = state_.units[axis];
  motion::Axis& motor = state_.motors[axis];
  Paths& paths = state_.paths;
  if (paths.open && !paths.together.engaged && has(paths.axes, axis)) paths.open = false;
  take_off(axis, WayOut::other_drive);
  unit.began_pulses = motor.travel_pulses;
  // What a command finds at its pins is what they are now.
  motor.signals = state_.environment[axis].at(motor.travel_pulses, motor.signals);
  std::int64_t distance = what.value;
  if (what.what == Drive::What::absolute) distance -= absolute_count(unit, motor);
  if (what.what != Drive::What::home && distance == 0) return;
  if (lacks_speed(axis, what.what)) return;
  motion::SpeedLaw law = law_of(axis);
  if (what.what == Drive::What::endless) {
    const auto drive_pps = static_cast<std::uint32_t>(std::abs(distance));
    law = law_at(unit, drive_pps, machine_.speed);
    if (chose(option("continue_move_speed", "yes"))) unit.speed.drive_pps = drive_pps;
  }
  if (without_ramps) law.start_speed_u_s = law.top_speed_u_s;
  if (what.what == Drive::What::scan && chose(option("scan_too_fast", "the_scan_is_void"))) {
    const LineScan& scan = state_.scans[axis];
    const double spacing = static_cast<double>(scan_spacing(scan));
    if (scan.set && law.top_speed_u_s / spacing > kMaxScanTriggers_hz) return;
  }
  const int direction = distance < 0 ? -1 : +1;
  motion::Cause refused = motion::Cause::none;
  if (what.what == Drive::What::home) {
    const HomingOptions options{.fails_at_limit_in_step_1 = chose(option("home_step_1_limit", "fails")),
                                .limit_is_near_home = chose(option("home_limit", "home_and_near_home")),
                                .turns_at_soft_limits = chose(option("home_soft_limit", "turns_round"))};
    refused = motor.home(homing_of(unit, machine_.speed, options), now());
  } else if (what.what == Drive::What::endless) {
    refused = motor.run(direction, law, now());
  } else {
    refused = motor.move(distance, law, now());
  }
  if (refused != motion::Cause::none) {
    // Homing that cannot begin has found its index on already.
    unit.error_code |= refused == motion::Cause::homing_failed ? bit_of(ErrorBit::home) : error_of(refused);
    return;
  }
  forget_errors(axis);
  if (motor.homing.active() && !machine_.axis.homing_obeys_soft_limits) rearm(axis);
  if (what.what == Drive::What::scan) begin_scans(mask_of(axis));
  if (LineScan& scan = state_.scans[axis]; what.what == Drive::What::scan && scan.set) {
    scan.running = true;
    scan.begin = scan_travel(axis);
    scan.triggered = 0;
    const bool is_against = (scan.pitch < 0) != (distance < 0);
    if (is_against && chose(option("scan_sign", "no_triggers"))) end_scan(axis);
  }
}

void Module::start_held() {
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    if (unit.held_drive.what == Drive::What::none || unit.held) continue;
    const Start outcome = may_start(a, Starter::command);
    if (outcome == Start::waits) continue;
    const Drive what = std::exchange(unit.held_drive, Drive{});
    if (outcome == Start::starts) {
      start(a, what);
    } else {
      note_obstacles(mask_of(a));
    }
  }
  while (!state_.held_paths.empty()) {
    const HeldPath path = state_.held_paths.front();
    const Start outcome = may_start(mask_of_codes(path.codes), Starter::command);
    const bool stays = outcome == Start::is_held || outcome == Start::waits;
    // Segments behind the one that has begun join it.
    if (stays && !joins_stream(path)) return;
    if (begin_path(path) == Took::waits) return;
    if (!state_.held_paths.empty()) state_.held_paths.erase(state_.held_paths.begin());
  }
}

}  // namespace understudy::emulator::models::rs_m8194h
