#include "emulator/models/slim/chain/settings.h"

#include <cmath>
#include <cstdint>

#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/paths.h"
#include "emulator/models/slim/chain/queues.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/motor.h"
#include "emulator/models/slim/motor/moves.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/bad_motion.h"
#include "motion/unit_scale.h"

namespace understudy::emulator::models::slim {

namespace {

// Also used for accelerations; each quantity has its own unit.
bool plannable(double value) { return value >= kMinSpeed && value <= kMaxSpeed; }

}  // namespace

void refresh_speed(ChainState& chain, int module) {
  if (refresh_speed(chain.motor(module), chain.held(module))) serve(chain, chain.now + 1);
}

void ChainSettings::set_linked(int module, bool linked) {
  chain_.modules[at(module)].linked = linked || module == 0;
}

Error ChainSettings::set_scale(int module, std::int64_t multiplier, std::int64_t divider) {
  Module& mine = chain_.modules[at(module)];
  if (mine.activity != Activity::idle || !mine.fifo.empty()) return Error::not_allowed;
  try {
    mine.settings.scale = motion::UnitScale::of(multiplier, divider);
  } catch (const motion::BadMotion&) {
    return Error::range;
  }
  const Motor motor = chain_.motor(module);
  mine.place_units = motor.coordinate();
  place_triggers(motor);
  return Error::none;
}

Error ChainSettings::set_pulses_per_revolution(int module, std::int32_t pulses) {
  if (pulses < 1) return Error::range;
  chain_.modules[at(module)].settings.pulses_per_revolution = pulses;
  return Error::none;
}

Error ChainSettings::set_speed_unit(int module, SpeedUnit unit) {
  chain_.modules[at(module)].settings.speed_unit = unit;
  return Error::none;
}

Error ChainSettings::set_working_speed(int module, double rpm_or_rps) {
  if (!plannable(rpm_or_rps)) return Error::range;
  Module& mine = chain_.modules[at(module)];
  mine.settings.working_speed = rpm_or_rps;
  mine.analog_speed = false;
  if (mine.starved || chain_.options.new_speed_counts_at_once()) refresh_speed(chain_, module);
  serve(chain_, chain_.now + 1);  // a move may have been waiting for AVM's voltage
  return Error::none;
}

Error ChainSettings::set_jog_speed(int module, double rpm_or_rps) {
  if (rpm_or_rps != 0 && !plannable(std::abs(rpm_or_rps))) return Error::range;
  Module& mine = chain_.modules[at(module)];
  const bool same_sense = rpm_or_rps * mine.settings.jog_speed > 0;
  mine.settings.jog_speed = rpm_or_rps;
  // A jog that must reverse or stop counts as a new jog.
  const bool counts_at_once = same_sense && chain_.options.new_speed_counts_at_once();
  if (mine.activity == Activity::jog && counts_at_once) refresh_speed(chain_, module);
  return Error::none;
}

Error ChainSettings::set_acceleration(int module, double rpm_or_rps_per_s) {
  if (!plannable(rpm_or_rps_per_s)) return Error::range;
  chain_.modules[at(module)].settings.acceleration = rpm_or_rps_per_s;
  return Error::none;
}

Error ChainSettings::set_path_speed(int module, double units_s) {
  if (!plannable(units_s)) return Error::range;
  chain_.modules[at(module)].settings.path_speed_units_s = units_s;
  change_path_speed(module, units_s, false);
  return Error::none;
}

Error ChainSettings::set_line_speed(int module, double units_s) {
  if (!plannable(units_s)) return Error::range;
  chain_.modules[at(module)].settings.line_speed_units_s = units_s;
  change_path_speed(module, units_s, true);
  return Error::none;
}

/// Applies a module's new speed to the path that the module is on.
void ChainSettings::change_path_speed(int module, double units_s, bool of_lines) {
  Group* const group = chain_.group_of(module);
  const ChainOptions& options = chain_.options;
  if (group == nullptr || options.chose(option("path_speed_in_motion", "next_command"))) return;
  const bool is_x = group->motion.axis_of[0] == module;
  if (options.chose(option("path_speed_in_motion", "at_once_if_x_has_it")) && !is_x) return;
  const auto& fifo_of_x = chain_.modules[at(group->motion.axis_of[0])].fifo;
  const bool is_line = group->paths > 0 && goes_by_line_speed(options, fifo_of_x[0]);
  if (is_line == of_lines) group->motion.run.set_top_speed(units_s, chain_.now);
}

Error ChainSettings::set_tvm(double units_s) {
  if (!plannable(units_s)) return Error::range;
  for (Module& each : chain_.modules) {
    if (each.linked) each.settings.path_speed_units_s = units_s;
  }
  for (Group& group : chain_.groups) {
    if (group.motion.engaged) group.motion.run.set_top_speed(units_s, chain_.now);
  }
  return Error::none;
}

Error ChainSettings::set_path_acceleration(int module, double units_s2) {
  if (!plannable(units_s2)) return Error::range;
  if (chain_.group_of(module) != nullptr && !chain_.options.acceleration_may_change())
    return Error::not_allowed;
  chain_.modules[at(module)].settings.path_acceleration_units_s2 = units_s2;
  return Error::none;
}

Error ChainSettings::set_smooth_corner(int module, double degrees) {
  if (!(degrees >= 0 && degrees <= 180)) return Error::range;
  chain_.modules[at(module)].settings.smooth_corner_deg = degrees;
  return Error::none;
}

}  // namespace understudy::emulator::models::slim
