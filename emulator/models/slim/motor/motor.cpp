#include "emulator/models/slim/motor/motor.h"

#include <cstddef>

#include "base/simulated_time.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/outputs.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/axis.h"

namespace understudy::emulator::models::slim {

void set_coordinate(const Motor& motor, double units) {
  motor.module.zero_pulses = motor.axis.travel_pulses - motor.module.pulses_of(units);
  motor.module.place_units = units;
  place_triggers(motor);
}

void carry_out(const Motor& motor, const OutputOrder& order, Tick begin_at) {
  Module& module = motor.module;
  switch (order.kind) {
    case OutputOrder::Kind::all:
      for (std::size_t i = 0; i < module.outputs.size(); ++i) {
        module.outputs[i] = {.on = (order.mask >> i & 1) != 0};
      }
      break;
    case OutputOrder::Kind::arm:
      module.triggers[order.trigger] = {
          .armed = true, .sets = order.trigger_sets, .output = order.output, .at_units = order.at_units};
      place_triggers(motor);
      break;
    case OutputOrder::Kind::set:
    case OutputOrder::Kind::clear:
    case OutputOrder::Kind::toggle:
    case OutputOrder::Kind::pulse:
    case OutputOrder::Kind::pwm: carry_out(module.outputs[order.output], order, begin_at); break;
  }
}

void place_triggers(const Motor& motor) {
  const Module& module = motor.module;
  for (std::size_t i = 0; i < module.triggers.size(); ++i) {
    const PositionTrigger& trigger = module.triggers[i];
    motor.axis.set_comparator(i, {});
    if (!trigger.armed || !module.reaches(trigger.at_units)) continue;
    motor.axis.set_comparator(i, {.relation = motion::Comparator::Relation::equal,
                                  .value = module.zero_pulses + module.pulses_of(trigger.at_units)});
  }
}

void pass_triggers(const Motor& motor, motion::Events events) {
  Module& module = motor.module;
  for (std::size_t i = 0; i < module.triggers.size(); ++i) {
    const auto event = static_cast<motion::Event>(static_cast<unsigned>(motion::Event::comparator_0) + i);
    PositionTrigger& trigger = module.triggers[i];
    if (!trigger.armed || (events & motion::bit(event)) == 0) continue;
    module.outputs[trigger.output] = {.on = trigger.sets};
    if (motor.options.triggers_stay()) continue;
    trigger = {};
    motor.axis.set_comparator(i, {});
  }
}

void stop_outputs(const Motor& motor) {
  if (!motor.options.chose(option("outputs_at_stop", "end"))) return;
  for (Output& output : motor.module.outputs) {
    if (output.mode != Output::Mode::level) output = {};
  }
  motor.module.triggers = {};
  place_triggers(motor);
}

}  // namespace understudy::emulator::models::slim
