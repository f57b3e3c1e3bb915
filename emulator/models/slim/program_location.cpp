// Where its program is, for observers.
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/user_program.h"
#include "emulator/models/slim/device.h"
#include "interpreter/slim/flow.h"

namespace understudy::emulator::models::slim {

namespace {

std::string_view word_for_ending(lang::Ending ending) {
  switch (ending) {
    case lang::Ending::not_started: return "";
    case lang::Ending::returned: return "RET";
    case lang::Ending::past_last_line: return "after the last line";
    case lang::Ending::exited: return "stopped from outside";
    case lang::Ending::failed: return "a line failed";
  }
  return "";
}

std::string_view word_for_hold(lang::Hold hold) {
  switch (hold) {
    case lang::Hold::nothing: return "";
    case lang::Hold::timer: return "its time";
    case lang::Hold::input: return "an input";
    case lang::Hold::window: return "an input, or its time";
    case lang::Hold::machine: return "the module to be free";
    case lang::Hold::number: return "a number from the host";
  }
  return "";
}

}  // namespace

std::vector<ProgramLocation> Slim::program_locations() const {
  const lang::Execution& execution = state_.execution;
  ProgramLocation place;
  const bool has_run = execution.running || execution.ending != lang::Ending::not_started;
  if (has_run && execution.line >= 0 && execution.line < state_.program.size()) {
    place.line = execution.line + 1;
    place.text = state_.program.line(execution.line).text;
  }
  if (!execution.running) {
    const bool has_failed = execution.ending == lang::Ending::failed;
    place.state = has_failed ? ProgramLocation::State::failed : ProgramLocation::State::stopped;
    place.why = word_for_ending(execution.ending);
    return {place};
  }
  place.state = execution.hold == lang::Hold::nothing ? ProgramLocation::State::running
                                                      : ProgramLocation::State::waiting;
  place.waits_for = word_for_hold(execution.hold);
  if (execution.hold == lang::Hold::timer || execution.hold == lang::Hold::window) {
    place.until = time_of(execution.until_ms);
  }
  if (program_is_held()) {
    place.state = ProgramLocation::State::waiting;
    place.waits_for = "the pause to end";
  }
  return {place};
}

}  // namespace understudy::emulator::models::slim
