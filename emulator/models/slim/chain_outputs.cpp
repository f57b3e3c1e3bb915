// Outputs of a module, in their turn and at once.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain.h"
#include "emulator/models/slim/jobs.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/outputs.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "motion/axis.h"

namespace understudy::emulator::models::slim {

namespace {

/// An hour and more of ticks; PLS's bound is not stated.
constexpr std::int32_t kLongestPulse = 1'000'000;
constexpr double kFastestPwm_hz = 1e6;

bool is_output(int output) { return output >= 1 && output <= kOutputs; }
std::uint8_t index_of(int output) { return static_cast<std::uint8_t>(output - 1); }

}  // namespace

Error Chain::enqueue_output(int module, const OutputOrder& order) {
  if (const Error why = refusal(module); why != Error::none) return why;
  Job job{.kind = Job::Kind::output, .output = order};
  job.module_of[0] = static_cast<std::int8_t>(module);
  return enqueue(job);
}

Error Chain::set_output(int module, int output, bool on) {
  if (!is_output(output)) return Error::range;
  return enqueue_output(
      module, {.kind = on ? OutputOrder::Kind::set : OutputOrder::Kind::clear, .output = index_of(output)});
}

Error Chain::set_output_at_once(int module, int output, bool on) {
  if (const Error why = refusal(module); why != Error::none) return why;
  if (!is_output(output)) return Error::range;
  modules_[at(module)].outputs[index_of(output)] = {.on = on};
  return Error::none;
}

Error Chain::toggle_output(int module, int output) {
  if (!is_output(output)) return Error::range;
  return enqueue_output(module, {.kind = OutputOrder::Kind::toggle, .output = index_of(output)});
}

Error Chain::pulse_output(int module, int output, std::int32_t width_4ms) {
  if (!is_output(output) || width_4ms < 1 || width_4ms > kLongestPulse) return Error::range;
  return enqueue_output(
      module,
      {.kind = OutputOrder::Kind::pulse, .output = index_of(output), .width = width_4ms * kPulseUnit});
}

Error Chain::pwm(int module, int output, double frequency_hz, double duty_percent) {
  const bool fits =
      frequency_hz >= 0.001 && frequency_hz <= kFastestPwm_hz && duty_percent >= 0 && duty_percent <= 100;
  if (!is_output(output) || !fits) return Error::range;
  return enqueue_output(module, {.kind = OutputOrder::Kind::pwm,
                                 .output = index_of(output),
                                 .frequency_hz = frequency_hz,
                                 .duty_percent = duty_percent});
}

Error Chain::set_outputs(int module, int mask) {
  if (mask < 0 || mask >= 1 << kOutputs) return Error::range;
  unsigned levels = 0;
  for (int bit = 0; bit < kOutputs; ++bit) {
    const int output = options_.chose(option("output_order", "p4")) ? kOutputs - 1 - bit : bit;
    levels |= ((static_cast<unsigned>(mask) >> bit) & 1U) << output;
  }
  return enqueue_output(module, {.kind = OutputOrder::Kind::all, .mask = static_cast<std::uint8_t>(levels)});
}

Error Chain::arm(int module, int trigger, int output, bool sets, double at_units) {
  if (const Error why = refusal(module); why != Error::none) return why;
  const bool fits = is_output(output) && (trigger == 1 || trigger == 2);
  if (!fits || !modules_[at(module)].reaches(at_units)) return Error::range;
  return enqueue_output(module, {.kind = OutputOrder::Kind::arm,
                                 .output = index_of(output),
                                 .trigger = static_cast<std::uint8_t>(trigger - 1),
                                 .trigger_sets = sets,
                                 .at_units = at_units});
}

void Chain::carry_out_order(int module, const OutputOrder& order, Tick begin_at) {
  Module& mine = modules_[at(module)];
  switch (order.kind) {
    case OutputOrder::Kind::all:
      for (std::size_t i = 0; i < mine.outputs.size(); ++i) {
        mine.outputs[i] = {.on = (order.mask >> i & 1) != 0};
      }
      break;
    case OutputOrder::Kind::arm:
      mine.triggers[order.trigger] = {
          .armed = true, .sets = order.trigger_sets, .output = order.output, .at_units = order.at_units};
      place_triggers(module);
      break;
    case OutputOrder::Kind::set:
    case OutputOrder::Kind::clear:
    case OutputOrder::Kind::toggle:
    case OutputOrder::Kind::pulse:
    case OutputOrder::Kind::pwm: carry_out(mine.outputs[order.output], order, begin_at); break;
  }
}

/// Where the triggers are in the axis's travel. One at the very place waits until it is reached anew.
void Chain::place_triggers(int module) {
  const Module& mine = modules_[at(module)];
  for (std::size_t i = 0; i < mine.triggers.size(); ++i) {
    axes_[at(module)].set_comparator(i, {});
    if (!mine.triggers[i].armed || !mine.reaches(mine.triggers[i].at_units)) continue;
    axes_[at(module)].set_comparator(i,
                                     {.relation = motion::Comparator::Relation::equal,
                                      .value = mine.zero_pulses + mine.pulses_of(mine.triggers[i].at_units)});
  }
}

void Chain::meet_triggers(int module, motion::Events events) {
  Module& mine = modules_[at(module)];
  for (std::size_t i = 0; i < mine.triggers.size(); ++i) {
    const auto event = static_cast<motion::Event>(static_cast<unsigned>(motion::Event::comparator_0) + i);
    PositionTrigger& trigger = mine.triggers[i];
    if (!trigger.armed || (events & motion::bit(event)) == 0) continue;
    mine.outputs[trigger.output] = {.on = trigger.sets};
    if (triggers_stay()) continue;
    trigger = {};
    axes_[at(module)].set_comparator(i, {});
  }
}

/// By choice, what goes on by itself: pulses and PWM end, and no place switches any more. Levels stay.
void Chain::stop_outputs(int module) {
  if (!options_.chose(option("outputs_at_stop", "end"))) return;
  Module& mine = modules_[at(module)];
  for (Output& output : mine.outputs) {
    if (output.mode != Output::Mode::level) output = {};
  }
  mine.triggers = {};
  place_triggers(module);
}

bool Chain::output(int module, int number) const { return output_state(module, number).level_at(now_); }

const Output& Chain::output_state(int module, int number) const {
  return modules_[at(module)].outputs[at(number - 1)];
}

}  // namespace understudy::emulator::models::slim
