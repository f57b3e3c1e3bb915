#include "interpreter/rs_m8194h/state_fields.h"

#include <cstdint>
#include <string>
#include <vector>

#include "base/state/state_bytes.h"
#include "base/state/state_error.h"
#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/text.h"
#include "interpreter/rs_m8194h/triggers.h"
#include "interpreter/rs_m8194h/window.h"

namespace understudy {

namespace lang = interpreter::rs_m8194h;

/// Options that accept every rectangle.
constexpr lang::Options kWithAnyCorners{lang::option("rectangle_radius", "drawn_shorter")};

void StateOf<lang::Command>::write(const lang::Command& command, StateWriter& writer) {
  const bool is_empty = lang::find_code(command.code) == nullptr;
  writer.write(is_empty ? std::vector<std::uint16_t>{} : lang::encode(command));
}

void StateOf<lang::Command>::read(lang::Command& command, StateReader& reader) {
  std::vector<std::uint16_t> registers;
  reader.read(registers);
  command = {};
  if (registers.empty()) return;
  const bool is_whole =
      lang::read_registers(registers, lang::WordOrder::high_first, command) == lang::Fault::none;
  require_state(is_whole && !lang::bad_parameter(command, kWithAnyCorners), "a command is not in the manual");
}

std::string StateOf<lang::Command>::reported(const lang::Command& command) {
  return lang::find_code(command.code) == nullptr ? "" : lang::text_of(command);
}

void StateOf<lang::Download>::check(const lang::Download& download) {
  require_state(lang::exists(download.name), "a macro has a number that does not exist");
  lang::Download again{.name = download.name};
  for (const lang::Command& line : download.lines) {
    const bool is_line = line.is_macro_line() && lang::add(again, line) == lang::Fault::none;
    require_state(is_line, "a line of a macro would have been refused");
  }
}

void StateOf<lang::Trigger>::check(const lang::Trigger& trigger) {
  const int argument = trigger.argument;
  const bool is_axis = argument == 1 || argument == 2 || argument == 4 || argument == 8;
  const bool fits = trigger.event == lang::TriggerEvent::call_mp ? lang::exists({false, argument})
                    : trigger.event == lang::TriggerEvent::hold  ? is_axis
                                                                 : argument == 0;
  require_state(fits, "a trigger has a wrong number");
}

void StateOf<lang::Run>::check(const lang::Run& run) {
  if (run.until_ms != lang::kNever) require_reach(run.until_ms);
  require_state(run.levels.size() <= lang::kDeepestCall, "macros are nested too deep");
}

void StateOf<lang::Execution>::check(const lang::Execution& execution) {
  require_state(execution.isrs.size() <= 64, "too many ISRs are active");
}

}  // namespace understudy
