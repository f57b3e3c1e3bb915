// Settings, inputs and what can be asked.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/outputs.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/environment.h"

namespace understudy::emulator::models::slim {

namespace {

// Of a speed or an acceleration, in its own unit.
bool plannable(double value) { return value >= kMinSpeed && value <= kMaxSpeed; }

}  // namespace

// ---- Settings

void Chain::set_linked(int module, bool linked) { modules_[at(module)].linked = linked || module == 0; }

Error Chain::set_scale(int module, std::int64_t multiplier, std::int64_t divider) {
  Module& mine = modules_[at(module)];
  if (mine.activity != Activity::idle || !mine.fifo.empty()) return Error::not_allowed;
  try {
    mine.settings.scale = motion::UnitScale::of(multiplier, divider);
  } catch (const motion::BadMotion&) {
    return Error::range;
  }
  mine.place_units = coordinate(module);
  place_triggers(module);
  return Error::none;
}

Error Chain::set_pulses_per_revolution(int module, std::int32_t pulses) {
  if (pulses < 1) return Error::range;
  modules_[at(module)].settings.pulses_per_revolution = pulses;
  return Error::none;
}

Error Chain::set_speed_unit(int module, SpeedUnit unit) {
  modules_[at(module)].settings.speed_unit = unit;
  return Error::none;
}

Error Chain::set_working_speed(int module, double rpm_or_rps) {
  if (!plannable(rpm_or_rps)) return Error::range;
  Module& mine = modules_[at(module)];
  mine.settings.working_speed = rpm_or_rps;
  mine.analog_speed = false;
  if (mine.starved || new_speed_counts_at_once()) refresh_speed(module);
  serve(now_ + 1);  // a move may have waited for AVM's voltage
  return Error::none;
}

Error Chain::set_jog_speed(int module, double rpm_or_rps) {
  if (rpm_or_rps != 0 && !plannable(std::abs(rpm_or_rps))) return Error::range;
  Module& mine = modules_[at(module)];
  const bool same_sense = rpm_or_rps * mine.settings.jog_speed > 0;
  mine.settings.jog_speed = rpm_or_rps;
  // A jog that is to turn round, or to stand, is another one.
  if (mine.activity == Activity::jog && same_sense && new_speed_counts_at_once()) refresh_speed(module);
  return Error::none;
}

Error Chain::set_acceleration(int module, double rpm_or_rps_per_s) {
  if (!plannable(rpm_or_rps_per_s)) return Error::range;
  modules_[at(module)].settings.acceleration = rpm_or_rps_per_s;
  return Error::none;
}

Error Chain::set_path_speed(int module, double units_s) {
  if (!plannable(units_s)) return Error::range;
  modules_[at(module)].settings.path_speed_units_s = units_s;
  tell_path(module, units_s, false);
  return Error::none;
}

Error Chain::set_line_speed(int module, double units_s) {
  if (!plannable(units_s)) return Error::range;
  modules_[at(module)].settings.line_speed_units_s = units_s;
  tell_path(module, units_s, true);
  return Error::none;
}

/// A new speed of a module that is on a path.
void Chain::tell_path(int module, double units_s, bool of_lines) {
  Group* const group = group_of(module);
  if (group == nullptr || options_.chose(option("path_speed_in_motion", "next_command"))) return;
  const bool is_x = group->motion.axis_of[0] == module;
  if (options_.chose(option("path_speed_in_motion", "at_once_if_x_has_it")) && !is_x) return;
  const bool is_line = group->paths > 0 && goes_by_line_speed(modules_[at(group->motion.axis_of[0])].fifo[0]);
  if (is_line == of_lines) group->motion.run.set_top_speed(units_s, now_);
}

Error Chain::set_tvm(double units_s) {
  if (!plannable(units_s)) return Error::range;
  for (Module& each : modules_) {
    if (each.linked) each.settings.path_speed_units_s = units_s;
  }
  for (Group& group : groups_) {
    if (group.motion.engaged) group.motion.run.set_top_speed(units_s, now_);
  }
  return Error::none;
}

Error Chain::set_path_acceleration(int module, double units_s2) {
  if (!plannable(units_s2)) return Error::range;
  if (group_of(module) != nullptr && !acceleration_may_change()) return Error::not_allowed;
  modules_[at(module)].settings.path_acceleration_units_s2 = units_s2;
  return Error::none;
}

Error Chain::set_smooth_corner(int module, double degrees) {
  if (!(degrees >= 0 && degrees <= 180)) return Error::range;
  modules_[at(module)].settings.smooth_corner_deg = degrees;
  return Error::none;
}

Error Chain::set_analog_speed(int module) {
  const bool jogs = options_.chose(option("analog_speed", "starts_a_jog"));
  if (const Error why = jogs ? refusal_of_jog(module) : refusal(module); why != Error::none) return why;
  modules_[at(module)].analog_speed = true;
  refresh_speed(module);
  return jogs ? replace_jog(module, +1, 0) : Error::none;
}

void Chain::set_options(const ChainOptions& options) { options_ = options; }

// ---- Inputs

void Chain::set_horg(int module, bool on) {
  motion::Environment& environment = environment_[at(module)];
  if (((environment.steady & motion::bit(motion::Signal::home)) != 0) == on) return;
  environment.set_steady(motion::Signal::home, on);
}

void Chain::set_analog(int module, int value) {
  Module& mine = modules_[at(module)];
  const auto clamped = static_cast<std::int16_t>(std::clamp(value, 0, kFullAnalog));
  if (clamped == mine.analog) return;
  mine.analog = clamped;
  if (mine.analog_speed) refresh_speed(module);
}

// ---- State

bool Chain::busy(int module) const {
  const Module& mine = modules_[at(module)];
  return mine.activity != Activity::idle || !mine.fifo.empty() || mine.holds_jog();
}

bool Chain::moving(int module) const {
  const Module& mine = modules_[at(module)];
  if (const Group* group = group_of(module); group != nullptr) {
    return !group->motion.run.paused() || !group->motion.run.at_rest(now_);
  }
  const bool pushes = mine.activity == Activity::thrust && !thrust_runs();
  return !pushes && axes_[at(module)].moving();
}

bool Chain::done(int module) const {
  const Module& mine = modules_[at(module)];
  if (!mine.fifo.empty()) return false;
  if (options_.chose(option("done", "jogs_thrust_and_pulses_too"))) {
    const bool pulses = std::any_of(mine.outputs.begin(), mine.outputs.end(), [&](const Output& output) {
      return output.mode == Output::Mode::pulse && output.next_change(now_) != kNever;
    });
    return !pulses && mine.activity == Activity::idle && !mine.holds_jog();
  }
  const bool goes_on = mine.activity == Activity::jog || mine.activity == Activity::thrust;
  return mine.activity == Activity::idle || (goes_on && !axes_[at(module)].slowing);
}

Activity Chain::activity_or_held(int module) const {
  const Module& mine = modules_[at(module)];
  if (mine.activity != Activity::idle) return mine.activity;
  if (mine.held_thrust != 0) return Activity::thrust;
  if (mine.held_jog_direction != 0) return Activity::jog;
  if (mine.fifo.empty() || !mine.fifo[0].begun) return Activity::idle;
  return mine.fifo[0].kind == Job::Kind::home ? Activity::home : Activity::move;
}

ModuleStatus Chain::status(int module) const {
  const Activity activity = activity_or_held(module);
  const Module& mine = modules_[at(module)];
  const Group* group = group_of(module);
  ModuleStatus status{.servo_on = axes_[at(module)].servo_on,
                      .moving = moving(module),
                      .paused = held(module),
                      .homed = mine.homed,
                      .jog = activity == Activity::jog,
                      .buffer_not_empty = !mine.fifo.empty()};
  if (group != nullptr && group->motion.run.running()) {
    const motion::PathRun& run = group->motion.run;
    status.in_blend = run.chain_length_u() != run.path().length_u;
  }
  switch (activity) {
    case Activity::idle: status.mode = mine.analog_speed ? Mode::analog : Mode::idle; break;
    case Activity::move:
    case Activity::home:
    case Activity::stopping: status.mode = mine.analog_speed ? Mode::analog : Mode::position; break;
    case Activity::jog: status.mode = mine.analog_speed ? Mode::analog : Mode::jog; break;
    case Activity::thrust: status.mode = Mode::torque; break;
    case Activity::group: status.mode = Mode::coordinated; break;
  }
  return status;
}

double Chain::coordinate(int module) const {
  const Module& mine = modules_[at(module)];
  return mine.units_of(axes_[at(module)].travel_pulses - mine.zero_pulses);
}

double Chain::speed_pps(int module) const {
  const motion::Axis& axis = axes_[at(module)];
  if (modules_[at(module)].activity == Activity::group) {
    double speed_pps = 0;
    for (const Group& group : groups_) speed_pps += group.motion.speed_pps(at(module), now_);
    return speed_pps;
  }
  if (!axis.moving()) return 0;
  return axis.sample(now_).speed_u_s * static_cast<double>(axis.drive.direction);
}

std::int64_t Chain::pulses_to_come(int module) const {
  if (modules_[at(module)].activity != Activity::group) return axes_[at(module)].pulses_to_come();
  std::int64_t pulses = 0;
  for (const Group& group : groups_) pulses += group.motion.pulses_to_come(at(module), axes_);
  return pulses;
}

Error Chain::take_late_error(int module) {
  return std::exchange(modules_[at(module)].late_error, Error::none);
}

int Chain::groups_running() const {
  return static_cast<int>(
      std::count_if(groups_.begin(), groups_.end(), [](const Group& group) { return group.motion.engaged; }));
}

}  // namespace understudy::emulator::models::slim
