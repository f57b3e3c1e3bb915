// A device: one instance of a model. The world steps it, a station serves its registers, the plant sees its
// pulses. Its whole state is a value; this class only says how the others reach it. What only some devices
// have is a facet: a separate class, reached by a pointer that is null if the device lacks it.
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
class KeptMemory;
class MachineAhead;
class ModbusStation;
class NamedValues;
class RegisterBank;
class Terminals;
class TextSpeaker;
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
  std::uint8_t choice(std::size_t number) const { return choices_[number]; }
  std::span<const std::uint8_t> choices() const { return choices_; }
  bool chose(const Option& option) const { return choice(option.choice) == option.number; }

  // --- facets ----------------------------------------------------------------------------------
  /// Its registers (register_map/register_bank.h).
  virtual RegisterBank* register_bank() { return nullptr; }
  virtual const RegisterBank* register_bank() const { return nullptr; }
  /// What it is on a line of Modbus (modbus/modbus_station.h).
  virtual ModbusStation* modbus() { return nullptr; }
  virtual const ModbusStation* modbus() const { return nullptr; }
  /// What it hears and says in lines of text (text/text_speaker.h).
  virtual TextSpeaker* speaker() { return nullptr; }
  virtual const TextSpeaker* speaker() const { return nullptr; }
  /// Values without a register (named_values.h).
  virtual NamedValues* named_values() { return nullptr; }
  virtual const NamedValues* named_values() const { return nullptr; }
  /// What it keeps without power (memory/kept_memory.h).
  virtual KeptMemory* memory() { return nullptr; }
  virtual const KeptMemory* memory() const { return nullptr; }
  /// The program that it runs by itself (user_program.h).
  virtual UserProgram* user_program() { return nullptr; }
  virtual const UserProgram* user_program() const { return nullptr; }
  /// What it does with its terminals (terminals.h).
  virtual const Terminals* terminals() const { return nullptr; }
  /// The axes that it drives (axes.h).
  virtual Axes* axes() { return nullptr; }
  virtual const Axes* axes() const { return nullptr; }

  // --- lines -----------------------------------------------------------------------------------
  /// Of the line at one of its ports: its model's, at the speed that its settings say.
  virtual pty::LineSettings line_settings(std::size_t port) const;
  /// Whether its ports have their own speed whatever a bench says of their lines: at another one it is deaf.
  virtual bool keeps_its_speed() const { return false; }
  /// As its memory or its settings have it; nothing where its model has none.
  std::optional<int> station_number() const;

  // --- power -----------------------------------------------------------------------------------
  /// A device is made without power. When it is switched on it begins with what its memory has kept.
  bool powered() const { return powered_; }
  void switch_power(bool on);

  // --- time: the phases of a tick, in this order; devices meet between ticks only ---------------------
  // Where a device has nothing to do in a phase, nothing is done. (Not here: the compiler would guess at each
  // call that it is the empty one.)
  virtual void sample_inputs(Tick tick);
  virtual void run_interpreters(Tick tick);
  virtual void step_motion(Tick tick);
  virtual void update_outputs(Tick tick);
  /// The first tick after `done` at which anything may change without help from outside; kNever if none. The
  /// ticks before it may be skipped: the state is then the same as if they had been run.
  virtual Tick next_active_tick(Tick done) const;
  /// The first tick after `done` that has to be run as it is. Those before it only count on what moves, as
  /// far as each axis has room, and may be made up in one step by cross_to(). Not beyond `most` + 1.
  virtual Tick next_event_tick(Tick done, Tick most, const MachineAhead& ahead) const;
  /// Brings it to the end of `tick`, which lies after `done` and before next_event_tick(): the same state as
  /// by single ticks. Adds what each axis sends meanwhile.
  virtual void cross_to(Tick done, Tick tick, const MachineAhead& ahead, std::span<std::int64_t> pulses);
  /// Asks the processor for the memory that `tick` will need (base/prefetch.h).
  virtual void prefetch(Tick tick) const;
  /// Whether it equals another device of the same model, bit for bit.
  virtual bool same_state(const Device& other) const = 0;

  // --- its state as bytes (base/state/) ---------------------------------------------------------
  /// Its whole state at this moment; what it was made from (model, firmware, settings, choices) is not
  /// included.
  std::vector<std::byte> save_state() const;
  /// Like the above; texts that copies share are added to `shared` and stand in the bytes as digests.
  std::vector<std::byte> save_state(std::vector<SharedText>& shared) const;
  /// Calling the result puts the device into a state that save_state() of a device of the same make has
  /// returned. Throws StateError for other bytes.
  std::function<void()> read_state(std::span<const std::byte> bytes);
  std::function<void()> read_state(StateReader reader);
  /// Like the above, at once; if it throws, nothing has changed.
  void restore_state(std::span<const std::byte> bytes) { read_state(bytes)(); }
  std::uint64_t state_hash() const;
  /// "axes[0].motor.travel_pulses: 12 against 13": the first field by which two states differ that
  /// save_state() of devices made alike has given; empty if none does. Throws StateError for other bytes.
  std::string state_difference(std::span<const std::byte> a, std::span<const std::byte> b) const;
  std::string state_difference(StateReader a, StateReader b) const;

  // --- levels from outside, by the terminal's number in the model's table, in its unit -----------------
  /// The device looks at them in sample_inputs().
  void set_input(int terminal, std::int32_t level) {
    inputs_[static_cast<std::size_t>(terminal)] = level;
    inputs_changed_ = true;
  }
  std::int32_t input(int terminal) const { return inputs_[static_cast<std::size_t>(terminal)]; }

  /// The last tick that is over. Set by the world; what a write starts begins to move in the next one.
  Tick now() const { return now_; }
  void set_now(Tick tick) { now_ = tick; }

  // --- log -----------------------------------------------------------------------------------
  /// Tells the user, once for each, that something is not modelled: a register, a command, a parameter.
  void mention_unmodelled(std::string_view what, std::string_view why) const;
  void set_log(std::function<void(const std::string&)> log) { log_ = std::move(log); }

 protected:
  /// Whether set_input(), the power or a restored state may have changed them since take_inputs_changed().
  bool inputs_changed() const { return inputs_changed_; }
  bool take_inputs_changed() { return std::exchange(inputs_changed_, false); }
  /// Sets the state at power-up, from what is kept and the inputs.
  virtual void power_up() {}
  /// Stops driving anything, and loses all that is not kept.
  virtual void power_down() {}
  /// The model's part of the state.
  virtual void write_own_state(StateWriter& writer) const = 0;
  /// Reads it; calling the result puts it in force, which does not throw.
  virtual std::function<void()> read_own_state(StateReader& reader) = 0;
  /// Reads two of it, and tells where they differ (base/state/difference.h).
  virtual std::string own_difference(StateReader& a, StateReader& b) const = 0;

 private:
  friend struct StateOf<Device>;  // device_state.cpp

  // What every tick needs comes first: the rest lies behind the first cache line.
  const Model& model_;
  Tick now_ = 0;
  bool powered_ = false;
  bool inputs_changed_ = true;  // not state: only whether a device may skip looking at them
  std::vector<std::uint8_t> choices_;
  std::vector<std::int32_t> inputs_;
  DeviceSettings settings_;
  std::function<void(const std::string&)> log_;
  mutable std::set<std::string, std::less<>> mentioned_;  // of the log, not of the model
};

/// Throws ProgramError, also if the device takes no program.
void load_program(Device& device, std::string_view text);

/// "nothing of robot is called 'T9PE'; ...": why named_values() has no such value, as one line.
std::string why_no_value(const Device& device, std::string_view name);

}  // namespace understudy::emulator
