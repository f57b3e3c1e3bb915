// Answers SLIM's queries.
#include "emulator/models/slim/queries.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "base/choices.h"
#include "base/complete_table.h"
#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/error_log.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/parameters_set.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "emulator/models/slim/variables.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/editor.h"
#include "interpreter/slim/text_of.h"
#include "interpreter/slim/verbs.h"

namespace understudy::emulator::models::slim {

using lang::Verb;

namespace {

// The bits of ?ST.
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

/// Returns a time as "1:02:03".
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

unsigned status_bits(const State& state, int module) {
  const ModuleStatus status = state.chain.status(module);
  unsigned bits = 0;
  const auto add = [&](unsigned bit, bool on) {
    if (on) bits |= bit;
  };
  add(kServoOn, status.servo_on);
  add(kMoving, status.moving);
  add(kProgramRuns, state.execution.running);
  add(kPaused, status.paused);
  add(kHomed, status.homed);
  add(kErrorPresent, state.errors[static_cast<std::size_t>(module)].present != Error::none);
  add(kEditing, is_editing(state.editor));
  add(kJogs, status.jog);
  add(kBufferNotEmpty, status.buffer_not_empty);
  add(kInBlend, status.in_blend);
  return bits;
}

constexpr std::array kQueryVerbs = [] {
  std::array<Verb, lang::kCommands.size()> verbs{};
  std::size_t count = 0;
  // Other commands are replaced by a query, which is possible because a key may occur twice.
  for (const lang::CommandRow& row : lang::kCommands) {
    verbs[count++] = row.is_query() ? row.verb : Verb::query_parameter;
  }
  return verbs;
}();

}  // namespace

struct Queries {
  struct Question {
    const State& state;
    const Setup& setup;
    const lang::Command& command;
    int module;
    Answer& answer;

    const Chain& chain() const { return state.chain; }
    const Errors& errors() const { return state.errors[static_cast<std::size_t>(module)]; }
    bool chose(const Option& option) const { return setup.chose(option); }
    int number() const { return static_cast<int>(command.operands.front().number); }

    Error whole(double value) const {
      answer.number = value;
      if (answer.has_words) answer.text = text_of_integer(value);
      return Error::none;
    }
    Error real(double value) const {
      answer.number = value;
      if (answer.has_words) answer.text = text_of_real(value, setup.real_form());
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
    /// Answers a query for an electrical value, which is not modelled (kKnownLimitations).
    Error electrical(double value) const {
      setup.device.warn_not_implemented(command.name, "electrical values are constant");
      return whole(value);
    }
  };
  using Reply = Error (*)(const Question&);
  using Row = HandlerRow<Verb, Reply>;

  static Error input(const Question& q) {
    if (q.command.operands.empty() && !q.setup.has_input_mask()) return Error::syntax;
    const std::uint8_t levels = q.setup.input_levels(q.module);
    return q.whole(q.command.operands.empty() ? levels : (levels >> (q.number() - 1)) & 1);
  }
  static Error status(const Question& q) {
    const unsigned bits = status_bits(q.state, q.module);
    return q.chose(option("status_bits", "the_same_in_hexadecimal")) ? q.shown_as(hexadecimal(bits), bits)
                                                                     : q.whole(bits);
  }
  static Error version(const Question& q) {
    const auto firmware = q.setup.device.firmware();
    return q.chose(option("version_shown", "as_a_number")) ? q.whole(firmware)
                                                           : q.words(version_text(firmware));
  }
  static Error variable(const Question& q) {
    const lang::Operand& operand = q.command.operands.front();
    q.answer.name = lang::text_of(operand);
    return holds_integer(operand.kind) ? q.whole(value_of(q.state, q.setup, operand))
                                       : q.real(value_of(q.state, q.setup, operand));
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
    const Tick seconds = (q.setup.now() - q.state.powered_at) / 1000;
    return q.chose(option("time_format", "seconds")) ? q.whole(static_cast<double>(seconds))
                                                     : q.words(time_text(seconds));
  }
  static Error following_error(const Question& q) {
    q.setup.device.warn_not_implemented(q.command.name, "the servo follows without error");
    return q.whole(0);
  }
  static Error parameter_value(const Question& q) {
    if (q.command.name == "TM") return q.whole(static_cast<double>(clock_s(q.state, q.setup)));
    const auto found = find_parameter(q.setup.canonical(q.command.name), q.setup.memory_form().speed_names);
    if (!found || (kParameters[*found].host_only && q.module != 0)) return Error::syntax;
    const double held = q.state.ram.parameters[static_cast<std::size_t>(q.module)][*found];
    if (*found == parameter("VM") && q.chain().module_at(q.module).analog_speed &&
        q.chose(option("working_speed_shown", "as_the_analog_input_leaves_it"))) {
      return q.real(held * q.chain().module_at(q.module).analog / kFullAnalog);
    }
    return kParameters[*found].type == ParameterDefinition::Type::integer ? q.whole(held) : q.real(held);
  }

  using Q = const Question&;
  static constexpr Row kRows[] = {
      {Verb::query_input, input},
      {Verb::query_analog, [](Q q) { return q.whole(q.setup.input(q.module, kAnalog)); }},
      {Verb::query_switch,
       [](Q q) { return q.whole(q.setup.level(q.module, kFirstSwitch + q.number() - 1) ? 1 : 0); }},
      {Verb::query_status, status},
      {Verb::query_version, version},
      {Verb::query_variable, variable},
      {Verb::query_coordinate, coordinate},
      {Verb::query_mode, mode},
      {Verb::query_error, [](Q q) { return q.whole(q.setup.code_of(q.errors().present)); }},
      {Verb::query_error_history, [](Q q) { return q.words(history_text(q.setup, q.errors())); }},
      {Verb::query_time, time},
      {Verb::query_motor_version, [](Q q) { return q.whole(q.setup.number(numbers("motor_version"))); }},
      {Verb::query_voltage, [](Q q) { return q.electrical(q.setup.number(numbers("voltage"))); }},
      {Verb::query_temperature, [](Q q) { return q.electrical(q.setup.number(numbers("temperature"))); }},
      {Verb::query_peak_current, [](Q q) { return q.electrical(0); }},
      {Verb::query_mean_current, [](Q q) { return q.electrical(0); }},
      {Verb::query_peak_following_error, following_error},
      {Verb::query_parameter, parameter_value},
  };
  static const CompleteTable<Verb, Reply> kTable;
};

constexpr CompleteTable<Verb, Queries::Reply> Queries::kTable(kQueryVerbs, kRows);

Error query(const State& state, const Setup& setup, const lang::Command& command, Answer& answer) {
  const int module = command.module < 0 ? 0 : command.module;
  if (const Error error = linked(state, module); error != Error::none) return error;
  if (answer.has_words) {
    answer.name = (command.module > 0 ? "T" + std::to_string(module) : "") + command.name;
  }
  return Queries::kTable[command.verb]({state, setup, command, module, answer});
}

}  // namespace understudy::emulator::models::slim
