// Stops, locks and holds, and what takes them away (7.5): by the rows of transitions.h.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/paths.h"
#include "emulator/models/rs_m8194h/transitions.h"
#include "interpreter/rs_m8194h/verbs.h"
#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// What clears a stop leaves the codes.
bool clears_the_lock_alone(const Module& device) { return device.chose(option("clear_stop_codes", "lock")); }

}  // namespace

/// The others go on along the path; it stops, or slows down by its own ramp from the speed that it has.
void Module::leave_path(std::size_t axis, Halt halt) {
  const double speed_pps = state_.paths.together.speed_pps(axis, now());
  for (std::int8_t& mine : state_.paths.together.axis_of) {
    if (mine == static_cast<std::int8_t>(axis)) mine = motion::Coordinated::kNone;
  }
  state_.paths.axes &= static_cast<AxisMask>(~mask_of(axis));
  AxisUnit& unit = state_.units[axis];
  unit.error_code |= std::exchange(unit.met, std::uint16_t{0});
  motion::Axis& motor = state_.motors[axis];
  const auto drive_pps = static_cast<std::uint32_t>(std::ceil(std::abs(speed_pps)));
  const motion::SpeedLaw law = law_at(state_.units[axis], drive_pps, machine_.speed);
  const motion::Events before = motor.events_between;
  const bool slows = halt == Halt::slows && std::abs(speed_pps) > law.start_speed_u_s;
  if (slows && motor.move_on(speed_pps, speed_pps < 0 ? -1 : +1, law, now()) == motion::Cause::none) {
    motor.events_between = before;  // it is on its way already
    motor.slow_down(now());         // it would come back, else
  } else {
    motor.stop();
  }
}

/// What the axis had left to be done, as far as this takes it away (transitions.h).
void Module::take_off(std::size_t axis, WayOut way) {
  AxisUnit& unit = state_.units[axis];
  if (takes_off(way, Mark::paused_drive)) unit.paused_drive = {};
  if (takes_off(way, Mark::external_drive)) {
    unit.external.running = 0;
    unit.external_waiting = unit.external_free_ns = 0;
  }
  if (!takes_off(way, Mark::trigger_hold)) return;
  for (AxisMask& held : state_.trigger_holds) held &= static_cast<AxisMask>(~mask_of(axis));
}

/// One without ramps has those that its start speed gives it.
motion::SpeedLaw Module::law_to_slow_path() const {
  const Paths& paths = state_.paths;
  motion::SpeedLaw law = paths.together.run.speed();
  const bool has_no_ramps = law.start_speed_u_s >= law.top_speed_u_s;
  if (paths.together.engaged && has_no_ramps && machine_.constant_paths_slow_down) {
    const bool is_stream = paths.runs == Paths::Runs::stream;
    const std::uint32_t start_pps =
        is_stream ? paths.streams[static_cast<std::size_t>(paths.stream)].start_pps : paths.vector.start_pps;
    law.start_speed_u_s = std::min(std::max(1.0, static_cast<double>(start_pps)), law.top_speed_u_s);
  }
  return law;
}

void Module::slow_path(Tick tick) {
  motion::Coordinated& together = state_.paths.together;
  if (together.engaged) together.run.set_speed(law_to_slow_path(), tick);
  together.slow_down(tick);
}

void Module::halt(AxisMask axes, const StopRow& row) {
  Paths& paths = state_.paths;
  const bool leaves_others =
      row.locks && (paths.axes & ~axes) != 0 && chose(option("stop_one_of_path", "it_alone_stops"));
  const bool locks_whole_path = chose(option("stop_one_of_path", "all_end_and_are_locked"));
  AxisMask locked_with_it = 0;
  const bool is_emergency = row.verb == lang::Verb::emergency_stop;
  const bool keeps_held = is_emergency && chose(option("emergency_drops_holds", "kept"));
  const auto trigger_holds = state_.trigger_holds;
  const WayOut way = is_emergency     ? WayOut::emergency_stop
                     : row.locks_path ? WayOut::path_stop
                                      : WayOut::stop;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    AxisUnit& unit = state_.units[a];
    motion::Axis& motor = state_.motors[a];
    const Activity activity_now = activity(a);
    const Halt halt = row.halts[static_cast<std::size_t>(activity_now)];
    if (halt != Halt::goes_on && activity_now == Activity::path && leaves_others) {
      leave_path(a, halt);
    } else if (halt != Halt::goes_on && activity_now == Activity::path) {
      if (halt == Halt::slows) {
        slow_path(now());
      } else {
        paths.together.stop(state_.motors);
      }
      break_off_stream();
    } else if (halt == Halt::slows) {
      motor.slow_down(now());
    } else if (halt == Halt::stops) {
      motor.stop();
    }
    if (paths.open && !paths.together.engaged && has(paths.axes, a)) break_off_stream();
    take_off(a, way);
    if (row.locks && halt != Halt::goes_on && activity_now == Activity::path && locks_whole_path) {
      locked_with_it |= paths.axes;
    }
    const bool stands = activity_now == Activity::idle && unit.held_drive.what == Drive::What::none;
    if (row.locks && stands && chose(option("stop_of_idle_axis", "nothing"))) continue;
    unit.locked = unit.locked || row.locks;
    unit.path_locked = unit.path_locked || row.locks_path;
    if (row.drops_held_drive && !keeps_held) {
      unit.held_drive = {};
      if (has(axes_of_held_path(), a)) drop_held_path();
    }
    if (row.drops_hold && !keeps_held) unit.held = false;
    unit.error_code |= bit_of(row.error);
  }
  if (keeps_held) state_.trigger_holds = trigger_holds;
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(locked_with_it, a)) continue;
    state_.units[a].locked = true;
    state_.units[a].error_code |= bit_of(row.error);
  }
}

void Module::clear_stop(AxisMask axes) {
  const bool keeps_code = clears_the_lock_alone(*this);
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    AxisUnit& unit = state_.units[a];
    unit.locked = false;
    if (keeps_code) continue;
    unit.error_code =
        error_left(unit.error_code, {.other_lock = unit.path_locked,
                                     .emergency_state = state_.emergency_state,
                                     .alarm_is_active = is_active(a, motion::Signal::alarm),
                                     .emergency_input = is_active(a, motion::Signal::emergency)});
  }
}

void Module::clear_path_stop() {
  const bool keeps_code = clears_the_lock_alone(*this);
  const bool takes_all = chose(option("clear_stop_codes", "vstop_the_codes_of_all_axes"));
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    if (!unit.path_locked && !takes_all) continue;
    unit.path_locked = false;
    if (keeps_code) continue;
    unit.error_code =
        error_left(unit.error_code, {.other_lock = unit.locked,
                                     .emergency_state = state_.emergency_state,
                                     .alarm_is_active = is_active(a, motion::Signal::alarm),
                                     .emergency_input = is_active(a, motion::Signal::emergency)});
  }
}

void Module::clear_emergency() {
  state_.emergency_state = false;
  for (AxisUnit& unit : state_.units) {
    unit.error_code &= static_cast<std::uint16_t>(~bit_of(ErrorBit::soft_emergency));
  }
}

void Module::hold(AxisMask axes) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    const bool is_void = is_driving(a) && chose(option("hold_of_moving_axis", "is_void"));
    if (has(axes, a) && !is_void) state_.units[a].held = true;
  }
}

void Module::release(AxisMask axes) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    if (!has(axes, a)) continue;
    state_.units[a].held = false;
    take_off(a, WayOut::release);
  }
  const AxisMask of_path = axes_of_held_path();
  if ((of_path & axes) != 0 && chose(option("hold_partial_start", "starts_at_once"))) {
    for (std::size_t a = 0; a < kAxes; ++a) {
      if (has(of_path, a)) state_.units[a].held = false;
    }
  }
  const bool is_partial = (of_path & axes) != 0 && (of_path & ~axes) != 0;
  if (is_partial && chose(option("hold_partial_start", "is_void"))) drop_held_path();
  start_held();
}

}  // namespace understudy::emulator::models::rs_m8194h
