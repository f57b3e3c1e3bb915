// Sets the inputs of a chain, and answers queries about its state.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/settings.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/outputs.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::slim {

void Chain::set_options(const ChainOptions& options) {
  state_.options = options;
  state_.options.noted.decisions = options.noted.decisions;
}

// ---- Inputs

void Chain::set_horg(int module, bool on) {
  motion::Environment& environment = state_.environment[at(module)];
  if (((environment.steady & motion::bit(motion::Signal::home)) != 0) == on) return;
  environment.set_steady(motion::Signal::home, on);
}

void Chain::set_analog(int module, int value) {
  Module& mine = state_.modules[at(module)];
  const auto clamped = static_cast<std::int16_t>(std::clamp(value, 0, kFullAnalog));
  if (clamped == mine.analog) return;
  mine.analog = clamped;
  if (mine.analog_speed) refresh_speed(state_, module);
}

// ---- State

bool Chain::moving(int module) const {
  const Module& mine = module_at(module);
  if (const Group* group = state_.group_of(module); group != nullptr) {
    return !group->motion.run.paused() || !group->motion.run.at_rest(state_.now);
  }
  const bool pushes = mine.activity == Activity::thrust && !options().thrust_runs();
  return !pushes && state_.axes[at(module)].moving();
}

bool Chain::done(int module) const {
  const Module& mine = module_at(module);
  if (!mine.fifo.empty()) return false;
  if (options().chose(option("done", "jogs_thrust_and_pulses_too"))) {
    const bool pulses = std::any_of(mine.outputs.begin(), mine.outputs.end(), [&](const Output& output) {
      return output.mode == Output::Mode::pulse && output.next_change(state_.now) != kNever;
    });
    return !pulses && mine.activity == Activity::idle && !mine.holds_jog();
  }
  return mine.activity == Activity::idle || (mine.jogs_or_pushes() && !state_.axes[at(module)].slowing);
}

ModuleStatus Chain::status(int module) const {
  const Activity activity = module_at(module).activity_or_held();
  const Module& mine = module_at(module);
  const Group* group = state_.group_of(module);
  ModuleStatus status{.servo_on = state_.axes[at(module)].servo_on,
                      .moving = moving(module),
                      .paused = state_.held(module),
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

double Chain::speed_pps(int module) const {
  const motion::Axis& axis = state_.axes[at(module)];
  if (state_.modules[at(module)].activity == Activity::group) {
    double speed_pps = 0;
    for (const Group& group : state_.groups) speed_pps += group.motion.speed_pps(at(module), state_.now);
    return speed_pps;
  }
  if (!axis.moving()) return 0;
  return axis.sample(state_.now).speed_u_s * static_cast<double>(axis.drive.direction);
}

std::int64_t Chain::pulses_to_come(int module) const {
  if (state_.modules[at(module)].activity != Activity::group) return state_.axes[at(module)].pulses_to_come();
  std::int64_t pulses = 0;
  for (const Group& group : state_.groups) pulses += group.motion.pulses_to_come(at(module), state_.axes);
  return pulses;
}

Error Chain::take_late_error(int module) {
  return std::exchange(state_.modules[at(module)].late_error, Error::none);
}

int Chain::groups_running() const {
  return static_cast<int>(std::count_if(state_.groups.begin(), state_.groups.end(),
                                        [](const Group& group) { return group.motion.engaged; }));
}

}  // namespace understudy::emulator::models::slim
