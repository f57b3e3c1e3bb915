// SLIM: a chain of integrated servos behind one RS232 line. The host sends commands and queries to module T0,
// or starts a stored program. Both act on the chain (chain/chain.h).
//
//   a line ──> dialogue.cpp ──> an editor's line, a number for GETI, or a command
//                                            └─> commands.cpp, queries.cpp ──> chain, memory, program
//   a tick ──> device.cpp ──> program (interpreter/slim/flow.h) ──> commands.cpp
//
// setup.h lists the parts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/named_values.h"
#include "emulator/device/program_parts.h"
#include "emulator/device/stateful_device.h"
#include "emulator/device/terminals.h"
#include "emulator/device/text/text_protocol.h"
#include "emulator/device/user_program.h"
#include "emulator/models/slim/by_name.h"
#include "emulator/models/slim/memory_image.h"
#include "emulator/models/slim/power.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/machine.h"

namespace understudy::emulator::models::slim {

class Slim final : public StatefulDevice<Slim, State>,
                   public TextProtocol,
                   public NamedValues,
                   public PersistentMemory,
                   public UserProgram,
                   public Terminals,
                   public Axes,
                   private lang::Machine {
 public:
  explicit Slim(const DeviceSettings& settings);

  // --- the dialogue ---
  TextRules text_rules() const override;
  void receive_line(std::string_view line) override;
  std::string_view meaning_of(std::string_view line) const override;
  void receive_overlong() override;
  DeviceAnswer take_command(std::string_view line) override;
  void receive_escape() override;
  bool has_text() const override { return !state_.output.empty(); }
  std::string take_text() override { return std::exchange(state_.output, {}); }

  // --- by name ---
  std::optional<double> value_named(std::string_view name) const override;
  Tick next_change(std::string_view /*name*/, Tick done) const override { return next_second(state_, done); }
  std::optional<std::string> assign(std::string_view name, double value) override;
  std::vector<std::string> names() const override { return common_names(state_, setup_); }

  // --- memory ---
  std::uint64_t memory_revision() const override { return state_.memory_revision; }
  void settle_memory() override;
  void load_program(std::string_view text) override;
  std::string program_text() const override;
  std::vector<ProgramLocation> program_locations() const override;
  /// Returns the mistakes in a program text for a device with these settings.
  std::vector<ProgramMistake> mistakes_in(std::string_view text) const;
  std::vector<ProgramPart> parts_of(std::string_view text) const;

  // --- time ---
  void sample_inputs(Tick tick) override;
  void run_interpreters(Tick tick) override;
  void step_motion(Tick tick) override { state_.chain.step(tick); }
  void update_outputs(Tick tick) override;
  Tick next_active_tick(Tick done) const override;
  Tick next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const override;
  void fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                       std::span<std::int64_t> pulses) override;
  State settled() const;

  // --- terminals and axes ---
  bool has_axis(int axis) const override { return axis < setup_.modules || state_.chain.linked(axis); }
  bool has_terminal(int terminal) const override { return has_axis(terminal / kTerminalsOfModule); }
  bool output(int terminal) const override;
  bool output_moves(int /*terminal*/) const override {
    return false;
  }  // outputs that depend on position or time change in ticks that are run in full
  std::int64_t pulses_this_tick(int axis) const override { return state_.chain.module_at(axis).sent_pulses; }
  double speed_pps(int axis) const override { return state_.chain.speed_pps(axis); }
  std::optional<bool> servo_on(int axis) const override {
    return powered() && state_.chain.axis(axis).servo_on;
  }
  std::int64_t pulses_to_come(int axis) const override { return state_.chain.pulses_to_come(axis); }
  void set_encoder(int axis, std::int64_t counts) override;

 protected:
  void power_up() override { slim::power_up(state_, setup_); }
  void power_down() override { slim::power_down(state_, setup_); }
  void check_restored(State& restored) const override;
  std::function<void(NvImage&)> memory_writer() const override { return image_writer(state_, setup_); }
  void read_memory(const NvImage& image) override { read_image(state_, setup_, image); }

 private:
  void watch_program(ProgramWatch* watch) override { set_watch(watch); }

  // The machine on which a program runs (interpreter/slim/machine.h).
  bool input(int number) const override { return ((state_.inputs[0] >> (number - 1)) & 1) != 0; }
  double value(const lang::Operand& operand) const override;
  lang::Outcome carry_out(const lang::Command& command) override;

  /// Called on an event from outside, possibly after skipped ticks.
  void wake();

  const Setup setup_;
  int failed_module_ = 0;            // within a program step: the module whose command was refused
  mutable QueriesByName queries_{};  // only a cache, not part of the state
};

}  // namespace understudy::emulator::models::slim
