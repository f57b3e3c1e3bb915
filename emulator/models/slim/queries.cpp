// What SLIM's queries answer.
#include <cmath>
#include <cstdio>
#include <limits>

#include "emulator/models/slim/device.h"
#include "emulator/models/slim/numbers.h"
#include "interpreter/slim/text_of.h"

namespace understudy::emulator::models::slim {

using lang::Verb;

namespace {

// ?ST.
constexpr unsigned kServoOn = 1U << 0;
constexpr unsigned kMoving = 1U << 1;
constexpr unsigned kProgramRuns = 1U << 2;
constexpr unsigned kPaused = 1U << 3;
constexpr unsigned kHomed = 1U << 4;
constexpr unsigned kErrorPresent = 1U << 5;
constexpr unsigned kEditing = 1U << 6;
constexpr unsigned kJogs = 1U << 7;
constexpr unsigned kBufferNotEmpty = 1U << 8;
constexpr unsigned kInBlend = 1U << 9;

/// "1:02:03".
std::string time_text(std::int64_t seconds) {
  char text[40];
  std::snprintf(text, sizeof text, "%lld:%02d:%02d", static_cast<long long>(seconds / 3600),
                static_cast<int>(seconds / 60 % 60), static_cast<int>(seconds % 60));
  return text;
}

std::string hexadecimal(unsigned value) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%04X", value);
  return text;
}

const char* word_of(Mode mode) {
  switch (mode) {
    case Mode::idle: return "IDLE";
    case Mode::position: return "POSITION";
    case Mode::jog: return "JOG";
    case Mode::torque: return "TORQUE";
    case Mode::coordinated: return "COORDINATED";
    case Mode::analog: return "ANALOG";
  }
  return "";
}

}  // namespace

std::string Slim::history_text(const Errors& errors) const {
  std::string text;
  for (const std::uint8_t error : errors.history) {
    if (!text.empty()) text += ',';
    text += std::to_string(code_of(static_cast<Error>(error)));
  }
  return text.empty() ? "0" : text;
}

std::uint16_t Slim::status_bits(int module) const {
  const ModuleStatus status = state_.chain.status(module);
  unsigned bits = 0;
  const auto add = [&](unsigned bit, bool on) {
    if (on) bits |= bit;
  };
  add(kServoOn, status.servo_on);
  add(kMoving, status.moving);
  add(kProgramRuns, state_.execution.running);
  add(kPaused, status.paused);
  add(kHomed, status.homed);
  add(kErrorPresent, state_.errors[static_cast<std::size_t>(module)].present != Error::none);
  add(kEditing, is_editing(state_.editor));
  add(kJogs, status.jog);
  add(kBufferNotEmpty, status.buffer_not_empty);
  add(kInBlend, status.in_blend);
  return static_cast<std::uint16_t>(bits);
}

/// The command's indices are resolved.
Error Slim::query(const lang::Command& command, Answer& answer) const {
  const int module = command.module < 0 ? 0 : command.module;
  if (const Error error = linked(module); error != Error::none) return error;
  if (answer.has_words) {
    answer.name = (command.module > 0 ? "T" + std::to_string(module) : "") + command.name;
  }
  const auto whole = [&](double value) {
    answer.number = value;
    if (answer.has_words) answer.text = text_of_integer(value);
    return Error::none;
  };
  const auto real = [&](double value) {
    answer.number = value;
    if (answer.has_words) answer.text = text_of_real(value, real_form());
    return Error::none;
  };
  const auto words = [&](std::string text) {
    answer.text = std::move(text);
    return Error::none;
  };
  const auto shown_as = [&](std::string text, double value) {
    answer.number = value;
    answer.text = std::move(text);
    return Error::none;
  };
  const auto electrical = [&](double value) {
    mention_unmodelled(command.name, "nothing electrical is; the value is always the same");
    return whole(value);
  };
  const auto number = [&] { return static_cast<int>(command.operands.front().number); };
  const Errors& errors = state_.errors[static_cast<std::size_t>(module)];
  switch (command.verb) {
    case Verb::query_input: {
      if (command.operands.empty() && chose(kInputsByNumberOnly)) return Error::syntax;
      const std::uint8_t levels = input_levels(module);
      return whole(command.operands.empty() ? levels : (levels >> (number() - 1)) & 1);
    }
    case Verb::query_analog: return whole(Device::input(terminal(module, kAnalog)));
    case Verb::query_switch: return whole(level(module, kFirstSwitch + number() - 1) ? 1 : 0);
    case Verb::query_status: {
      const unsigned bits = status_bits(module);
      return chose(kStatusInHexadecimal) ? shown_as(hexadecimal(bits), bits) : whole(bits);
    }
    case Verb::query_version:
      return chose(kVersionIsNumber) ? whole(firmware()) : words(version_text(firmware()));
    case Verb::query_variable: {
      const lang::Operand& variable = command.operands.front();
      answer.name = lang::text_of(variable);
      return holds_integer(variable.kind) ? whole(value(variable)) : real(value(variable));
    }
    case Verb::query_coordinate: {
      const double units = state_.chain.coordinate(module);
      return chose(kCoordinateOf32Bits) ? real(units) : shown_as(text_of_coordinate(units), units);
    }
    case Verb::query_mode: {
      const Mode mode = state_.chain.status(module).mode;
      const auto code = static_cast<double>(mode);
      return chose(kModeInWords) ? shown_as(word_of(mode), code) : whole(code);
    }
    case Verb::query_error: return whole(code_of(errors.present));
    case Verb::query_error_history: return words(history_text(errors));
    case Verb::query_time: {
      const Tick seconds = (now() - state_.powered_at) / 1000;
      return chose(kTimeInSeconds) ? whole(static_cast<double>(seconds)) : words(time_text(seconds));
    }
    case Verb::query_motor_version: return whole(chosen_number(kMotorVersion));
    // Not modelled; kGaps says so.
    case Verb::query_voltage: return electrical(chosen_number(kVoltage));
    case Verb::query_temperature: return electrical(chosen_number(kTemperature));
    case Verb::query_peak_current:
    case Verb::query_mean_current: return electrical(0);
    case Verb::query_peak_following_error:
      mention_unmodelled(command.name, "the servo follows without error");
      return whole(0);
    default: break;
  }
  if (command.name == "TM") return whole(static_cast<double>(clock_s()));
  const auto found = find_parameter(meant(command.name), memory_form().speed_names);
  if (!found || (kParameters[*found].host_only && module != 0)) return Error::syntax;
  const double held = state_.ram.parameters[static_cast<std::size_t>(module)][*found];
  const Chain& chain = state_.chain;
  if (*found == parameter("VM") && chain.analog_speed(module) && chose(kShownSpeedIsAnalog)) {
    return real(held * chain.analog(module) / kFullAnalog);
  }
  return kParameters[*found].type == ParameterDefinition::Type::integer ? whole(held) : real(held);
}

// --- past the line: scenarios, traces, the control socket ----------------------------------------

/// Conditions and traces ask for the same at every tick: its words are read once.
const std::optional<lang::Command>& Slim::query_named(std::string_view name) const {
  constexpr std::size_t kMost = 256;  // a host may ask for anything, for ever
  if (const auto known = queries_.find(name); known != queries_.end()) return known->second;
  if (queries_.size() >= kMost) queries_.clear();
  std::optional<lang::Command>& query = queries_[std::string(name)];
  lang::ParseResult parsed = lang::parse_line("?" + std::string(name), of_programs().dialect);
  if (parsed.error != Error::none || !parsed.line.command) return query;
  const auto row = static_cast<std::size_t>(parsed.line.command->row);
  if (lang::kCommands[row].is_query()) query = std::move(parsed.line.command);
  return query;
}

std::optional<double> Slim::value_named(std::string_view name) const {
  if (!powered()) return std::nullopt;
  const std::optional<lang::Command>& query_of_name = query_named(name);
  if (!query_of_name) return std::nullopt;
  lang::Command command = *query_of_name;
  Answer answer{.has_words = false};
  if (resolve_indices(command, *this) != Error::none) return std::nullopt;
  if (query(command, answer) != Error::none) return std::nullopt;
  return answer.number;
}

std::optional<std::string> Slim::assign(std::string_view name, double value) {
  if (!powered()) return "it has no power";
  wake();
  if (!(std::abs(value) <= std::numeric_limits<float>::max())) return "is out of range";
  const bool is_whole = value == std::trunc(value) && std::abs(value) < 1e15;
  const std::string beginning = std::string(name) + "=";
  lang::ParseResult parsed = lang::parse_line(
      beginning + (is_whole ? text_of_integer(value) : text_of_real(value)), of_programs().dialect);
  if (parsed.error == Error::none && parsed.line.command) {
    lang::Command& command = *parsed.line.command;
    if (!lang::kCommands[static_cast<std::size_t>(command.row)].is_assignment()) {
      return "is not a parameter or variable; expected one such as 'PR3', 'T1VM' or 'N0'";
    }
    parsed.error = resolve_indices(command, *this);
    if (parsed.error == Error::none) parsed.error = execute(command);
  }
  switch (parsed.error) {
    case Error::none: return std::nullopt;
    case Error::syntax:
      if (!is_whole && lang::parse_line(beginning + "0").error == Error::none) {
        return "cannot be " + text_of_real(value) + "; expected a whole number within its range";
      }
      return "is not a parameter or variable; expected one such as 'PR3', 'T1VM' or 'N0'";
    case Error::range: return "is out of range";
    case Error::not_linked: return "is of a module that is not linked; expected one of those in PN50";
    default: return "is refused with ERR " + std::to_string(code_of(parsed.error));
  }
}

std::vector<std::string> Slim::names() const {
  std::vector<std::string> all{"PE", "ST", "MD", "ERR", "IN", "AIN", "TM", "N0", "R0"};
  if (chose(kInputsByNumberOnly)) std::erase(all, "IN");
  for (const ParameterDefinition& row : kParameters)
    all.emplace_back(row.alias.empty() ? row.name : row.alias);
  for (int m = 1; m < kModules; ++m) {
    if (state_.chain.linked(m)) all.push_back("T" + std::to_string(m) + "PE");
  }
  return all;
}

}  // namespace understudy::emulator::models::slim
