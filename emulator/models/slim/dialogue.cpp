// SLIM's dialogue: what becomes of a line, and what is answered.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/register_map/refusal.h"
#include "emulator/device/text/text_protocol.h"
#include "emulator/models/slim/actions.h"
#include "emulator/models/slim/device.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "interpreter/slim/availability.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/editor.h"
#include "interpreter/slim/events.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/parse.h"

namespace understudy::emulator::models::slim {

/// Whether a line that comes while a program waits for a number is a command all the same: what else may be
/// typed while a program runs, but for queries.
bool Slim::is_heard_instead_of_number(std::string_view line) const {
  const lang::ParseResult parsed = lang::parse_line(line, of_programs().dialect);
  if (!parsed.line.command) return false;
  const lang::Command& command = *parsed.line.command;
  if (command.verb == lang::Verb::exit) return !chose(option("get_number_exit", "nothing"));
  const bool is_query = lang::kCommands[static_cast<std::size_t>(command.row)].is_query();
  return !chose(option("lines_for_a_number", "numbers_only")) && !is_query &&
         is_allowed(command, lang::Place::external, of_programs().columns);
}

TextRules Slim::text_rules() const {
  return {.echo = chose(option("echo", "on")),
          .longest_line = of_programs().dialect.longest_line,
          .line_feed_ends = !chose(option("line_end", "cr_alone")),
          .has_flow_control = chose(option("flow_control", "xon_xoff")),
          .echoed_end = line_end()};
}

/// A host that types faster than its line answers loses what is beyond a bound that no listing reaches.
void Slim::say(std::string_view text) {
  if (state_.speech.size() >= kMaxSpeech) return;
  state_.speech += text;
  state_.speech += line_end();
}

/// T0 reads the lines: what is wrong with one is T0's error, whichever module it names. What a motor refuses
/// is its own, unless nobody could ask: of a module that is not linked the host has it.
int Slim::remember(int module, Error error) {
  const bool is_of_line = error == Error::syntax || error == Error::range || error == Error::address;
  if (is_of_line || !state_.chain.linked(module) || errors_are_of_t0()) module = 0;
  note_error(module, error);
  return module;
}

void Slim::note_error(int module, Error error) {
  Errors& errors = state_.errors[static_cast<std::size_t>(module)];
  errors.present = error;
  if (history_is_kept()) ++state_.kept_revision;
  errors.history.insert(errors.history.begin(), static_cast<std::uint8_t>(error));
  if (errors.history.size() > history_length()) errors.history.pop_back();
}

int Slim::code_of(Error error) const {
  return error != Error::none && chose(option("error_codes", "1_for_all")) ? 1 : static_cast<int>(error);
}

int Slim::fail(int module, Error error) {
  if (!chose(option("error_reply", "nothing"))) say("ERR " + std::to_string(code_of(error)));
  return remember(module, error);
}

/// After each completed line.
void Slim::conclude() {
  if (!chose(option("prompt", "greater_than"))) return;
  if (const auto number = next_line_number(state_.editor, state_.program, of_programs())) {
    state_.speech += std::to_string(*number);
  }
  state_.speech += ">";
}

void Slim::hear_line(std::string_view line) {
  wake();
  if (is_editing(state_.editor)) {
    const Error error = enter_line(state_.editor, state_.program, line, of_programs());
    if (error != Error::none) {
      fail(0, error);
    } else {
      acknowledge();
    }
  } else if (wants_number(state_.execution) && !is_heard_instead_of_number(line)) {
    const Error error = give_number(state_.execution, state_.program, line, of_programs().dialect);
    if (error != Error::none) fail(0, error);
  } else {
    hear_command(line);
  }
  conclude();
}

DeviceAnswer Slim::take_command(std::string_view line) {
  wake();
  const bool is_number = wants_number(state_.execution) && !is_heard_instead_of_number(line);
  if (is_editing(state_.editor) || is_number) return Refusal::busy;
  std::string before = std::exchange(state_.speech, {});
  const Error error = hear_command(line);
  state_.speech = std::move(before);
  if (error == Error::none) return Refusal::none;
  return {error == Error::not_allowed ? Refusal::busy : Refusal::bad_value, static_cast<int>(error)};
}

void Slim::hear_overlong() {
  wake();
  fail(0, Error::syntax);
  conclude();
}

void Slim::hear_escape() {
  wake();
  state_.editor = {};
}

/// What became of it is said, and returned.
Error Slim::hear_command(std::string_view line) {
  lang::ParseResult parsed = lang::parse_line(line, of_programs().dialect);
  if (parsed.error == Error::none && !parsed.line.command) {
    // A label belongs in a program.
    if (parsed.line.label.empty()) return Error::none;
    fail(0, Error::syntax);
    return Error::syntax;
  }
  if (parsed.error == Error::none && !parsed.line.label.empty()) parsed.error = Error::syntax;
  if (parsed.error != Error::none) {
    fail(0, parsed.error);
    return parsed.error;
  }

  lang::Command& command = *parsed.line.command;
  const lang::Place place = state_.execution.running ? lang::Place::external : lang::Place::immediate;
  if (!is_allowed(command, place, of_programs().columns)) {
    fail(0, Error::not_allowed);
    return Error::not_allowed;
  }
  std::vector<std::string> lines;
  const Error error = obey(command, lines);
  if (is_silence(error)) return Error::none;
  if (error != Error::none) {
    fail(command.module < 0 ? 0 : command.module, error);
    return error;
  }
  for (const std::string& text : lines) say(text);
  if (lines.empty() && powered()) acknowledge();
  return Error::none;
}

/// A typed command. `lines` is what it has to say.
Error Slim::obey(lang::Command& command, std::vector<std::string>& lines) {
  if (const Error error = resolve_indices(command, *this); error != Error::none) return error;
  const bool has_quantity = std::ranges::any_of(command.operands, [](const lang::Operand& operand) {
    return operand.kind == lang::Operand::Kind::quantity;
  });
  if (has_quantity && of_programs().check_command(command) != Error::none) return Error::syntax;
  if (lang::kCommands[static_cast<std::size_t>(command.row)].is_query()) {
    Answer answer;
    const Error error = query(command, answer);
    if (error == Error::none) {
      lines.push_back(chose(option("query_reply", "name_and_value")) ? answer.name + "=" + answer.text
                                                                     : answer.text);
    }
    return error;
  }
  if (chose(option("busy", "error_3")) && would_wait(command)) return Error::not_allowed;
  Order order = order_of(command);
  const Error error = perform(order, actions_of(command.verb).typed);
  lines = std::move(order.lines);
  return error;
}

}  // namespace understudy::emulator::models::slim
