// Converts SLIM's state to bytes and back.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/state/state_error.h"
#include "emulator/device/stateful_device_bytes.h"
#include "emulator/models/slim/device.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/state_fields.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/options.h"

namespace understudy {

using namespace emulator::models::slim;

void StateOf<Memory>::check(const Memory& memory) {
  for (const Parameters& all : memory.parameters) {
    for (std::size_t i = 0; i < kParameterCount; ++i) {
      require_state(fitted(kParameters[i], all[i]) == all[i], "a parameter is out of range");
    }
  }
  for (const float real : memory.reals) require_state(std::isfinite(real), "a variable is not finite");
  for (const float real : memory.real_array) require_state(std::isfinite(real), "a variable is not finite");
}

void StateOf<State>::check(const State& state) {
  require_reach(state.powered_at);
  require_reach(state.clock_zero);
}

}  // namespace understudy

namespace understudy::emulator::models::slim {

namespace {

/// Checks programs with the selected options and compiles them from their lines.
void settle_programs(State& state, const lang::Options& options) {
  const std::vector<std::string> texts = state.program.texts();
  require_state(state.program.set_texts(texts, options), "a line is not a program command");
  lang::Program kept;
  require_state(kept.set_texts(state.kept_program, options), "a stored line is not a program command");
  const int capacity = options.number(lang::numbers("program_size"));
  require_within(state.editor.line, 0, capacity);
  require_within(state.execution.line, 0, capacity);
  require_state(is_sound(state.execution, state.program, options), "the program is in an impossible state");
}

}  // namespace

void Slim::check_restored(State& restored) const {
  settle_programs(restored, setup_.language);
  // Further checks depend on the choices in this bench.
  for (const Errors& errors : restored.errors) {
    require_state(errors.history.size() <= setup_.history_length(), "the error history is too long");
  }
  const auto check_integers = [&](const auto& integers) {
    const int min = lang::integer_min(setup_.language);
    for (const std::int16_t value : integers) require_within(value, min, lang::kIntegerMax);
  };
  for (const Memory* const memory : {&restored.ram, &restored.kept}) {
    check_integers(memory->integers);
    check_integers(memory->integer_array);
  }
  restored.chain.set_options(setup_.options);
}

}  // namespace understudy::emulator::models::slim

template class understudy::emulator::StatefulDevice<understudy::emulator::models::slim::Slim,
                                                    understudy::emulator::models::slim::State>;
