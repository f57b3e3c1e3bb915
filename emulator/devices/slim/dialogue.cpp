// SLIM's dialogue: what becomes of a line, and what is answered.
#include <utility>

#include "emulator/devices/slim/device.h"

namespace understudy::emulator::slim {

namespace {

/// The one command that a program hears while it waits for a number.
bool is_exit(std::string_view line, const lang::Dialect& dialect) {
  const lang::ParseResult parsed = lang::parse_line(line, dialect);
  return parsed.line.command && parsed.line.command->verb == lang::Verb::exit;
}

}  // namespace

TextRules Slim::text_rules() const {
  return {.echo = chose(kEcho),
          .longest_line = of_programs().dialect.longest_line,
          .line_feed_ends = !chose(kCrAloneEnds),
          .has_flow_control = chose(kXonXoff),
          .echoed_end = line_end()};
}

/// A host that types faster than its line answers loses what is beyond a bound that no listing reaches.
void Slim::say(std::string_view text) {
  if (state_.speech.size() >= kMostSpeech) return;
  state_.speech += text;
  state_.speech += line_end();
}

/// Of a module that is not linked nobody could ask: the host has it.
void Slim::remember(int module, Error error) {
  if (!state_.chain.linked(module)) module = 0;
  Errors& errors = state_.errors[static_cast<std::size_t>(module)];
  errors.present = error;
  errors.history.insert(errors.history.begin(), static_cast<std::uint8_t>(error));
  if (errors.history.size() > history_length()) errors.history.pop_back();
}

int Slim::code_of(Error error) const {
  return error != Error::none && chose(kOneErrorCode) ? 1 : static_cast<int>(error);
}

void Slim::fail(int module, Error error) {
  remember(module, error);
  if (!chose(kErrorsNotAnswered)) say("ERR " + std::to_string(code_of(error)));
}

/// After each completed line.
void Slim::conclude() {
  if (!chose(kPrompt)) return;
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
    } else if (chose(kAcknowledges)) {
      say("OK");
    }
  } else if (wants_number(state_.execution) &&
             (chose(kExitIsNoNumber) || !is_exit(line, of_programs().dialect))) {
    const Error error = give_number(state_.execution, state_.program, line, of_programs().dialect);
    if (error != Error::none) fail(0, error);
  } else {
    hear_command(line);
  }
  conclude();
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

void Slim::hear_command(std::string_view line) {
  lang::ParseResult parsed = lang::parse_line(line, of_programs().dialect);
  if (parsed.error == Error::none && !parsed.line.command) {
    // A label belongs into a program.
    if (!parsed.line.label.empty()) fail(0, Error::syntax);
    return;
  }
  if (parsed.error == Error::none && !parsed.line.label.empty()) parsed.error = Error::syntax;
  if (parsed.error != Error::none) return fail(0, parsed.error);

  lang::Command& command = *parsed.line.command;
  const lang::Place place = state_.execution.running ? lang::Place::external : lang::Place::immediate;
  if (!is_allowed(command, place, of_programs().columns)) return fail(0, Error::not_allowed);
  std::vector<std::string> lines;
  const Error error = obey(command, lines);
  if (is_silence(error)) return;
  if (error != Error::none) return fail(command.module < 0 ? 0 : command.module, error);
  for (const std::string& text : lines) say(text);
  if (lines.empty() && chose(kAcknowledges) && powered()) say("OK");
}

/// A typed command. `lines` is what it has to say.
Error Slim::obey(lang::Command& command, std::vector<std::string>& lines) {
  using lang::Verb;
  if (const Error error = resolve_indices(command, *this); error != Error::none) return error;
  if (lang::kCommands[static_cast<std::size_t>(command.row)].is_query()) {
    Answer answer;
    const Error error = query(command, answer);
    if (error == Error::none) {
      lines.push_back(chose(kNamesValues) ? answer.name + "=" + answer.text : answer.text);
    }
    return error;
  }
  switch (command.verb) {
    case Verb::run: {
      const lang::Operand* const address = command.operands.empty() ? nullptr : command.operands.data();
      return start(state_.execution, state_.program, address, flow_options_);
    }
    case Verb::exit: stop(state_.execution); return Error::none;
    case Verb::set_event:
    case Verb::on_event:
      define_event(state_.execution.events, command, flow_options_.events);
      return Error::none;
    case Verb::program_list: lines = state_.program.listing(of_programs()); return Error::none;
    case Verb::upload: lines = state_.program.upload(); return Error::none;
    case Verb::program_new:
    case Verb::program_append:
    case Verb::program_edit:
    case Verb::program_insert:
    case Verb::program_delete:
    case Verb::download: return begin_edit(state_.editor, state_.program, command, of_programs());
    case Verb::list_parameters: lines = parameter_list(); return Error::none;
    case Verb::print: {
      const lang::Operand& what = command.operands.front();
      lines.push_back(what.kind == lang::Operand::Kind::text ? what.text : text_of(what));
      return Error::none;
    }
    default: break;
  }
  return chose(kBusyRefused) && would_wait(command) ? Error::not_allowed : execute(command);
}

}  // namespace understudy::emulator::slim
