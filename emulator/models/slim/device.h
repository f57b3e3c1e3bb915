// SLIM: a chain of integrated servos behind one RS232 line. The host types commands and queries at module T0,
// or lets it run a stored program; both act on the chain (chain/chain.h).
//
//   a line ──> dialogue.cpp ──> an editor's line, a number for GETI, or a command
//                                            └─> commands.cpp, queries.cpp ──> chain, memory, program
//   a tick ──> device.cpp ──> program (interpreter/slim/flow.h) ──> commands.cpp
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/device_of.h"
#include "emulator/device/memory/kept_memory.h"
#include "emulator/device/named_values.h"
#include "emulator/device/terminals.h"
#include "emulator/device/text/text_protocol.h"
#include "emulator/device/user_program.h"
#include "emulator/models/slim/actions.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/rules/transitions.h"
#include "interpreter/slim/availability.h"
#include "interpreter/slim/editor.h"
#include "interpreter/slim/flow.h"

namespace understudy::emulator::models::slim {

inline constexpr std::size_t kMaxSpeech = 256 * 1024;

// The terminals of a module. Those of T0 come first, then those of T1, and so on.
inline constexpr int kInputs = lang::kInputCount;
inline constexpr int kHorg = kInputs;
inline constexpr int kAnalog = kHorg + 1;
inline constexpr int kFirstSwitch = kAnalog + 1;
inline constexpr int kFirstOutput = kFirstSwitch + lang::kSwitchCount;
inline constexpr int kTerminalsOfModule = kFirstOutput + kOutputs;
constexpr int terminal(int module, int which) { return module * kTerminalsOfModule + which; }

/// ?ERR and ?ERC of a module.
struct Errors {
  Error present = Error::none;
  std::vector<std::uint8_t> history{};  // the latest first

  bool operator==(const Errors&) const = default;
};

struct State {
  Memory ram;
  Memory kept;
  std::vector<std::string> kept_program{};
  std::uint64_t kept_revision = 0;
  Chain chain{};
  lang::Program program{};
  lang::Editor editor{};
  lang::Execution execution{};
  std::array<Errors, kModules> errors{};
  std::array<std::uint8_t, kModules> inputs{};  // bit n: input n + 1, as sampled in this tick
  Tick powered_at = 0;                          // ?time counts from it
  Tick clock_zero = 0;                          // TM counts from it
  std::string speech{};                         // not taken yet by the line
  bool touched = true;                          // an outside event has come since the last tick

  bool operator==(const State&) const = default;
};

class Slim final : public DeviceOf<Slim>,
                   public TextProtocol,
                   public NamedValues,
                   public KeptMemory,
                   public UserProgram,
                   public Terminals,
                   public Axes,
                   private lang::Machine {
 public:
  explicit Slim(const DeviceSettings& settings);

  // --- the dialogue ---
  TextRules text_rules() const override;
  void hear_line(std::string_view line) override;
  void hear_overlong() override;
  DeviceAnswer take_command(std::string_view line) override;
  void hear_escape() override;
  bool has_speech() const override { return !state_.speech.empty(); }
  std::string take_speech() override { return std::exchange(state_.speech, {}); }

  // --- by name ---
  std::optional<double> value_named(std::string_view name) const override;
  Tick next_change(std::string_view name, Tick done) const override;
  std::optional<std::string> assign(std::string_view name, double value) override;
  std::vector<std::string> names() const override;

  // --- memory ---
  std::uint64_t kept_revision() const override { return state_.kept_revision; }
  void settle_memory() override;
  void load_program(std::string_view text) override;
  std::string program_text() const override;
  std::vector<ProgramLocation> program_locations() const override;
  /// Returns the mistakes in a program text, for a device with these settings.
  std::vector<ProgramMistake> mistakes_in(std::string_view text) const { return read_program(text).mistakes; }

  // --- time ---
  void sample_inputs(Tick tick) override;
  void run_interpreters(Tick tick) override;
  void step_motion(Tick tick) override;
  void update_outputs(Tick tick) override;
  Tick next_active_tick(Tick done) const override;
  Tick next_event_tick(Tick done, Tick most, const ClearTravel& ahead) const override;
  void fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                       std::span<std::int64_t> pulses) override;
  bool same_state(const Device& other) const override;

  // --- terminals and axes ---
  bool has_axis(int axis) const override { return axis < modules_ || state_.chain.linked(axis); }
  bool has_terminal(int terminal) const override { return has_axis(terminal / kTerminalsOfModule); }
  bool output(int terminal) const override;
  bool output_moves(int /*terminal*/) const override {
    return false;
  }  // outputs that change by position or time have ticks of their own
  std::int64_t pulses_this_tick(int axis) const override { return state_.chain.module_at(axis).sent_pulses; }
  double speed_pps(int axis) const override { return state_.chain.speed_pps(axis); }
  std::optional<bool> servo_on(int axis) const override {
    return powered() && state_.chain.axis(axis).servo_on;
  }
  std::int64_t pulses_to_come(int axis) const override { return state_.chain.pulses_to_come(axis); }
  void set_encoder(int axis, std::int64_t counts) override;

  const State& state() const { return state_; }

 protected:
  void power_up() override;
  void power_down() override;
  void write_own_state(StateWriter& writer) const override;
  std::function<void()> read_own_state(StateReader& reader) override;
  std::string own_difference(StateReader& a, StateReader& b) const override;
  std::function<void(NvImage&)> memory_writer() const override;
  void read_memory(const NvImage& given) override;

 private:
  /// The reply to a command.
  struct Answer {
    std::string name{};
    std::string text{};
    std::optional<double> number{};  // the value of a numeric query
    bool has_words = true;           // false: only the number is needed
  };

  /// A program as read: its good lines, and the mistakes.
  struct ReadProgram {
    lang::Program program{};
    std::vector<ProgramMistake> mistakes{};
  };
  ReadProgram read_program(std::string_view text) const;

  // Machine of a program: interpreter/slim/machine.h.
  bool input(int number) const override;
  double value(const lang::Operand& operand) const override;
  lang::Outcome carry_out(const lang::Command& command) override;

  const std::optional<lang::Command>& query_named(std::string_view name) const;
  int chosen_number(std::size_t row) const { return number_of(kChoices[row], choice(row)); }

  // dialogue.cpp
  std::string_view line_end() const { return chose(option("output_end", "cr")) ? "\r" : "\r\n"; }
  bool is_silence(Error error) const {
    return error == Error::not_linked && chose(option("unlinked_module", "silence"));
  }
  /// Returns the number that is shown for an error.
  int code_of(Error error) const;
  std::size_t history_length() const {
    return static_cast<std::size_t>(chosen_number(numbers("history_length")));
  }
  /// Returns true if there is room for unrequested output of a program, which is faster than its line.
  bool has_room_to_speak() const {
    return state_.speech.size() < static_cast<std::size_t>(chosen_number(numbers("print_ahead")));
  }
  void say(std::string_view text);
  /// Acknowledges a successful command that has no reply of its own.
  void acknowledge() {
    if (chose(option("acknowledgement", "ok"))) say("OK");
  }
  bool errors_are_of_t0() const { return chose(option("error_of", "t0")); }
  /// Both return the module that ends up with the error.
  int fail(int module, Error error);
  int remember(int module, Error error);
  void note_error(int module, Error error);
  void conclude();
  Error hear_command(std::string_view line);
  bool is_heard_instead_of_number(std::string_view line) const;
  Error obey(lang::Command& command, std::vector<std::string>& lines);

  // commands.cpp
  friend struct SlimActions;
  Order order_of(const lang::Command& command);
  Error perform(Order& order, Action action);
  lang::Outcome::Program program_after_stop(From from) const;
  bool is_done(const lang::Command& command) const;
  bool would_wait(const lang::Command& command) const;

  // values.cpp
  RealForm real_form() const {
    return chose(option("real_format", "exponent_of_the_large_and_small")) ? RealForm::exponent
                                                                           : RealForm::plain;
  }
  double amount(const lang::Command& command, std::size_t operand) const;
  std::string text_of(const lang::Operand& variable) const;
  /// Returns true if, by choice, a module with an axis letter gives it up for a new one.
  bool takes_letters_away() const { return chose(option("axis_values", "is_taken_from_its_letter")); }
  Error set_variable(const lang::Operand& variable, double value);
  /// Returns the parameter's canonical name: PR4 is another name of PR3, unless it is a speed of its own.
  std::string_view meant(std::string_view parameter) const {
    return parameter == "PR4" && !state_.chain.options().lines_have_own_speed() ? "PR3" : parameter;
  }
  /// The user unit, by parameter numbers: this many pulses are this many user units.
  struct UserUnit {
    std::size_t pulses = parameter("PN45");
    std::size_t units = parameter("PN46");
  };
  UserUnit user_unit() const {
    if (chose(option("user_unit", "pn44_pulses_are_pn45_units")))
      return {parameter("PN44"), parameter("PN45")};
    return chose(option("user_unit", "pn46_pulses_are_pn45_units"))
               ? UserUnit{parameter("PN46"), parameter("PN45")}
               : UserUnit{};
  }
  bool is_of_user_unit(std::size_t number) const {
    return number == user_unit().pulses || number == user_unit().units;
  }
  Error set_scale(int module, std::size_t number, double value);
  Error set_parameter(int module, std::string_view given_name, double value);
  Error apply_parameter(int module, std::size_t number, double value);
  void apply_all_parameters();
  Error assign_axis(Letter letter, int module);
  void keep_axis_map();
  Error restore_factory_parameters();
  void keep_parameters();
  void keep_data();
  void keep_program();
  std::vector<std::string> parameter_list() const;
  std::int64_t clock_s() const { return (now() - state_.clock_zero) / 1000; }

  // queries.cpp
  friend struct SlimQueries;
  Error query(const lang::Command& command, Answer& answer) const;
  bool has_input_mask() const { return !chose(option("input_mask", "error_1")); }
  std::uint16_t status_bits(int module) const;
  std::string history_text(const Errors& errors) const;

  bool level(int module, int which) const { return Device::input(terminal(module, which)) != 0; }
  std::uint8_t input_levels(int module) const;
  bool sees_something_new() const;
  /// Returns none if the module is linked, else the error.
  Error linked(int module) const;
  ChainOptions chain_options() const;
  lang::ProgramOptions program_options() const;
  lang::FlowOptions flow_options() const;
  MemoryForm memory_form() const;
  const lang::ProgramOptions& of_programs() const { return flow_options_.program; }
  Memory factory() const;
  bool history_is_kept() const { return chose(option("history_kept", "for_ever")); }
  std::array<Errors, kModules> read_history(NvImage& image) const;
  /// Returns true if PZ holds the program.
  bool program_is_held() const {
    const bool is_paused =
        state_.chain.queues_paused() || (chose(pauses::kOnePause) && state_.chain.paused());
    return chose(option("pause_and_program", "program_pauses_too")) && is_paused;
  }
  void reboot();
  /// Returns the state as if all ticks up to now had been run one by one.
  State settled() const;
  void wake() {
    state_.chain.skip_to(now());
    state_.touched = true;
  }

  int modules_ = 1;
  lang::FlowOptions flow_options_{};
  int failed_module_ = 0;  // within a step of the program: the module whose command carry_out() has refused
  // Parsed queries by name: not state, only a cache.
  mutable std::map<std::string, std::optional<lang::Command>, std::less<>> queries_{};
  State state_;
};

}  // namespace understudy::emulator::models::slim
