#include "emulator/models/slim/motor/moves.h"

#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/jogs.h"
#include "emulator/models/slim/motor/marks.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/homing_tables.h"
#include "motion/move.h"

namespace understudy::emulator::models::slim {

namespace {

/// Drops the head. Other FIFOs never contain a command for a single module. Returns true, because the FIFO
/// has changed.
bool drop_head(Module& module, Error why) {
  module.late_error = why;
  module.fifo.pop();
  return true;
}

void home_found(const Motor& motor) {
  set_coordinate(motor, 0);
  motor.module.homed = true;
  motor.module.fifo.pop();
}

}  // namespace

bool start_move(const Motor& motor, Tick begin_at) {
  Module& module = motor.module;
  motion::Axis& axis = motor.axis;
  Job& job = module.fifo[0];
  if (!job.absolute) job.units[0] += module.place_units;
  job.absolute = true;  // after an interruption, the move continues to the same position
  job.ends[0] = job.units[0];
  if (!axis.servo_on) return drop_head(module, Error::servo_off);
  if (!module.reaches(job.units[0])) return drop_head(module, Error::range);
  const std::int64_t distance = module.zero_pulses + module.pulses_of(job.units[0]) - axis.travel_pulses;
  if (distance == 0) {
    module.place_units = job.units[0];
    module.fifo.pop();
    return true;
  }
  const motion::SpeedLaw law = module.working_law(motor.options);
  if (law.top_speed_u_s == 0) return false;  // AVM without a voltage: the move starts when there is a voltage
  motion::Cause refused = motion::Cause::none;
  try {
    refused = axis.move(distance, law, begin_at - 1);
  } catch (const motion::BadMotion&) {
    return drop_head(module, Error::range);  // further than pulses can be counted
  }
  if (refused != motion::Cause::none) return drop_head(module, Error::not_allowed);
  take_off(module, MarkEvent::begins);
  module.activity = Activity::move;
  job.begun = true;
  return false;
}

bool start_home(const Motor& motor, Tick begin_at) {
  Module& module = motor.module;
  motion::Axis& axis = motor.axis;
  if (!axis.servo_on) return drop_head(module, Error::servo_off);
  const motion::SpeedLaw law = module.jog_law(motor.options);
  if (law.top_speed_u_s == 0 && module.settings.jog_speed != 0) return false;  // as for a move
  module.homed = false;
  // The inputs may have changed since the axis last read them.
  axis.signals = motor.environment.at(axis.travel_pulses);
  const bool forwards = motor.options.chose(option("homing", "at_vj_forwards_to_horg_then_0")) !=
                        (module.settings.jog_speed < 0);
  const motion::Cause refused =
      axis.home(motion::slim_homing({.direction = forwards ? +1 : -1, .jog = law}), begin_at - 1);
  if (refused != motion::Cause::none) return drop_head(module, Error::not_allowed);
  if (!axis.homing.active()) {
    home_found(motor);
    return true;
  }
  take_off(module, MarkEvent::begins);
  module.activity = Activity::home;
  module.fifo[0].begun = true;
  return false;
}

void after_move(const Motor& motor) {
  Module& module = motor.module;
  const bool was_move = module.activity == Activity::move;
  take_off(module, MarkEvent::stands);
  module.place_units = motor.coordinate();
  const motion::Cause cause = motor.axis.cause;
  if (cause == motion::Cause::stopped) return;  // the move is paused, and will continue from here
  if (cause != motion::Cause::arrived) {
    drop_head(module, Error::not_allowed);
  } else if (was_move) {
    module.place_units = module.fifo[0].ends[0];
    module.fifo.pop();
  } else {
    home_found(motor);
  }
}

void hold_motion(const Motor& motor) {
  const Activity activity = motor.module.activity;
  hold_jog(motor);
  if (activity != Activity::move && activity != Activity::home) return;
  motor.axis.slow_down(motor.now);
  after_motion(motor, motor.now + 1);
}

void resume_motion(const Motor& motor) {
  Module& module = motor.module;
  resume_jog(motor);
  if (module.activity != Activity::move) return;
  const motion::SpeedLaw law = module.working_law(motor.options);
  if (law.top_speed_u_s > 0 && motor.axis.resume(law, motor.now)) module.starved = false;
}

bool refresh_speed(const Motor& motor, bool is_held) {
  Module& module = motor.module;
  motion::Axis& axis = motor.axis;
  const bool is_move = module.activity == Activity::move;
  if (!is_move && module.activity != Activity::jog) return true;
  const motion::SpeedLaw law = is_move ? module.working_law(motor.options) : module.jog_law(motor.options);
  const bool stands_still = !is_move && module.settings.jog_speed == 0;
  const bool stops = axis.slowing && !module.starved;  // after JG0, for example
  const bool stops_anyhow = stops || is_held || module.next_jog_direction != 0 || module.next_thrust != 0;
  if (stops_anyhow || (stands_still && axis.task == motion::Task::hanging)) return false;
  if (law.top_speed_u_s == 0) {
    module.starved = true;
    axis.slow_down(motor.now);
    after_motion(motor, motor.now + 1);
  } else if (!module.starved) {
    axis.change_speed(law, motor.now);
  } else {
    module.starved = false;
    const bool stands = !axis.resume(law, motor.now) && !axis.moving();
    if (stands && !is_move) begin_jog(motor, module.jog_direction, motor.now + 1);
  }
  return true;
}

void cut_motion(const Motor& motor, motion::Cause why) {
  Module& module = motor.module;
  motor.axis.stop(why);
  if (module.activity == Activity::move || module.activity == Activity::home) module.fifo.pop();
  if (module.activity != Activity::idle) module.place_units = motor.coordinate();
  take_off(module, MarkEvent::cut);
}

}  // namespace understudy::emulator::models::slim
