// A device is an instance of a model. The world steps it, a station serves its registers, and the plant
// receives its pulses. Its whole state is a value; this class only defines how other code accesses it.
// Features that only some devices have are facets: separate classes, reached through a pointer that is null
// if the device lacks the feature.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/decisions.h"
#include "emulator/device/model.h"
#include "pty/line_settings.h"

namespace understudy {
class SharedText;
class StateReader;
class StateWriter;
template <class T>
struct StateOf;
}  // namespace understudy

namespace understudy::emulator {

class Axes;
class PersistentMemory;
class ClearTravel;
class ModbusStation;
class NamedValues;
class RegisterBank;
class Terminals;
class TextProtocol;
class UserProgram;

class Device {
 public:
  Device(const Model& model, DeviceSettings settings);
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const Model& model() const { return model_; }
  const std::string& name() const { return settings_.name; }
  Firmware firmware() const { return settings_.firmware; }
  const DeviceSettings& settings() const { return settings_; }
  /// For observers: returns the number of the selected option of a choice row. The device's own code calls
  /// chose().
  std::uint8_t choice(std::size_t number) const { return choices_[number]; }
  std::span<const std::uint8_t> choices() const { return choices_; }
  bool chose(const Option& option) const {
    decisions_.ask(option.choice);
    return choices_[option.choice] == option.number;
  }
  AskedOptions asked_options() const { return {.numbers = choices_, .decisions = &decisions_}; }
  /// The device's code records its decisions here. Only coverage reads them.
  Decisions& decisions() const { return decisions_; }

  // --- facets ----------------------------------------------------------------------------------
  /// The device's registers (register_map/register_bank.h).
  virtual RegisterBank* register_bank() { return nullptr; }
  virtual const RegisterBank* register_bank() const { return nullptr; }
  /// The device as a Modbus station (modbus/modbus_station.h).
  virtual ModbusStation* modbus() { return nullptr; }
  virtual const ModbusStation* modbus() const { return nullptr; }
  /// The device's text protocol (text/text_protocol.h).
  virtual TextProtocol* text_protocol() { return nullptr; }
  virtual const TextProtocol* text_protocol() const { return nullptr; }
  /// Values without a register (named_values.h).
  virtual NamedValues* named_values() { return nullptr; }
  virtual const NamedValues* named_values() const { return nullptr; }
  /// The memory that survives power-off (memory/persistent_memory.h).
  virtual PersistentMemory* memory() { return nullptr; }
  virtual const PersistentMemory* memory() const { return nullptr; }
  /// The user program that the device can run (user_program.h).
  virtual UserProgram* user_program() { return nullptr; }
  virtual const UserProgram* user_program() const { return nullptr; }
  /// The device's terminals (terminals.h).
  virtual const Terminals* terminals() const { return nullptr; }
  /// The axes that the device drives (axes.h).
  virtual Axes* axes() { return nullptr; }
  virtual const Axes* axes() const { return nullptr; }

  // --- lines -----------------------------------------------------------------------------------
  /// Returns the settings of one of its ports: those of the model, with the speed from the device's own
  /// settings.
  virtual pty::LineSettings line_settings(std::size_t port) const;
  /// Returns true if its ports keep their own speed, whatever speed the bench sets for their lines. If the
  /// line has a different speed, the device receives nothing.
  virtual bool keeps_its_speed() const { return false; }
  /// Returns the station number in its memory or settings, or nothing if its model has no station number.
  std::optional<int> station_number() const;

  // --- power -----------------------------------------------------------------------------------
  /// A new device has no power. When it is switched on, it starts from its memory.
  bool powered() const { return powered_; }
  void switch_power(bool on);

  // --- time: the phases of a tick, in this order; devices interact only between ticks ------------------
  // By default, a phase does nothing. The empty functions are not defined here, because the compiler would
  // then assume at each call that the empty function is called.
  virtual void sample_inputs(Tick tick);
  virtual void run_interpreters(Tick tick);
  virtual void step_motion(Tick tick);
  virtual void update_outputs(Tick tick);
  /// Returns the first tick after `done` in which anything may change without an outside event, or kNever.
  /// Earlier ticks may be skipped; the state is then the same as if they had run.
  virtual Tick next_active_tick(Tick done) const;
  /// Returns the first tick after `done` that must be run in full, at most `limit` + 1. In earlier ticks,
  /// only positions change, within the room that `ahead` allows each axis, and fast_forward_to() can skip
  /// these ticks in one step.
  virtual Tick next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const;
  /// Advances the device to the end of `tick`, which is after `done` and before next_event_tick(). The state
  /// is the same as after single ticks. Adds the pulses that each axis sends to `pulses`.
  virtual void fast_forward_to(Tick done, Tick tick, const ClearTravel& ahead,
                               std::span<std::int64_t> pulses);
  /// Prefetches the memory that `tick` will need (base/prefetch.h).
  virtual void prefetch(Tick tick) const;

  // --- its state as bytes (base/state/) ---------------------------------------------------------
  /// Returns the whole present state. This does not include what the device was created from (model,
  /// firmware, settings, choices).
  std::vector<std::byte> save_state() const;
  /// Like save_state(), but shared texts are appended to `shared`, and the bytes contain only their digests.
  std::vector<std::byte> save_state(std::vector<SharedText>& shared) const;
  /// Reads a state saved by a device with the same settings. Calling the returned function puts the state
  /// into effect. Throws StateError for any other bytes.
  std::function<void()> read_state(std::span<const std::byte> bytes);
  std::function<void()> read_state(StateReader reader);
  /// Reads a state and puts it into effect immediately. If it throws, nothing has changed.
  void restore_state(std::span<const std::byte> bytes) { read_state(bytes)(); }
  std::uint64_t state_hash() const;
  /// Returns true if this device and another one of the same model would save exactly the same bytes.
  bool same_state(const Device& other) const;
  /// Compares two saved states of devices with the same settings, and returns the first field in which they
  /// differ: "axes[0].motor.travel_pulses: 12 against 13". Empty if they are equal. Throws StateError for any
  /// other bytes.
  std::string state_difference(std::span<const std::byte> a, std::span<const std::byte> b) const;
  std::string state_difference(StateReader a, StateReader b) const;

  // --- levels from outside, by the terminal's number in the model's table, in its unit -----------------
  /// Sets an input's level, which the device reads in sample_inputs(). Setting the present level again wakes
  /// nothing, because wires set their levels in every tick.
  void set_input(int terminal, std::int32_t level) {
    std::int32_t& held = inputs_[static_cast<std::size_t>(terminal)];
    if (held == level) return;
    held = level;
    inputs_changed_ = true;
  }
  std::int32_t input(int terminal) const { return inputs_[static_cast<std::size_t>(terminal)]; }

  /// Returns the last completed tick, which the world sets. If a write starts a motion, the motion begins in
  /// the next tick.
  Tick now() const { return now_; }
  void set_now(Tick tick) { now_ = tick; }

  // --- log -----------------------------------------------------------------------------------
  /// Warns the user, once for each item, that a register, a command or a parameter is not modelled.
  void warn_not_implemented(std::string_view what, std::string_view why) const;
  void set_log(std::function<void(const std::string&)> log) { log_ = std::move(log); }

 protected:
  /// Returns true if set_input(), a change of power or a restored state may have changed inputs since
  /// take_inputs_changed().
  bool inputs_changed() const { return inputs_changed_; }
  bool take_inputs_changed() { return std::exchange(inputs_changed_, false); }
  /// Sets the state at power-up, which depends on the memory and the inputs.
  virtual void power_up() {}
  /// Stops driving outputs and axes, and drops all state that does not survive power-off.
  virtual void power_down() {}
  /// Writes the model's part of the state.
  virtual void write_own_state(StateWriter& writer) const = 0;
  /// Reads the model's part of the state. Calling the returned function puts it into effect; the function
  /// does not throw.
  virtual std::function<void()> read_own_state(StateReader& reader) = 0;
  /// Reads the model's part of two states, and returns where they differ (base/state/difference.h).
  virtual std::string own_difference(StateReader& a, StateReader& b) const = 0;

 private:
  friend struct StateOf<Device>;  // device_state.cpp

  // Members that every tick needs come first. The other members follow the first cache line.
  const Model& model_;
  Tick now_ = 0;
  bool powered_ = false;
  bool inputs_changed_ = true;  // not part of the state: only allows a device to skip reading its inputs
  std::vector<std::uint8_t> choices_;
  mutable Decisions decisions_;
  std::vector<std::int32_t> inputs_;
  DeviceSettings settings_;
  std::function<void(const std::string&)> log_;
  mutable std::set<std::string, std::less<>> mentioned_;  // part of the log, not of the state
};

/// Loads a program. Throws ProgramError, including when the device does not run programs.
void load_program(Device& device, std::string_view text);

/// Returns a one-line explanation of why named_values() has no such value: "robot has no value called 'T9PE';
/// ...".
std::string why_no_value(const Device& device, std::string_view name);

}  // namespace understudy::emulator
