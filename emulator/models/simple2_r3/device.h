// Simple2-R3: a two-axis pulse controller on Modbus RTU. Its state is one value, and its parts (listed in
// setup.h) are functions on this state. The device contains the facets and the order of a tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/stateful_device.h"
#include "emulator/device/terminals.h"
#include "emulator/device/user_program.h"
#include "emulator/models/simple2_r3/commands.h"
#include "emulator/models/simple2_r3/memory.h"
#include "emulator/models/simple2_r3/power.h"
#include "emulator/models/simple2_r3/programs.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/signals.h"
#include "emulator/models/simple2_r3/state.h"  // IWYU pragma: export

namespace understudy::emulator::models::simple2_r3 {

class Simple2R3 final : public StatefulDevice<Simple2R3, State>,
                        public RegisterBankOf<Simple2R3>,
                        public ModbusStation,
                        public PersistentMemory,
                        public UserProgram,
                        public Terminals,
                        public Axes {
 public:
  explicit Simple2R3(const DeviceSettings& given);

  const Setup& setup() const { return setup_; }
  State& state() { return state_; }
  const State& state() const { return state_; }
  Signals signals() const { return {state_, setup_}; }
  AxisCommands axis(int number) { return {state_, setup_, number}; }
  AxisView axis(int number) const { return {state_, setup_, number}; }
  Programs programs() { return {state_, setup_, *this}; }
  Memory kept() { return {state_, setup_}; }
  Power power() { return {state_, setup_, *this}; }

  // --- registers -----------------------------------------------------------------------------------
  std::span<std::uint32_t> image() override { return state_.image; }
  std::span<const std::uint32_t> image() const override { return state_.image; }
  const MapPolicy& map_policy() const override { return map_policy_; }
  bool answers_refusals() const override { return !chose(option("exceptions", "no_answer")); }
  bool keeps(const RegisterRow& row) const override { return setup_.keeps(row); }
  void register_written(const RegisterRow& row, std::size_t slot) override {
    kept().save(row, slot, was_saving_);
  }
  void registers_written() override {
    state_.touched = true;
    was_saving_.reset();
  }
  void warn_not_implemented(const RegisterRow& row) const override {
    Device::warn_not_implemented(row.name, row.not_implemented);
  }
  Addressing addressing(std::uint8_t address) const override;
  Reasons* reasons() override { return &setup_.reasons; }
  pty::LineSettings line_settings(std::size_t port) const override;

  // --- memory and program --------------------------------------------------------------------------
  std::uint64_t memory_revision() const override { return state_.eeprom.revision(); }
  void settle_memory() override { state_.eeprom.settle(state_.image); }
  void load_program(std::string_view listing) override { programs().load(listing); }
  std::string program_text() const override;
  std::vector<ProgramLocation> program_locations() const override { return {program_location(state_)}; }

  // --- time ----------------------------------------------------------------------------------------
  void sample_inputs(Tick tick) override;
  void run_interpreters(Tick tick) override;
  void step_motion(Tick tick) override;
  void update_outputs(Tick tick) override;
  Tick next_active_tick(Tick done) const override;
  Tick next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const override;
  void fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                       std::span<std::int64_t> pulses) override;
  void prefetch(Tick tick) const override;

  // --- terminals and axes --------------------------------------------------------------------------
  bool output(int terminal) const override;
  bool output_moves(int /*terminal*/) const override {
    return false;
  }  // commands switch outputs, in ticks that are run in full
  std::int64_t pulses_this_tick(int number) const override { return axis(number).state().pulses_this_tick; }
  double speed_pps(int number) const override { return axis(number).speed_pps(); }
  std::int64_t pulses_to_come(int number) const override { return axis(number).pulses_to_come(); }
  std::optional<bool> servo_on(int number) const override {
    return powered() && axis(number).state().motor.servo_on;
  }
  void set_encoder(int number, std::int64_t counts) override { axis(number).set_encoder(counts); }
  std::string_view pulse_format() const override { return pulse_formats()[pulse_format_number()]; }
  std::span<const std::string_view> pulse_formats() const override;
  std::size_t pulse_format_number() const override { return signals().dip_switch(1) ? 1 : 0; }
  std::optional<int> duty_percent(int number) const override { return pwm_duty(axis(number).state()); }

 protected:
  void power_up() override { power().up(); }
  void power_down() override { power().down(); }
  void check_restored(State& restored) const override;
  std::function<void(NvImage&)> memory_writer() const override;
  void read_memory(const NvImage& image) override;

 private:
  void watch_program(ProgramWatch* watch) override { program_watch_ = watch; }

  std::span<const int> line_bauds() const { return Device::model().line.ports.front().bauds; }
  /// Returns the next active tick, ignoring the axes.
  Tick next_tick_without_axes(Tick done) const;

  Setup setup_;
  MapPolicy map_policy_;
  // within a request: whether the EEPROM was being written when the request arrived
  std::optional<bool> was_saving_;
  ProgramWatch* program_watch_ = nullptr;
};

}  // namespace understudy::emulator::models::simple2_r3
