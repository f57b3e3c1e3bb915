#include "emulator/models/slim/program_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "base/state/state_bytes.h"
#include "base/text/most_mistakes.h"
#include "emulator/device/program_error.h"
#include "emulator/device/user_program.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/rules/pauses.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/program.h"
#include "interpreter/slim/unknown_line.h"
#include "interpreter/slim/verbs.h"

namespace understudy::emulator::models::slim {

bool program_is_held(const State& state, const Setup& setup) {
  const bool is_paused =
      state.chain.queues_paused() || (setup.chose(pauses::kOnePause) && state.chain.paused());
  return setup.chose(option("pause_and_program", "program_pauses_too")) && is_paused;
}

ReadProgram read_program(const Setup& setup, std::string_view text) {
  ReadProgram read;
  std::istringstream lines{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const std::size_t first = line.find_first_not_of(" \t");
    // Files may contain empty lines and comments.
    if (first == std::string::npos || line[first] == ';' || line[first] == '#') continue;
    const Error error = read.program.insert(read.program.size(), line, setup.language);
    if (error == Error::none) {
      read.text_lines.push_back(number);
      continue;
    }
    const std::string lines_that_fit = std::to_string(setup.language.number(lang::numbers("program_size")));
    const std::string what =
        error == Error::buffer_full   ? "the program is full; expected at most " + lines_that_fit + " lines"
        : error == Error::range       ? "has a value out of range"
        : error == Error::not_allowed ? "is not allowed in a program"
        : error == Error::address     ? "begins with a label that another line has"
                                      : lang::why_not_command(std::string_view(line).substr(first));
    read.mistakes.push_back({number, static_cast<int>(first) + 1, what});
    if (error == Error::buffer_full) break;  // none of the remaining lines would fit
    if (read.mistakes.size() >= kMaxMistakes) break;
  }
  return read;
}

ProgramPart part_of(const ReadProgram& read) {
  ProgramPart part;
  for (int i = 0; i < read.program.size(); ++i) {
    const lang::StoredLine& line = read.program.line(i);
    const auto& command = line.parsed.command;
    part.lines.push_back({.text_line = read.text_lines[static_cast<std::size_t>(i)],
                          .code = line.text,
                          .decides = command && lang::is_one_of(lang::kDecidingVerbs, command->verb)});
  }
  return part;
}

std::uint64_t mark_of(const lang::Program& program) {
  std::uint64_t mark = hash_of({});
  for (int i = 0; i < program.size(); ++i) {
    const std::string& text = program.line(i).text;
    // The terminating null separates the lines.
    mark = hash_of(std::as_bytes(std::span(text.c_str(), text.size() + 1)), mark);
  }
  return mark;
}

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

std::vector<ProgramLocation> program_locations(const State& state, const Setup& setup) {
  const lang::Execution& execution = state.execution;
  ProgramLocation place;
  const auto& stack = execution.stack;
  std::for_each(stack.rbegin(), stack.rend(),
                [&](const lang::Frame& frame) { place.callers.push_back(frame.line + 1); });
  const bool has_run = execution.running || execution.ending != lang::Ending::not_started;
  if (has_run && execution.line >= 0 && execution.line < state.program.size()) {
    place.line = execution.line + 1;
    place.text = state.program.line(execution.line).text;
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
  if (program_is_held(state, setup)) {
    place.state = ProgramLocation::State::waiting;
    place.waits_for = "the pause to end";
  }
  return {place};
}

}  // namespace understudy::emulator::models::slim
