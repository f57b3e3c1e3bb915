#include "emulator/models/slim/power.h"

#include <cstddef>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/chain/settings.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/parameters_set.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"

namespace understudy::emulator::models::slim {

void power_up(State& state, const Setup& setup) {
  state.ram = state.kept;
  state.chain = Chain(setup.options);
  state.chain.skip_to(setup.now());
  state.program.clear();
  state.program.set_texts(state.kept_program, setup.language);
  state.powered_at = setup.now();
  state.clock_zero = setup.now();
  state.touched = true;
  for (int m = 0; m < kModules; ++m) state.inputs[static_cast<std::size_t>(m)] = setup.input_levels(m);
  for (int m = 0; m < kModules; ++m) {
    state.chain.settings().set_pulses_per_revolution(m, setup.number(numbers("pulses_per_revolution")));
  }
  apply_all_parameters(state, setup);
  const int map = static_cast<int>(state.ram.parameters[0][parameter("PN37")]);
  for (int letter = 0; letter < kLetters; ++letter) {
    assign_axis(state, setup, static_cast<Letter>(letter), (map >> (4 * letter)) & 0xF);
  }
}

void power_down(State& state, const Setup& setup) {
  State blank;
  blank.kept = std::move(state.kept);
  blank.ram = blank.kept;
  blank.kept_program = std::move(state.kept_program);
  blank.memory_revision = state.memory_revision;
  blank.chain.set_options(setup.options);
  blank.chain.skip_to(setup.now());
  if (setup.history_is_kept()) {
    for (std::size_t m = 0; m < blank.errors.size(); ++m) {
      blank.errors[m].history = std::move(state.errors[m].history);
    }
  }
  state = std::move(blank);
}

void reboot(State& state, const Setup& setup) {
  power_down(state, setup);
  power_up(state, setup);
}

void sample_inputs(State& state, const Setup& setup, Tick tick) {
  state.chain.skip_to(tick - 1);
  for (int m = 0; m < kModules; ++m) {
    state.inputs[static_cast<std::size_t>(m)] = setup.input_levels(m);
    state.chain.set_horg(m, setup.level(m, kHorg));
    state.chain.set_analog(m, setup.input(m, kAnalog));
  }
  state.touched = false;
}

bool sees_something_new(const State& state, const Setup& setup) {
  for (int m = 0; m < kModules; ++m) {
    if (setup.input_levels(m) != state.inputs[static_cast<std::size_t>(m)]) return true;
    const bool sees_horg = setup.level(m, kHorg) == state.chain.horg(m);
    if (!sees_horg || setup.input(m, kAnalog) != state.chain.module_at(m).analog) return true;
  }
  return false;
}

}  // namespace understudy::emulator::models::slim
