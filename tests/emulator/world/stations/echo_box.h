// The tests' own model with a text protocol: it repeats what it receives, and can send an unsolicited line at
// a given tick. It is so small that this table describes all of its behaviour.
//
//   SAY WORDS    WORDS
//   AT TICK      nothing now; "TICK n" at that tick
//   LIST N       N lines "line 1" to "line N"
//   N0=5         nothing, or ERR 2 (-32768 to 32767); also R0 (real), ECHO (0 or 1)
//   ?N0          its value
//   (firmware 1.00, at power-up) HELLO
//   anything else: ERR 1; a line that is too long: LONG; ESC: BREAK
#pragma once

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/state/difference.h"
#include "base/state/fields.h"
#include "base/state/state_bytes.h"
#include "emulator/device/device.h"
#include "emulator/device/device_of.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/named_values.h"
#include "emulator/device/program_language.h"
#include "emulator/device/terminals.h"
#include "emulator/device/text/text_port.h"
#include "emulator/device/text/text_protocol.h"
#include "emulator/device/user_program.h"
#include "emulator/models/models.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::world {

/// Its whole state.
struct EchoState {
  std::string speech{};
  Tick speaks_at = kNever;
  std::int32_t n0 = 0;
  double r0 = 0;
  bool echo = false;
  std::vector<std::string> program{};
  bool operator==(const EchoState&) const = default;
};

}  // namespace understudy::emulator::world

namespace understudy {

template <>
struct StateOf<emulator::world::EchoState> {
  using Value = emulator::world::EchoState;
  static constexpr auto fields =
      FieldList{field<&Value::speech>(), field<&Value::speaks_at>(), field<&Value::n0>(),
                field<&Value::r0>(),     field<&Value::echo>(),      field<&Value::program>()};
};

}  // namespace understudy

namespace understudy::emulator::world {

inline constexpr Firmware kEchoFirmwares[] = {100, 101};
inline constexpr CommandRow kEchoCommands[] = {
    {"SAY", "SAY WORDS", "says WORDS"},
    {"AT", "AT TICK", "says \"TICK n\" when that tick has come"},
    {"LIST", "LIST N", "says N lines"},
};
inline constexpr TerminalRow kEchoTerminals[] = {{TerminalRow::Kind::digital_in, "IN_1"},
                                                 {TerminalRow::Kind::digital_out, "OUT_1"}};

class EchoBox final : public DeviceOf<EchoBox>,
                      public TextProtocol,
                      public NamedValues,
                      public PersistentMemory,
                      public UserProgram,
                      public Terminals {
 public:
  EchoBox(const Model& model, const DeviceSettings& settings)
      : DeviceOf(model, settings), PersistentMemory(model.name, settings.firmware) {}

  // --- the dialogue ----------------------------------------------------------------------------
  TextRules text_rules() const override { return {.echo = state_.echo, .longest_line = 20}; }
  void receive_line(std::string_view line) override {
    std::istringstream words{std::string(line)};
    std::string first;
    words >> first;
    long number = 0;
    if (first == "SAY" && line.size() > 4) {
      transmit(std::string(line.substr(4)));
    } else if (first == "AT" && words >> number) {
      state_.speaks_at = number;
    } else if (first == "LIST" && words >> number) {
      for (long i = 1; i <= number; ++i) transmit("line " + std::to_string(i));
    } else if (line.starts_with('?')) {
      const auto value = value_named(line.substr(1));
      transmit(value ? text_of(*value) : "ERR 1");
    } else if (const std::size_t equals = line.find('='); equals != std::string_view::npos) {
      const std::string value(line.substr(equals + 1));
      if (assign(line.substr(0, equals), std::strtod(value.c_str(), nullptr))) transmit("ERR 2");
    } else {
      transmit("ERR 1");
    }
  }
  void receive_overlong() override { transmit("LONG"); }
  void receive_escape() override { transmit("BREAK"); }
  bool has_text() const override { return !state_.speech.empty(); }
  std::string take_text() override { return std::exchange(state_.speech, {}); }

  // --- values by name --------------------------------------------------------------------------
  std::optional<double> value_named(std::string_view name) const override {
    if (name == "N0") return static_cast<double>(state_.n0);
    if (name == "R0") return state_.r0;
    if (name == "ECHO") return state_.echo ? 1 : 0;
    if (name == "MODULES") return settings().modules == 0 ? 1 : settings().modules;
    return std::nullopt;
  }
  std::optional<std::string> assign(std::string_view name, double value) override {
    const bool is_whole = std::floor(value) == value;
    if (name == "N0") {
      if (!is_whole || value < -32768 || value > 32767) return "is out of range; expected -32768 to 32767";
      state_.n0 = static_cast<std::int32_t>(value);
    } else if (name == "R0") {
      state_.r0 = value;
    } else if (name == "ECHO") {
      if (value != 0 && value != 1) return "is out of range; expected 0 or 1";
      state_.echo = value == 1;
    } else {
      return value_named(name) ? "cannot be set; it is read-only"
                               : "is not a name here; expected N0, R0 or ECHO";
    }
    ++revision_;
    return std::nullopt;
  }
  std::vector<std::string> names() const override { return {"N0", "R0", "ECHO", "MODULES"}; }

  // --- memory: everything is saved at once -------------------------------------------------------
  std::uint64_t memory_revision() const override { return revision_; }
  void settle_memory() override {}
  void load_program(std::string_view text) override {
    std::vector<std::string> lines;
    std::istringstream stream{std::string(text)};
    for (std::string line; std::getline(stream, line);) {
      if (line == "BAD")
        throw ProgramError(static_cast<int>(lines.size()) + 1, 1, "is not a command; expected one");
      lines.push_back(line);
    }
    state_.program = std::move(lines);
    ++revision_;
  }
  std::string program_text() const override {
    std::string text;
    for (const std::string& line : state_.program) text += line + "\n";
    return text;
  }

  // --- the rest of a device ----------------------------------------------------------------------
  void run_interpreters(Tick tick) override {
    if (tick != state_.speaks_at) return;
    state_.speaks_at = kNever;
    transmit("TICK " + std::to_string(tick));
  }
  Tick next_active_tick(Tick done) const override {
    return state_.speaks_at > done ? state_.speaks_at : kNever;
  }
  bool output(int) const override { return false; }
  bool output_moves(int) const override { return false; }

 protected:
  void power_up() override {
    if (firmware() == 100) transmit("HELLO");
  }
  void power_down() override {
    state_.speech.clear();
    state_.speaks_at = kNever;
    state_.echo = false;
  }
  void write_own_state(StateWriter& writer) const override { writer.write(state_); }
  std::function<void()> read_own_state(StateReader& reader) override {
    EchoState state;
    reader.read(state);
    return [this, state = std::move(state)] { state_ = state; };
  }
  std::string own_difference(StateReader& a, StateReader& b) const override {
    return difference_of_saved<EchoState>(a, b);
  }
  std::function<void(NvImage&)> memory_writer() const override {
    return [state = state_](NvImage& image) {
      if (state.n0 != 0) image.registers.emplace_back("N0", state.n0);
      if (state.r0 != 0) image.reals.emplace_back("R0", state.r0);
      image.program = state.program;
    };
  }
  void read_memory(const NvImage& image) override {
    EchoState state;
    for (const auto& [name, value] : image.registers) {
      if (name != "N0") throw NvError("registers: '" + name + "' is not a name here; expected N0");
      state.n0 = static_cast<std::int32_t>(value);
    }
    for (const auto& [name, value] : image.reals) {
      if (name != "R0") throw NvError("reals: '" + name + "' is not a name here; expected R0");
      state.r0 = value;
    }
    state.program = image.program;
    state_ = std::move(state);
  }

 private:
  static std::string text_of(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
  }
  void transmit(const std::string& line) { state_.speech += line + "\r\n"; }

  EchoState state_;
  std::uint64_t revision_ = 0;
};

class EchoLanguage final : public ProgramLanguage {
 public:
  std::string_view name() const override { return "list of words"; }
  std::string_view file_ending() const override { return ".txt"; }
  std::vector<ProgramMistake> check(std::string_view text, const DeviceSettings& settings) const override {
    const std::unique_ptr<Device> device = make_echo_box(settings);
    try {
      device->user_program()->load_program(text);
    } catch (const ProgramError& error) {
      return error.mistakes;
    }
    return {};
  }

 private:
  static std::unique_ptr<Device> make_echo_box(const DeviceSettings& settings);
};

inline const ProgramLanguage& echo_language() {
  static const EchoLanguage language;
  return language;
}

inline const Model& echo_box() {
  static const Model model{
      .name = "echo-box",
      .title = "says back what it is told",
      .firmwares = kEchoFirmwares,
      .language = &echo_language(),
      .commands = kEchoCommands,
      .choices = {},
      .terminals = kEchoTerminals,
      .axes = {},
      .state_registers = {},
      .known_limitations = {},
      .line = line_of_text(),
      .max_modules = 8,
      .make = [](const DeviceSettings& settings) -> std::unique_ptr<Device> {
        return std::make_unique<EchoBox>(echo_box(), settings);
      },
  };
  return model;
}

inline std::unique_ptr<Device> EchoLanguage::make_echo_box(const DeviceSettings& settings) {
  return std::make_unique<EchoBox>(echo_box(), settings);
}

/// A bench with one of them, "robot", on the line "serial".
inline Bench echo_bench(pty::Timing timing = pty::Timing::wire, DeviceSettings settings = {}) {
  Bench bench;
  settings.name = "robot";
  bench.devices.push_back({.model = &echo_box(), .settings = std::move(settings)});
  bench.lines.push_back({.name = "serial", .link = {}, .timing = timing, .stations = {0}});
  return bench;
}

/// Returns all models, including this one.
inline ModelList models_and_echo_box() {
  static const std::vector<ListedModel> models = [] {
    std::vector<ListedModel> list(models::all_models().begin(), models::all_models().end());
    list.push_back(&echo_box());
    return list;
  }();
  return models;
}

}  // namespace understudy::emulator::world
