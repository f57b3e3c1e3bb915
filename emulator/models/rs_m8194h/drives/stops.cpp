#include "emulator/models/rs_m8194h/drives/stops.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/chip/paths.h"
#include "emulator/models/rs_m8194h/drives/transition_tables.h"
#include "emulator/models/rs_m8194h/drives/transitions.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

/// Removes an axis from its path while the other axes continue. The axis stops, or slows down by its own ramp
/// from its present speed.
void Stops::leave_path(std::size_t axis, Halt halt) {
  const double speed_pps = chip_.paths().together.speed_pps(axis, now());
  for (std::int8_t& mine : chip_.paths().together.axis_of) {
    if (mine == static_cast<std::int8_t>(axis)) mine = motion::Coordinated::kNone;
  }
  chip_.paths().axes &= static_cast<AxisMask>(~mask_of(axis));
  AxisUnit& unit = chip_.unit(axis);
  chip_.add_errors(axis, std::exchange(unit.met, std::uint16_t{0}));
  motion::Axis& motor = chip_.motor(axis);
  const auto drive_pps = static_cast<std::uint32_t>(std::ceil(std::abs(speed_pps)));
  const motion::SpeedLaw law = law_at(chip_.unit(axis), drive_pps, machine_options().speed);
  const motion::Events before = motor.events_between;
  const bool slows = halt == Halt::slows && std::abs(speed_pps) > law.start_speed_u_s;
  if (slows && motor.move_on(speed_pps, speed_pps < 0 ? -1 : +1, law, now()) == motion::Cause::none) {
    motor.events_between = before;  // the axis is already moving to its target
    motor.slow_down(now());         // otherwise, the axis would return
  } else {
    motor.stop();
  }
}

/// Slows down or stops an axis, together with all others of its path unless it leaves the path.
void Stops::halt_axis(std::size_t axis, Halt halt, bool leaves_others) {
  const bool slows = halt == Halt::slows;
  if (chip_.activity(axis) != Activity::path) {
    return slows ? chip_.motor(axis).slow_down(now()) : chip_.motor(axis).stop();
  }
  if (leaves_others) return leave_path(axis, halt);
  slows ? streams_.slow_down(now()) : streams_.stop();
  streams_.break_off();
}

void Stops::halt(AxisMask axes, const StopRow& row) {
  Paths& paths = chip_.paths();
  const bool leaves_others =
      row.locks && (paths.axes & ~axes) != 0 && chose(option("stop_one_of_path", "it_alone_stops"));
  const bool locks_whole_path = chose(option("stop_one_of_path", "all_end_and_are_locked"));
  AxisMask locked_with_it = 0;
  const bool is_emergency = row.verb == lang::Verb::emergency_stop;
  const bool keeps_held = is_emergency && chose(option("emergency_drops_holds", "kept"));
  const auto trigger_holds = drives_.state().trigger_holds;
  const DiscardEvent event = is_emergency     ? DiscardEvent::emergency_stop
                             : row.locks_path ? DiscardEvent::path_stop
                                              : DiscardEvent::stop;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    AxisUnit& unit = chip_.unit(a);
    const Activity activity_now = chip_.activity(a);
    const auto does = static_cast<std::size_t>(activity_now);
    decisions().meet(kStopTable, does, static_cast<std::size_t>(&row - kStopRows.data()));
    const Halt halt = row.halts[does];
    if (halt != Halt::continues) halt_axis(a, halt, leaves_others);
    if (paths.open && !paths.together.engaged && has(paths.axes, a)) streams_.break_off();
    drives_.take_off(a, event);
    if (row.locks && halt != Halt::continues && activity_now == Activity::path && locks_whole_path) {
      locked_with_it |= paths.axes;
    }
    const bool stands = activity_now == Activity::idle && unit.held_drive.what == Drive::What::none;
    if (row.locks && stands && chose(option("stop_of_idle_axis", "nothing"))) continue;
    unit.locked = unit.locked || row.locks;
    unit.path_locked = unit.path_locked || row.locks_path;
    if (row.drops_held_drive && !keeps_held) {
      unit.held_drive = {};
      if (has(streams_.axes_of_held(), a)) streams_.drop_held();
    }
    if (row.drops_hold && !keeps_held) unit.held = false;
    chip_.add_errors(a, bit_of(row.error));
  }
  if (keeps_held) drives_.state().trigger_holds = trigger_holds;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(locked_with_it, a)) continue;
    chip_.unit(a).locked = true;
    chip_.add_errors(a, bit_of(row.error));
  }
}

Cleared Stops::still_there(std::size_t axis, bool other_lock) const {
  return {.other_lock = other_lock,
          .emergency_state = drives_.state().emergency_state,
          .alarm_is_active = chip_.is_active(axis, motion::Signal::alarm),
          .emergency_input = chip_.is_active(axis, motion::Signal::emergency)};
}

void Stops::clear_stop(AxisMask axes) {
  const bool keeps_code = chose(option("clear_stop_codes", "lock"));
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    AxisUnit& unit = chip_.unit(a);
    unit.locked = false;
    if (keeps_code) continue;
    unit.error_code = error_left(unit.error_code, still_there(a, unit.path_locked));
  }
}

void Stops::clear_path_stop() {
  const bool keeps_code = chose(option("clear_stop_codes", "lock"));
  const bool takes_all = chose(option("clear_stop_codes", "vstop_the_codes_of_all_axes"));
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = chip_.unit(a);
    if (!unit.path_locked && !takes_all) continue;
    unit.path_locked = false;
    if (keeps_code) continue;
    unit.error_code = error_left(unit.error_code, still_there(a, unit.locked));
  }
}

void Stops::clear_emergency() {
  drives_.state().emergency_state = false;
  for (AxisUnit& unit : chip_.state().units) {
    unit.error_code &= static_cast<std::uint16_t>(~bit_of(ErrorBit::soft_emergency));
  }
}

void Stops::hold(AxisMask axes) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    const bool is_void = chip_.is_driving(a) && chose(option("hold_of_moving_axis", "is_void"));
    if (has(axes, a) && !is_void) chip_.unit(a).held = true;
  }
}

void Stops::release(AxisMask axes) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    chip_.unit(a).held = false;
    drives_.take_off(a, DiscardEvent::release);
  }
  const AxisMask of_path = streams_.axes_of_held();
  if ((of_path & axes) != 0 && chose(option("hold_partial_start", "starts_at_once"))) {
    for (std::size_t a = 0; a < kAxes; ++a) {
      if (has(of_path, a)) chip_.unit(a).held = false;
    }
  }
  const bool is_partial = (of_path & axes) != 0 && (of_path & ~axes) != 0;
  if (is_partial && chose(option("hold_partial_start", "is_void"))) streams_.drop_held();
  start_held();
}

void Stops::start_held() {
  drives_.start_held();
  path_starts_.start_held();
}

void Stops::slow_down(AxisMask axes) {
  Paths& paths = chip_.paths();
  if (paths.together.engaged && (paths.axes & axes) != 0) {
    streams_.slow_down(now());
    streams_.break_off();
  }
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (has(axes, a) && !paths.together.takes(a)) chip_.motor(a).slow_down(now());
  }
}

void Stops::pause() {
  motion::Coordinated& together = chip_.paths().together;
  if (together.engaged && together.slowing_for == motion::Cause::none) together.run.pause(now());
  for (std::size_t a = 0; a < kAxes; ++a) {
    motion::Axis& motor = chip_.motor(a);
    AxisUnit& unit = chip_.unit(a);
    if (chip_.activity(a) != Activity::single || motor.slowing) continue;
    const bool is_endless = motor.task == motion::Task::endless;
    const double speed_pps = motor.law.top_speed_u_s * static_cast<double>(motor.drive.direction);
    unit.paused_drive = {.what = is_endless ? Drive::What::endless : Drive::What::fixed,
                         .value = is_endless ? static_cast<std::int32_t>(speed_pps) : 0};
    unit.paused_to_pulses = motor.travel_pulses + motor.pulses_to_come();
    motor.slow_down(now());
  }
}

void Stops::resume() {
  motion::Coordinated& together = chip_.paths().together;
  const bool is_held = together.engaged && together.run.paused();
  if (is_held && together.slowing_for == motion::Cause::none) together.run.resume(now());
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = chip_.unit(a);
    if (unit.paused_drive.what == Drive::What::none) continue;
    const Start outcome = drives_.may_start(a, Starter::command);
    if (outcome == Start::waits) continue;
    Drive rest = std::exchange(unit.paused_drive, Drive{});
    if (rest.what == Drive::What::fixed) {
      rest.value = static_cast<std::int32_t>(unit.paused_to_pulses - chip_.motor(a).travel_pulses);
    }
    // A hold applies to later drives.
    if (outcome != Start::is_void) drives_.start(a, rest);
  }
}

}  // namespace understudy::emulator::models::rs_m8194h
