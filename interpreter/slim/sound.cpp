#include <algorithm>
#include <cstddef>
#include <optional>
#include <ranges>

#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/events.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/parse.h"
#include "interpreter/slim/program.h"
#include "interpreter/slim/text_of.h"

namespace understudy::interpreter::slim {
namespace {

/// Returns true if parsing the command's text results in the same command.
bool reads_back(const Command& command, const Options& options) {
  const ParseResult result = parse_line(text_of(command), options);
  return result.error == Error::none && result.line.command == command;
}

bool is_sound(const Event& event, int number, const Options& options) {
  if ((event.has_condition || event.has_address) && number > options.number(numbers("events"))) return false;
  const Operand name{.kind = Operand::Kind::event, .index = number};
  if (event.has_condition) {
    Command command{.verb = Verb::set_event, .row = row_of("SET EVk cond"), .operands = {name}};
    const int word = static_cast<int>(event.condition);
    command.operands.push_back({.kind = Operand::Kind::condition, .index = word});
    command.operands.insert(command.operands.end(), event.operands.begin(), event.operands.end());
    const bool has_known_kinds = std::ranges::none_of(event.operands, [](const Operand& operand) {
      // Conditions do not contain these kinds, whose text needs a valid index.
      return operand.kind >= Operand::Kind::event && operand.kind != Operand::Kind::quantity;
    });
    if (!has_known_kinds || !reads_back(command, options)) return false;
  }
  const bool is_address =
      event.address.kind == Operand::Kind::integer || event.address.kind == Operand::Kind::label;
  return is_address && (!event.pending || (event.has_condition && event.has_address));
}

bool can_hold(const std::optional<Command>& command, Hold hold) {
  if (hold == Hold::nothing) return true;
  if (!command) return false;
  switch (hold) {
    case Hold::timer: return command->verb == Verb::wait_time;
    case Hold::input: return command->verb == Verb::wait_input;
    case Hold::window: return command->verb == Verb::jump_if_within;
    case Hold::number: return asks_host(*command);
    case Hold::nothing:
    case Hold::machine: return true;
  }
  return false;
}

bool is_sound(const Frame& frame, const Program& program) {
  if (frame.line < 0 || frame.line > program.size()) return false;
  if (!frame.of_event) return frame.hold == Hold::nothing;
  if (frame.line == program.size()) return frame.hold == Hold::nothing;  // the interrupted line is forgotten
  return frame.line < program.size() && can_hold(program.line(frame.line).parsed.command, frame.hold);
}

}  // namespace

bool is_sound(const Execution& execution, const Program& program, const Options& options) {
  for (std::size_t i = 0; i < execution.events.size(); ++i) {
    if (!is_sound(execution.events[i], static_cast<int>(i) + 1, options)) return false;
  }
  if (!execution.running) return execution.hold == Hold::nothing && execution.stack.empty();
  const bool is_line = execution.line >= 0 && execution.line < program.size();
  if (!is_line || !can_hold(program.line(execution.line).parsed.command, execution.hold)) return false;
  const auto routines = std::ranges::count(execution.stack, true, &Frame::of_event);
  const auto calls = std::ranges::ssize(execution.stack) - routines;
  const auto is_sound_frame = [&](const Frame& frame) { return is_sound(frame, program); };
  return routines <= 1 && calls <= options.number(numbers("call_depth")) &&
         std::ranges::all_of(execution.stack, is_sound_frame);
}

}  // namespace understudy::interpreter::slim
