// Reports the current line of the program to observers.
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/user_program.h"
#include "emulator/models/simple2_r3/programs.h"
#include "emulator/models/simple2_r3/state.h"
#include "interpreter/simple2/execution/execution.h"
#include "interpreter/simple2/listing.h"
#include "interpreter/simple2/program.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

std::string_view why_of(interpreter::simple2::Ending ending) {
  switch (ending) {
    case interpreter::simple2::Ending::not_started: return "";
    case interpreter::simple2::Ending::end_instruction: return "END";
    case interpreter::simple2::Ending::past_last_line: return "after the last line";
    case interpreter::simple2::Ending::nested_loop: return "a Loop within a Loop";
    case interpreter::simple2::Ending::unknown_command: return "an unknown command";
    case interpreter::simple2::Ending::undefined_operand: return "an operand that does not exist";
    case interpreter::simple2::Ending::stopped: return "stopped from outside";
    case interpreter::simple2::Ending::wait_cut_short: return "a wait ended early";
  }
  return "";
}

bool is_failure(interpreter::simple2::Ending ending) {
  return ending == interpreter::simple2::Ending::nested_loop ||
         ending == interpreter::simple2::Ending::unknown_command ||
         ending == interpreter::simple2::Ending::undefined_operand;
}

/// Returns the listing line that shows this line of the program, and its text. A line of zeros may not have a
/// listing line.
std::pair<int, std::string> listed(const interpreter::simple2::Program& program, std::size_t number) {
  interpreter::simple2::Lines lines = program.lines();
  if (lines[number] == interpreter::simple2::Line{}) return {0, "NOP"};
  // Later lines do not affect how earlier lines are written.
  std::fill(lines.begin() + static_cast<std::ptrdiff_t>(number) + 1, lines.end(),
            interpreter::simple2::Line{});
  std::string text = disassemble(lines);
  text.pop_back();
  const auto count = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
  const std::size_t begin = text.find_last_of('\n');
  text.erase(0, begin == std::string::npos ? 0 : begin + 1);
  text.erase(0, text.find_first_not_of(' '));
  return {count, text};
}

}  // namespace

ProgramLocation program_location(const State& state) {
  const interpreter::simple2::Execution& execution = state.execution;
  ProgramLocation place;
  if (execution.running || execution.ending != interpreter::simple2::Ending::not_started) {
    std::tie(place.line, place.text) = listed(state.program, execution.now_line);
  }
  if (!execution.running) {
    place.state =
        is_failure(execution.ending) ? ProgramLocation::State::failed : ProgramLocation::State::stopped;
    place.why = why_of(execution.ending);
    return place;
  }
  place.state = ProgramLocation::State::waiting;
  if (execution.phase == interpreter::simple2::Phase::delay) {
    place.waits_for = "its delay";
    place.until = time_of(execution.delay_until_ms);
  } else if (execution.phase == interpreter::simple2::Phase::move) {
    place.waits_for = execution.waits_for_a && execution.waits_for_b ? "axes A and B to stop"
                      : execution.waits_for_a                        ? "axis A to stop"
                                                                     : "axis B to stop";
  } else if (execution.waits || execution.held.command != 0) {
    place.waits_for = place.text;
  } else {
    place.state = ProgramLocation::State::running;
  }
  return place;
}

}  // namespace understudy::emulator::models::simple2_r3
