// SUPER-40NC: a four-axis controller on Modbus RTU with two ports. Its state is one value, and its parts
// (parts.h) are functions on this state. The device contains the facets and the order of a tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/stateful_device.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "emulator/models/super_40nc/parts.h"
#include "emulator/models/super_40nc/state.h"  // IWYU pragma: export

namespace understudy::emulator::models::super_40nc {

class Super40nc final : public StatefulDevice<Super40nc, State>,
                        public RegisterBankOf<Super40nc>,
                        public ModbusStation,
                        public PersistentMemory,
                        public UserProgram,
                        public Terminals,
                        public Axes {
 public:
  explicit Super40nc(const DeviceSettings& given);

  Parts& parts() { return parts_; }
  const Parts& parts() const { return parts_; }

  // --- registers -----------------------------------------------------------------------------------
  std::span<std::uint32_t> image() override { return state_.image; }
  std::span<const std::uint32_t> image() const override { return state_.image; }
  void register_written(const RegisterRow& row, std::size_t slot) override;
  bool keeps(const RegisterRow& row) const override { return parts_.ground.keeps(row); }
  void registers_written() override { state_.touched = true; }
  void warn_not_implemented(const RegisterRow& row) const override;
  const MapPolicy& map_policy() const override { return map_policy_; }
  Addressing addressing(std::uint8_t address) const override;
  bool knows(std::uint8_t function) const override;
  bool answers_refusals() const override;
  DeviceAnswer admits(const RegisterRequest& request, Checked checked) const override;
  pty::SimTime end_silence(pty::SimTime usual) const override;
  void receive_failed(std::size_t port, pty::ReceiveError error) override;

  // --- memory and programs -------------------------------------------------------------------------
  TextBlocks* text_blocks() override { return &state_.blocks; }
  const TextBlocks* text_blocks() const override { return &state_.blocks; }
  std::uint64_t memory_revision() const override {
    return state_.eeprom.revision() + state_.blocks.revision();
  }
  void settle_memory() override { state_.eeprom.settle(state_.image); }
  void load_program(std::string_view text) override { parts_.programs.load_program(text); }
  std::string program_text() const override { return parts_.programs.stored().program_text(); }
  std::vector<ProgramLocation> program_locations() const override {
    return parts_.programs.program_locations();
  }

  // --- time ----------------------------------------------------------------------------------------
  void sample_inputs(Tick tick) override;
  void run_interpreters(Tick tick) override;
  void step_motion(Tick tick) override;
  void update_outputs(Tick tick) override;
  Tick next_active_tick(Tick done) const override;
  Tick next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const override;
  void fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                       std::span<std::int64_t> pulses) override;

  // --- terminals and axes --------------------------------------------------------------------------
  bool has_terminal(int terminal) const override;
  bool output(int terminal) const override;
  bool output_moves(int terminal) const override;
  std::int32_t analog_level(int terminal) const override;
  std::int64_t pulses_this_tick(int axis) const override { return chips().axis(axis).sent_pulses; }
  double speed_pps(int axis) const override { return chips().speed_pps(axis); }
  std::int64_t pulses_to_come(int axis) const override { return chips().pulses_to_come(axis); }
  void set_encoder(int axis, std::int64_t counts) override { parts_.axes.counters.set_encoder(axis, counts); }
  bool meets_edges() const override { return true; }
  std::int64_t place_pulses(int axis) const override { return chips().place_pulses(axis); }
  void set_edges(int axis, const MachineEdges& edges) override { parts_.axes.inputs.set_edges(axis, edges); }

 protected:
  void power_up() override;
  void power_down() override;
  void check_restored(State& restored) const override;
  void take_over(const State& restored) override;
  std::function<void(NvImage&)> memory_writer() const override;
  void read_memory(const NvImage& image) override;

 private:
  void watch_program(ProgramWatch* watch) override { parts_.programs.set_watch(watch); }
  const Chips& chips() const { return parts_.axes.chips; }
  void check_inputs();
  bool has_voltage_inputs() const;
  std::int32_t analog_counts(int number) const;
  void blank_state();
  void end_path();
  void stop_by_comparators(int axis);
  /// Returns the first tick after `done` in which a timed event is due.
  Tick next_timed_tick(Tick done) const;

  Parts parts_{*this, *this, state_};
  MapPolicy map_policy_;
};

}  // namespace understudy::emulator::models::super_40nc
