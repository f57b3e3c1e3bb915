// Emulates a described controller: its registers, the axes that are bound to them, and values that follow
// other values. Its state is one value; the bindings belong to its model (model.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/stateful_device.h"
#include "emulator/device/terminals.h"
#include "emulator/models/imported/axis_drive.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::models::imported {

class ImportedModel;
struct ShownPart;

struct State {
  bool touched = true;  // requests or inputs may have changed since motion last checked them
  std::vector<std::uint32_t> image{};
  std::vector<std::uint8_t> held{};  // by axis and command: whether the condition was true at the last check
  std::vector<AxisState> axes{};
  std::vector<double> followed{};  // by following: the value in counts
  Eeprom eeprom{};

  bool operator==(const State&) const = default;
};

class ImportedDevice final : public StatefulDevice<ImportedDevice, State>,
                             public RegisterBankOf<ImportedDevice>,
                             public ModbusStation,
                             public PersistentMemory,
                             public Terminals,
                             public Axes {
 public:
  /// The device keeps a reference to the model.
  ImportedDevice(const ImportedModel& model, const DeviceSettings& settings);

  // --- registers -----------------------------------------------------------------------------
  std::span<std::uint32_t> image() override { return state_.image; }
  std::span<const std::uint32_t> image() const override { return state_.image; }
  DeviceAnswer admits(const RegisterRequest& request, Checked checked) const override;
  void register_written(const RegisterRow& row, std::size_t slot) override;
  void registers_written() override;
  void warn_not_implemented(const RegisterRow& row) const override {
    Device::warn_not_implemented(row.name, row.not_implemented);
  }
  /// Returns the present value of a register according to its type.
  Value value_of_register(std::size_t number) const;
  Value value_at(const Spot& spot) const;
  void write_view(std::size_t number, Value value);

  // --- the line --------------------------------------------------------------------------------
  Addressing addressing(std::uint8_t address) const override;
  pty::SimTime end_silence(pty::SimTime usual) const override;

  // --- memory ----------------------------------------------------------------------------------
  std::uint64_t memory_revision() const override { return state_.eeprom.revision(); }
  void settle_memory() override { state_.eeprom.settle(state_.image); }

  // --- time ------------------------------------------------------------------------------------
  void sample_inputs(Tick tick) override;
  void step_motion(Tick tick) override;
  void update_outputs(Tick tick) override;
  Tick next_active_tick(Tick done) const override;
  Tick next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const override;
  void fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                       std::span<std::int64_t> pulses) override;

  // --- terminals and axes -------------------------------------------------------------------------
  bool output(int terminal) const override;
  bool output_moves(int terminal) const override;
  std::int64_t pulses_this_tick(int axis) const override { return at(axis).sent_pulses; }
  double speed_pps(int axis) const override { return imported::speed_pps(at(axis), now()); }
  std::int64_t pulses_to_come(int axis) const override { return at(axis).motor.pulses_to_come(); }
  std::optional<bool> servo_on(int axis) const override;
  void connect_encoder(int axis, std::int64_t counts) override { at(axis).encoder_counts = counts; }
  void set_encoder(int axis, std::int64_t counts) override;
  bool meets_edges() const override { return true; }
  std::int64_t place_pulses(int axis) const override { return at(axis).motor.travel_pulses; }
  void set_edges(int axis, const MachineEdges& edges) override;

 protected:
  void power_up() override;
  void power_down() override;
  void check_restored(State& restored) const override;
  void take_over(const State& restored) override;
  std::function<void(NvImage&)> memory_writer() const override;
  void read_memory(const NvImage& image) override;

 private:
  const Description& description() const;
  std::int32_t level_at_rest(const Spot& spot) const;
  AxisState& at(int axis) { return state_.axes[static_cast<std::size_t>(axis)]; }
  const AxisState& at(int axis) const { return state_.axes[static_cast<std::size_t>(axis)]; }
  State state_at_power_up() const;

  Value value_of_part(const ShownPart& part, Type type) const;
  Value value_of_view(std::size_t axis_number, View view, Type type) const;
  bool holds(const Comparison& comparison) const;
  double counts_of(const Quantity& quantity) const;
  double goal_of(const Following& following) const;

  bool holds_now(const Condition& condition) const { return condition.matches(value_at(condition.spot)); }
  bool is_given(const Condition& condition, bool was_held) const;
  void check_commands();
  void steer_axes(Tick done);
  template <typename Act>
  void attempt(std::size_t axis, Act act);
  void update_environment(std::size_t axis_number);
  void finish_step(std::size_t axis_number, std::int64_t pulses);
  bool is_quiet(const AxisState& axis) const;
  bool any_moves() const;
  Tick next_tick_of_values(Tick done) const;
  void renew_followed(Tick tick);

  const ImportedModel& model_;
  const CountsOf counts_of_ = [this](const Quantity& quantity) { return counts_of(quantity); };
  std::vector<MachineEdges> edges_;        // not state: set again after a restore
  std::vector<std::uint8_t> is_restored_;  // the axes that have been restored; not state
  std::vector<std::size_t> written_;       // slots of the registers written by the current request
  std::vector<double> shares_;             // by following: the fraction of the distance covered in a period
};

/// These read and write every row that shows other state (Cell::argument is the register's number in the
/// list).
Value read_shown(const ImportedDevice& device, Cell cell);
void write_shown(ImportedDevice& device, Cell cell, Value value);

}  // namespace understudy::emulator::models::imported
