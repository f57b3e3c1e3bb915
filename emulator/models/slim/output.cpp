#include "emulator/models/slim/output.h"

#include <cstddef>
#include <string>
#include <string_view>

#include "emulator/models/slim/error_log.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/editor.h"

namespace understudy::emulator::models::slim {

namespace {

constexpr std::size_t kMaxOutput = 256 * 1024;

}  // namespace

void send_line(State& state, const Setup& setup, std::string_view text) {
  if (state.output.size() >= kMaxOutput) return;
  state.output += text;
  state.output += setup.line_end();
}

bool has_room_to_print(const State& state, const Setup& setup) {
  return state.output.size() < static_cast<std::size_t>(setup.number(numbers("print_ahead")));
}

void acknowledge(State& state, const Setup& setup) {
  if (setup.chose(option("acknowledgement", "ok"))) send_line(state, setup, "OK");
}

int fail(State& state, const Setup& setup, int module, Error error) {
  if (!setup.chose(option("error_reply", "nothing"))) {
    send_line(state, setup, "ERR " + std::to_string(setup.code_of(error)));
  }
  return remember_error(state, setup, module, error);
}

void conclude(State& state, const Setup& setup) {
  if (!setup.chose(option("prompt", "greater_than"))) return;
  if (const auto number = next_line_number(state.editor, state.program, setup.language)) {
    state.output += std::to_string(*number);
  }
  state.output += ">";
}

}  // namespace understudy::emulator::models::slim
