// RS-M8194H: the i-8094H module, which contains the FIFO, the chip and the macros. Each of its parts has its
// own state, and may use the parts above it in the list of members. Macros and the FIFO access the parts
// below them only through lang::Machine, which the module implements.
//
//   a command ──> (command_queue.h) ──> commands.h: its effects on the parts
//   a tick: the inputs ──> motion_step.h, with its edges (edges.h) ──> macros ──> the FIFO
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/models/rs_m8194h/chip/chip.h"
#include "emulator/models/rs_m8194h/chip/interrupts.h"
#include "emulator/models/rs_m8194h/chip/scans.h"
#include "emulator/models/rs_m8194h/drives/drives.h"
#include "emulator/models/rs_m8194h/drives/edges.h"
#include "emulator/models/rs_m8194h/drives/external.h"
#include "emulator/models/rs_m8194h/drives/motion_step.h"
#include "emulator/models/rs_m8194h/drives/path_starts.h"
#include "emulator/models/rs_m8194h/drives/stops.h"
#include "emulator/models/rs_m8194h/drives/streams.h"
#include "emulator/models/rs_m8194h/programs/command_queue.h"
#include "emulator/models/rs_m8194h/programs/frnet.h"
#include "emulator/models/rs_m8194h/programs/memory.h"
#include "emulator/models/rs_m8194h/programs/programs.h"
#include "emulator/models/rs_m8194h/programs/status.h"
#include "emulator/models/rs_m8194h/programs/triggers.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "emulator/models/rs_m8194h/state.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/machine.h"

namespace understudy::emulator::models::rs_m8194h {

class Module final : public Part, private lang::Machine {
  State& state_;

 public:
  Module(const Ground& ground, State& state);

  // --- its parts --------------------------------------------------------------------------------
  Memory memory;
  Status status;
  Frnet frnet;
  Chip chip;
  Interrupts interrupts;
  Scans scans;
  Streams streams;
  Drives drives;
  External external;
  PathStarts path_starts;
  Stops stops;
  Edges edges;
  MotionStep motion_step;
  Programs programs;
  CommandQueue queue;
  Triggers triggers;

  State& state() { return state_; }
  const State& state() const { return state_; }
  bool is_absent() const { return input(kNoModuleSwitch) != 0; }
  /// Executes a command now, or returns that it must wait.
  Took carry_out(const lang::Command& command) override;

  // --- time -------------------------------------------------------------------------------------
  void sample_inputs(Tick tick, bool inputs_changed);
  void step_motion(Tick tick) { motion_step.step(tick); }
  void update_outputs(Tick tick);
  /// Return the next tick in which anything may change, and the next tick that must be run in full. They
  /// assume that the inputs do not change after `done`.
  Tick next_active_tick(Tick done) const;
  Tick next_event_tick(Tick done, Tick max, const ClearTravel& ahead) const;
  void prefetch() const;

  // --- memory and power (power.cpp) ---------------------------------------------------------------
  void load_program(std::string_view text);
  void power_up();
  void power_down();
  /// Execute RESET_CARD and LOAD_INITIAL.
  void reset_card();
  void load_initial();
  /// Continues from a restored state.
  void take_over(const State& restored);

 private:
  /// Resets everything to its power-up value, except the memory, the encoders' raw counts and the pulse
  /// counts of OUT_X and OUT_Y.
  void blank();
  void blank_module();
  bool rests() const;

  // --- lang::Machine (machine.cpp) ----------------------------------------------------------------
  const lang::Macro* macro(const lang::MacroName& name) const override { return programs.macro(name); }
  std::int32_t variable(std::size_t number) const override { return memory.variable(number); }
  void set_variable(std::size_t number, std::int32_t value) override { memory.set_variable(number, value); }
  std::uint8_t byte_variable(std::size_t number) const override { return memory.byte_variable(number); }
  std::int32_t read(const lang::Command& command) const override;
  bool stand(std::uint32_t axes) const override { return (chip.driving() & axes) == 0; }
  bool frnet_input(std::uint32_t group, std::uint32_t channel) const override;
  int take_isr() override { return programs.take_isr(); }
  void mp_ended() override { programs.mp_ended(); }
  void terminated() override { programs.terminated(); }
  void report(const lang::ExecutionFault& fault) override { programs.report(fault); }
};

}  // namespace understudy::emulator::models::rs_m8194h
