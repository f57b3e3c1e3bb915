// Reports the current lines of the macros to observers.
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/lines.h"
#include "emulator/device/user_program.h"
#include "emulator/models/rs_m8194h/programs/programs.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/text.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

std::string_view awaited_by(lang::Hold hold) {
  switch (hold) {
    case lang::Hold::nothing: return "";
    case lang::Hold::begin: return "its first tick";
    case lang::Hold::timer: return "its time";
    case lang::Hold::axes: return "axes to stop";
    case lang::Hold::frnet: return "an input of the FRnet";
    case lang::Hold::machine: return "the drive to accept it";
  }
  return "";
}

/// Returns the text line of line `number` of a macro, counted from the macro's head, "MP 21".
int line_in(std::string_view text, const std::string& head, int number) {
  for (const TextLine line : TextLines(text)) {
    if (line.text == head) return line.number + 1 + number;
  }
  return 0;
}

}  // namespace

std::vector<ProgramLocation> Programs::locations() const {
  std::vector<ProgramLocation> all;
  std::string text;
  const auto tell = [&](const lang::Run& run) {
    if (!run.is_alive()) return;
    if (text.empty()) text = this->text();
    const lang::Level& level = run.levels.back();
    // An ISR can call an MP: the lowest level shows which of the two is running.
    const lang::MacroName name{run.is_isr && run.levels.size() == 1, level.number};
    ProgramLocation place;
    place.program = to_string(name);
    place.state =
        run.hold == lang::Hold::nothing ? ProgramLocation::State::running : ProgramLocation::State::waiting;
    place.waits_for = awaited_by(run.hold);
    // A line that has begun to wait is already complete, but a line that the machine does not accept yet is
    // not.
    const bool is_left =
        run.hold == lang::Hold::timer || run.hold == lang::Hold::axes || run.hold == lang::Hold::frnet;
    const int line = level.line - (is_left ? 1 : 0);
    const lang::Macro* const found = macro(name);
    if (found != nullptr && line >= 0 && line < static_cast<int>(found->size())) {
      const std::string head = std::string(name.is_isr ? "ISR " : "MP ") + std::to_string(name.number);
      place.text = lang::text_of(found->lines[static_cast<std::size_t>(line)]);
      place.line = line_in(text, head, line);
    }
    for (std::size_t i = run.levels.size() - 1; i-- > 0;) {
      const lang::Level& caller = run.levels[i];
      const std::string head =
          std::string(run.is_isr && i == 0 ? "ISR " : "MP ") + std::to_string(caller.number);
      place.callers.push_back(line_in(text, head, caller.line));
    }
    const bool is_timed = run.hold == lang::Hold::begin || run.hold == lang::Hold::timer;
    if (is_timed) place.until = time_of(run.until_ms);
    all.push_back(std::move(place));
  };
  tell(state_.execution.mp);
  for (const lang::Run& isr : state_.execution.isrs) tell(isr);
  return all;
}

}  // namespace understudy::emulator::models::rs_m8194h
