// What SLIM's queries answer.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/complete_table.h"
#include "base/simulated_time.h"
#include "emulator/device/choices.h"
#include "emulator/device/device.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/models/slim/actions.h"
#include "emulator/models/slim/chain.h"
#include "emulator/models/slim/device.h"
#include "emulator/models/slim/errors.h"
#include "emulator/models/slim/module.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/options.h"
#include "emulator/models/slim/parameters.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/editor.h"
#include "interpreter/slim/events.h"
#include "interpreter/slim/parse.h"
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

namespace {

constexpr std::array kQueryVerbs = [] {
  std::array<Verb, lang::kCommands.size()> verbs{};
  std::size_t count = 0;
  // In place of other commands any query: a key may come twice.
  for (const lang::CommandRow& row : lang::kCommands) {
    verbs[count++] = row.is_query() ? row.verb : Verb::query_parameter;
  }
  return verbs;
}();

}  // namespace

/// What each query answers.
struct SlimQueries {
  struct Question {
    const Slim& slim;
    const lang::Command& command;
    int module;
    Slim::Answer& answer;

    const State& state() const { return slim.state_; }
    const Chain& chain() const { return slim.state_.chain; }
    const Errors& errors() const { return slim.state_.errors[static_cast<std::size_t>(module)]; }
    bool chose(const Option& option) const { return slim.chose(option); }
    int number() const { return static_cast<int>(command.operands.front().number); }

    Error whole(double value) const {
      answer.number = value;
      if (answer.has_words) answer.text = text_of_integer(value);
      return Error::none;
    }
    Error real(double value) const {
      answer.number = value;
      if (answer.has_words) answer.text = text_of_real(value, slim.real_form());
      return Error::none;
    }
    Error words(std::string text) const {
      answer.text = std::move(text);
      return Error::none;
    }
    Error shown_as(std::string text, double value) const {
      answer.number = value;
      return words(std::move(text));
    }
    /// Not modelled; kGaps says so.
    Error electrical(double value) const {
      slim.warn_not_implemented(command.name, "nothing electrical is; the value is always the same");
      return whole(value);
    }
  };
  using Reply = Error (*)(const Question&);
  using Row = HandlerRow<Verb, Reply>;

  static Error input(const Question& q) {
    if (q.command.operands.empty() && !q.slim.has_input_mask()) return Error::syntax;
    const std::uint8_t levels = q.slim.input_levels(q.module);
    return q.whole(q.command.operands.empty() ? levels : (levels >> (q.number() - 1)) & 1);
  }
  static Error status(const Question& q) {
    const unsigned bits = q.slim.status_bits(q.module);
    return q.chose(option("status_bits", "the_same_in_hexadecimal")) ? q.shown_as(hexadecimal(bits), bits)
                                                                     : q.whole(bits);
  }
  static Error version(const Question& q) {
    const auto firmware = q.slim.firmware();
    return q.chose(option("version_shown", "as_a_number")) ? q.whole(firmware)
                                                           : q.words(version_text(firmware));
  }
  static Error variable(const Question& q) {
    const lang::Operand& operand = q.command.operands.front();
    q.answer.name = lang::text_of(operand);
    return holds_integer(operand.kind) ? q.whole(q.slim.value(operand)) : q.real(q.slim.value(operand));
  }
  static Error coordinate(const Question& q) {
    const double units = q.chain().coordinate(q.module);
    return q.chose(option("coordinate_shown", "as_32_bits_hold_it"))
               ? q.real(units)
               : q.shown_as(text_of_coordinate(units), units);
  }
  static Error mode(const Question& q) {
    const Mode mode = q.chain().status(q.module).mode;
    const auto code = static_cast<double>(mode);
    return q.chose(option("mode_codes", "words")) ? q.shown_as(word_of(mode), code) : q.whole(code);
  }
  static Error time(const Question& q) {
    const Tick seconds = (q.slim.now() - q.state().powered_at) / 1000;
    return q.chose(option("time_format", "seconds")) ? q.whole(static_cast<double>(seconds))
                                                     : q.words(time_text(seconds));
  }
  static Error following_error(const Question& q) {
    q.slim.warn_not_implemented(q.command.name, "the servo follows without error");
    return q.whole(0);
  }
  static Error parameter_value(const Question& q) {
    if (q.command.name == "TM") return q.whole(static_cast<double>(q.slim.clock_s()));
    const auto found = find_parameter(q.slim.meant(q.command.name), q.slim.memory_form().speed_names);
    if (!found || (kParameters[*found].host_only && q.module != 0)) return Error::syntax;
    const double held = q.state().ram.parameters[static_cast<std::size_t>(q.module)][*found];
    if (*found == parameter("VM") && q.chain().analog_speed(q.module) &&
        q.chose(option("working_speed_shown", "as_the_analog_input_leaves_it"))) {
      return q.real(held * q.chain().analog(q.module) / kFullAnalog);
    }
    return kParameters[*found].type == ParameterDefinition::Type::integer ? q.whole(held) : q.real(held);
  }

  using Q = const Question&;
  static constexpr Row kRows[] = {
      {Verb::query_input, input},
      {Verb::query_analog, [](Q q) { return q.whole(q.slim.Device::input(terminal(q.module, kAnalog))); }},
      {Verb::query_switch,
       [](Q q) { return q.whole(q.slim.level(q.module, kFirstSwitch + q.number() - 1) ? 1 : 0); }},
      {Verb::query_status, status},
      {Verb::query_version, version},
      {Verb::query_variable, variable},
      {Verb::query_coordinate, coordinate},
      {Verb::query_mode, mode},
      {Verb::query_error, [](Q q) { return q.whole(q.slim.code_of(q.errors().present)); }},
      {Verb::query_error_history, [](Q q) { return q.words(q.slim.history_text(q.errors())); }},
      {Verb::query_time, time},
      {Verb::query_motor_version,
       [](Q q) { return q.whole(q.slim.chosen_number(numbers("motor_version"))); }},
      {Verb::query_voltage, [](Q q) { return q.electrical(q.slim.chosen_number(numbers("voltage"))); }},
      {Verb::query_temperature,
       [](Q q) { return q.electrical(q.slim.chosen_number(numbers("temperature"))); }},
      {Verb::query_peak_current, [](Q q) { return q.electrical(0); }},
      {Verb::query_mean_current, [](Q q) { return q.electrical(0); }},
      {Verb::query_peak_following_error, following_error},
      {Verb::query_parameter, parameter_value},
  };
  static const CompleteTable<Verb, Reply> kTable;
};

constexpr CompleteTable<Verb, SlimQueries::Reply> SlimQueries::kTable(kQueryVerbs, kRows);

/// The command's indices are resolved.
Error Slim::query(const lang::Command& command, Answer& answer) const {
  const int module = command.module < 0 ? 0 : command.module;
  if (const Error error = linked(module); error != Error::none) return error;
  if (answer.has_words) {
    answer.name = (command.module > 0 ? "T" + std::to_string(module) : "") + command.name;
  }
  return SlimQueries::kTable[command.verb]({*this, command, module, answer});
}

// --- past the line: scenarios, traces, the control socket ----------------------------------------

/// Conditions and traces ask for the same at every tick: its words are read once.
const std::optional<lang::Command>& Slim::query_named(std::string_view name) const {
  constexpr std::size_t kMax = 256;  // a host may ask for anything, for ever
  if (const auto known = queries_.find(name); known != queries_.end()) return known->second;
  if (queries_.size() >= kMax) queries_.clear();
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

Tick Slim::next_change(std::string_view /*name*/, Tick done) const {
  // Its clocks count seconds.
  constexpr Tick kSecond = 1000;
  const auto next_second = [&](Tick since) {
    return done + kSecond - ((done - since) % kSecond + kSecond) % kSecond;
  };
  return std::min(next_second(state_.powered_at), next_second(state_.clock_zero));
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
    if (parsed.error == Error::none) {
      Order order = order_of(command);
      parsed.error = perform(order, actions_of(command.verb).stored);
    }
  }
  switch (parsed.error) {
    case Error::none: return std::nullopt;
    case Error::syntax:
      if (!is_whole && lang::parse_line(beginning + "0").error == Error::none) {
        return "cannot be " + text_of_real(value) + "; expected a whole number within its range";
      }
      return "is not a parameter or variable; expected one such as 'PR3', 'T1VM' or 'N0'";
    case Error::range: return "is out of range";
    case Error::not_linked: return "belongs to a module that is not linked; expected one of those in PN50";
    case Error::not_allowed:
    case Error::axis:
    case Error::paused:
    case Error::unequal_speeds:
    case Error::buffer_full:
    case Error::servo_off:
    case Error::following_error:
    case Error::overload:
    case Error::over_temperature:
    case Error::address: break;
  }
  return "is refused with ERR " + std::to_string(code_of(parsed.error));
}

std::vector<std::string> Slim::names() const {
  std::vector<std::string> all{"PE", "ST", "MD", "ERR", "IN", "AIN", "TM", "N0", "R0"};
  if (!has_input_mask()) std::erase(all, "IN");
  for (const ParameterDefinition& row : kParameters)
    all.emplace_back(row.alias.empty() ? row.name : row.alias);
  for (int m = 1; m < kModules; ++m) {
    if (state_.chain.linked(m)) all.push_back("T" + std::to_string(m) + "PE");
  }
  return all;
}

}  // namespace understudy::emulator::models::slim
