#include "emulator/models/slim/dialogue.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/register_map/refusal.h"
#include "emulator/device/text/text_protocol.h"
#include "emulator/models/slim/actions.h"
#include "emulator/models/slim/output.h"
#include "emulator/models/slim/queries.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/availability.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/editor.h"
#include "interpreter/slim/events.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/machine.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/parse.h"

namespace understudy::emulator::models::slim {

namespace {

/// Returns true if a line that arrives while a program waits for a number is still a command: any command
/// that is allowed while a program runs, except queries.
bool is_heard_instead_of_number(const Setup& setup, std::string_view line) {
  const lang::ParseResult parsed = lang::parse_line(line, setup.language);
  if (!parsed.line.command) return false;
  const lang::Command& command = *parsed.line.command;
  if (command.verb == lang::Verb::exit) return !setup.chose(option("get_number_exit", "nothing"));
  const bool is_query = lang::kCommands[static_cast<std::size_t>(command.row)].is_query();
  return !setup.chose(option("lines_for_a_number", "numbers_only")) && !is_query &&
         is_allowed(command, lang::Place::external, setup.language);
}

bool takes_for_number(const State& state, const Setup& setup, std::string_view line) {
  return wants_number(state.execution) && !is_heard_instead_of_number(setup, line);
}

/// Executes a typed command. Its reply is stored in `lines`.
Error execute(State& state, const Setup& setup, const lang::Machine& machine, lang::Command& command,
              std::vector<std::string>& lines) {
  if (const Error error = resolve_indices(command, machine); error != Error::none) return error;
  const bool has_quantity = std::ranges::any_of(command.operands, [](const lang::Operand& operand) {
    return operand.kind == lang::Operand::Kind::quantity;
  });
  if (has_quantity && setup.language.check_command(command) != Error::none) return Error::syntax;
  if (lang::kCommands[static_cast<std::size_t>(command.row)].is_query()) {
    Answer answer;
    const Error error = query(state, setup, command, answer);
    if (error == Error::none) {
      lines.push_back(setup.chose(option("query_reply", "name_and_value")) ? answer.name + "=" + answer.text
                                                                           : answer.text);
    }
    return error;
  }
  if (setup.chose(option("busy", "error_3")) && would_wait(state, command)) return Error::not_allowed;
  Order order = order_of(state, setup, machine, command);
  const Error error = perform(order, actions_of(command.verb).typed);
  lines = std::move(order.lines);
  return error;
}

/// Executes a command, sends its result, and returns its error.
Error receive_command(State& state, const Setup& setup, const lang::Machine& machine, std::string_view line) {
  lang::ParseResult parsed = lang::parse_line(line, setup.language);
  if (parsed.error == Error::none && !parsed.line.command) {
    // Labels are only allowed in programs.
    if (parsed.line.label.empty()) return Error::none;
    fail(state, setup, 0, Error::syntax);
    return Error::syntax;
  }
  if (parsed.error == Error::none && !parsed.line.label.empty()) parsed.error = Error::syntax;
  if (parsed.error != Error::none) {
    fail(state, setup, 0, parsed.error);
    return parsed.error;
  }

  lang::Command& command = *parsed.line.command;
  const lang::Place place = state.execution.running ? lang::Place::external : lang::Place::immediate;
  if (!is_allowed(command, place, setup.language)) {
    fail(state, setup, 0, Error::not_allowed);
    return Error::not_allowed;
  }
  std::vector<std::string> lines;
  const Error error = execute(state, setup, machine, command, lines);
  if (setup.is_silence(error)) return Error::none;
  if (error != Error::none) {
    fail(state, setup, command.module < 0 ? 0 : command.module, error);
    return error;
  }
  for (const std::string& text : lines) send_line(state, setup, text);
  if (lines.empty() && setup.device.powered()) acknowledge(state, setup);
  return Error::none;
}

}  // namespace

TextRules text_rules(const Setup& setup) {
  return {.echo = setup.chose(option("echo", "on")),
          .longest_line = lang::longest_line(setup.language),
          .line_feed_ends = !setup.chose(option("line_end", "cr_alone")),
          .has_flow_control = setup.chose(option("flow_control", "xon_xoff")),
          .echoed_end = setup.line_end()};
}

void receive_line(State& state, const Setup& setup, const lang::Machine& machine, std::string_view line) {
  if (is_editing(state.editor)) {
    const Error error = enter_line(state.editor, state.program, line, setup.language);
    if (error != Error::none) {
      fail(state, setup, 0, error);
    } else {
      acknowledge(state, setup);
    }
  } else if (takes_for_number(state, setup, line)) {
    const Error error = give_number(state.execution, state.program, line, setup.language);
    if (error != Error::none) fail(state, setup, 0, error);
  } else {
    receive_command(state, setup, machine, line);
  }
  conclude(state, setup);
}

DeviceAnswer take_command(State& state, const Setup& setup, const lang::Machine& machine,
                          std::string_view line) {
  const bool is_number = takes_for_number(state, setup, line);
  if (is_editing(state.editor) || is_number) return Refusal::busy;
  std::string before = std::exchange(state.output, {});
  const Error error = receive_command(state, setup, machine, line);
  state.output = std::move(before);
  if (error == Error::none) return Refusal::none;
  return {error == Error::not_allowed ? Refusal::busy : Refusal::bad_value, static_cast<int>(error)};
}

void receive_overlong(State& state, const Setup& setup) {
  fail(state, setup, 0, Error::syntax);
  conclude(state, setup);
}

}  // namespace understudy::emulator::models::slim
