// Commands for the outputs of a module, both queued and immediate.
#include <cstddef>
#include <cstdint>

#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/chain/chain_state.h"
#include "emulator/models/slim/chain/queues.h"
#include "emulator/models/slim/chain/refusals.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/motor/outputs.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"

namespace understudy::emulator::models::slim {

namespace {

/// In units of 4 ms: a little more than an hour. The manual states no limit for PLS.
constexpr std::int32_t kLongestPulse = 1'000'000;
constexpr double kFastestPwm_hz = 1e6;

bool is_output(int output) { return output >= 1 && output <= kOutputs; }
std::uint8_t index_of(int output) { return static_cast<std::uint8_t>(output - 1); }

Error enqueue_output(ChainState& chain, int module, const OutputOrder& order) {
  if (const Error why = refusal(chain, module); why != Error::none) return why;
  return enqueue(chain, job_of(module, {.kind = Job::Kind::output, .output = order}));
}

}  // namespace

Error Chain::set_output(int module, int output, bool on) {
  if (!is_output(output)) return Error::range;
  return enqueue_output(
      state_, module,
      {.kind = on ? OutputOrder::Kind::set : OutputOrder::Kind::clear, .output = index_of(output)});
}

Error Chain::set_output_at_once(int module, int output, bool on) {
  if (const Error why = refusal(state_, module); why != Error::none) return why;
  if (!is_output(output)) return Error::range;
  state_.modules[at(module)].outputs[index_of(output)] = {.on = on};
  return Error::none;
}

Error Chain::toggle_output(int module, int output) {
  if (!is_output(output)) return Error::range;
  return enqueue_output(state_, module, {.kind = OutputOrder::Kind::toggle, .output = index_of(output)});
}

Error Chain::pulse_output(int module, int output, std::int32_t width_4ms) {
  if (!is_output(output) || width_4ms < 1 || width_4ms > kLongestPulse) return Error::range;
  return enqueue_output(
      state_, module,
      {.kind = OutputOrder::Kind::pulse, .output = index_of(output), .width = width_4ms * kPulseUnit});
}

Error Chain::pwm(int module, int output, double frequency_hz, double duty_percent) {
  const bool fits =
      frequency_hz >= 0.001 && frequency_hz <= kFastestPwm_hz && duty_percent >= 0 && duty_percent <= 100;
  if (!is_output(output) || !fits) return Error::range;
  return enqueue_output(state_, module,
                        {.kind = OutputOrder::Kind::pwm,
                         .output = index_of(output),
                         .frequency_hz = frequency_hz,
                         .duty_percent = duty_percent});
}

Error Chain::set_outputs(int module, int mask) {
  if (mask < 0 || mask >= 1 << kOutputs) return Error::range;
  unsigned levels = 0;
  for (int bit = 0; bit < kOutputs; ++bit) {
    const int output = options().chose(option("output_order", "p4")) ? kOutputs - 1 - bit : bit;
    levels |= ((static_cast<unsigned>(mask) >> bit) & 1U) << output;
  }
  return enqueue_output(state_, module,
                        {.kind = OutputOrder::Kind::all, .mask = static_cast<std::uint8_t>(levels)});
}

Error Chain::arm(int module, int trigger, int output, bool sets, double at_units) {
  if (const Error why = refusal(state_, module); why != Error::none) return why;
  const bool fits = is_output(output) && (trigger == 1 || trigger == 2);
  if (!fits || !module_at(module).reaches(at_units)) return Error::range;
  return enqueue_output(state_, module,
                        {.kind = OutputOrder::Kind::arm,
                         .output = index_of(output),
                         .trigger = static_cast<std::uint8_t>(trigger - 1),
                         .trigger_sets = sets,
                         .at_units = at_units});
}

}  // namespace understudy::emulator::models::slim
