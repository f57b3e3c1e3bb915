// A device: one instance of a model. The world steps it, a station serves its registers, the plant
// sees its pulses. Its whole state is a value; this class only says how the others reach it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "pty/line_settings.h"

namespace understudy {
class StateReader;
class StateWriter;
}  // namespace understudy

namespace understudy::emulator {

class TextSpeaker;

/// What a station does with a frame that carries some address.
enum class Addressing : std::uint8_t { ignore, obey_silently, obey_and_reply };

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
  bool chose(const Option& option) const { return choice(option.choice) == option.number; }

  // --- registers -----------------------------------------------------------------------------
  const RegisterMap& registers() const { return model_.registers; }
  /// The map's, or what this device makes of it.
  virtual const MapPolicy& map_policy() const { return registers().policy(); }
  /// One slot for each register, as the map numbers them.
  virtual std::span<std::uint32_t> image() = 0;
  virtual std::span<const std::uint32_t> image() const = 0;
  virtual bool low_word_first() const { return registers().policy().low_word_first; }
  /// Called for each register that a request has written, after its effect.
  virtual void register_written(const RegisterRow& row, std::size_t slot) = 0;
  /// Called after a write request has been stored and all its effects have run.
  virtual void registers_written() {}

  // --- values without a register ---------------------------------------------------------------
  // What a device without registers has by name (T2PE, R3), for scenarios, traces and the control socket:
  // past the line, so they cost no time and leave no trace in its dialogue.
  /// Nothing if it has none of that name.
  virtual std::optional<double> value_named(std::string_view /*name*/) const { return std::nullopt; }
  /// Gives it a value as a command over the line would. Nothing, or why not: "is out of range; expected 0 to
  /// 8", and then nothing has changed.
  virtual std::optional<std::string> assign(std::string_view name, double value);
  /// Those that people meet most, for messages that suggest one.
  virtual std::vector<std::string> names() const { return {}; }
  /// Why value_named() has nothing, as one line.
  std::string why_no_value(std::string_view name) const;

  // --- the wire ------------------------------------------------------------------------------
  /// Of a device that is spoken to in lines of text (emulator/text/); null: it is not.
  virtual TextSpeaker* speaker() { return nullptr; }
  virtual const TextSpeaker* speaker() const { return nullptr; }
  virtual Addressing addressing(std::uint8_t address) const = 0;
  /// Whether a request that it refuses gets an exception, or no answer.
  virtual bool answers_refusals() const { return true; }
  virtual pty::LineSettings line_settings() const = 0;

  // --- power and memory -------------------------------------------------------------------------
  /// A device is made without power. Switching it on begins with what its memory has kept.
  bool powered() const { return powered_; }
  void switch_power(bool on);
  /// Whether a register outlives the power.
  virtual bool keeps(const RegisterRow& row) const { return row.persistent; }
  /// What would be there if the power went now, one value for each slot; those of registers that are not
  /// kept mean nothing.
  virtual std::span<const std::uint32_t> kept_image() const = 0;
  /// Changes whenever kept_image() may have changed.
  virtual std::uint64_t kept_revision() const = 0;
  /// All that waits to be kept is kept at once, as if its time were over.
  virtual void settle_memory() = 0;
  /// The memory as a file has it, and back (without power only). Throws NvError for what it cannot hold.
  NvImage nv_image() const;
  void load_nv(const NvImage& image);

  /// Throws ProgramError. What it brings is written as over the wire.
  virtual void load_program(std::string_view text);
  /// The program as text that load_program() takes; empty if the model has none.
  virtual std::string program_text() const { return {}; }

  // --- of what its model lists, what this one has: a chain may be shorter -------------------------------
  virtual bool has_axis(int) const { return true; }
  virtual bool has_terminal(int) const { return true; }

  // --- time: the phases of a tick, in this order; devices meet between ticks only ---------------------
  virtual void sample_inputs(Tick tick) = 0;
  virtual void run_interpreters(Tick tick) = 0;
  virtual void step_motion(Tick tick) = 0;
  virtual void update_outputs(Tick tick) = 0;
  /// The first tick after `done` at which anything may change without help from outside; kNever if
  /// none. The ticks before it may be left out: the state is then the same as if they had been run.
  virtual Tick next_active_tick(Tick done) const = 0;
  /// Asks the processor for the memory that `tick` will need (base/prefetch.h).
  virtual void prefetch(Tick tick) const;
  /// Whether it equals another device of the same model, bit for bit.
  virtual bool same_state(const Device& other) const = 0;

  // --- its state as bytes (emulator/state/) ---------------------------------------------------------
  /// All that it is at this moment; what it was made from (model, firmware, settings, choices) is not in it.
  std::vector<std::byte> save_state() const;
  /// Makes it what save_state() of a device made alike has given, once the result is called. Throws
  /// StateError for other bytes.
  std::function<void()> read_state(std::span<const std::byte> bytes);
  /// The same at once; when it throws, nothing has changed.
  void restore_state(std::span<const std::byte> bytes) { read_state(bytes)(); }
  std::uint64_t state_hash() const;

  // --- terminals, by their number in the model's table -----------------------------------------------
  /// Levels from outside, in the terminal's unit; the device looks at them in sample_inputs().
  void set_input(int terminal, std::int32_t level) {
    inputs_[static_cast<std::size_t>(terminal)] = level;
    inputs_changed_ = true;
  }
  std::int32_t input(int terminal) const { return inputs_[static_cast<std::size_t>(terminal)]; }
  virtual bool output(int terminal) const = 0;

  // --- axes, by their number in the model's table ----------------------------------------------------
  /// Pulses that left the device in this tick, in the motor's sense (after every reversal).
  virtual std::int64_t pulses_this_tick(int axis) const = 0;
  /// The speed behind them, as planned: real, where the pulses of a tick are whole.
  virtual double speed_pps(int axis) const = 0;
  /// The form in which they leave, as the manual calls it; empty if there is but one.
  virtual std::string_view pulse_format() const { return {}; }
  /// All forms that it knows, and which of them it is.
  virtual std::span<const std::string_view> pulse_formats() const { return {}; }
  virtual std::size_t pulse_format_number() const { return 0; }
  /// What an axis puts out in PWM mode, 0 in all others; nothing if it has no such mode.
  virtual std::optional<int> duty_percent(int /*axis*/) const { return std::nullopt; }
  /// The count of the encoder on the axis, absolute, as the plant sees it.
  virtual void set_encoder(int axis, std::int64_t counts) = 0;

  /// The last tick that is over. Set by the world; what a write starts moves from the next one.
  Tick now() const { return now_; }
  void set_now(Tick tick) { now_ = tick; }

  // --- log -----------------------------------------------------------------------------------
  /// Tells the user, once for each row, that something is not modelled.
  void mention_unmodelled(const RegisterRow& row) const;
  /// The same for what is not a register: a command, a parameter.
  void mention_unmodelled(std::string_view what, std::string_view why) const;
  void set_log(std::function<void(const std::string&)> log) { log_ = std::move(log); }

 protected:
  /// Whether set_input(), the power or a restored state may have changed them since take_inputs_changed().
  bool inputs_changed() const { return inputs_changed_; }
  bool take_inputs_changed() { return std::exchange(inputs_changed_, false); }
  /// The state as it is when the power comes: from kept_image() and the inputs.
  virtual void power_up() = 0;
  /// Nothing is driven any more, and all that is not kept is lost.
  virtual void power_down() = 0;
  /// The state of the model's own.
  virtual void write_own_state(StateWriter& writer) const = 0;
  /// Reads it, and gives what puts it in force, which throws nothing.
  virtual std::function<void()> read_own_state(StateReader& reader) = 0;
  /// A kept value from outside, without power.
  virtual void put_kept(std::size_t slot, std::uint32_t bits) = 0;
  /// All that is kept, into an image that has the model and the firmware already; the registers without more.
  virtual void write_memory(NvImage& image) const;
  /// The same back, without power: what the image does not name has the factory's value. Throws NvError for
  /// what it cannot hold; nothing has changed then.
  virtual void read_memory(const NvImage& image);

 private:
  struct CommonFields;  // device_state.cpp

  // What every tick needs, first: the rest lies behind the first cache line.
  const Model& model_;
  Tick now_ = 0;
  bool powered_ = false;
  bool inputs_changed_ = true;  // no state: only whether a device may spare itself a look at them
  std::vector<std::uint8_t> choices_;
  std::vector<std::int32_t> inputs_;
  DeviceSettings settings_;
  std::function<void(const std::string&)> log_;
  mutable std::vector<bool> mentioned_;            // rows; of the log, not of the model
  mutable std::set<std::string> mentioned_names_;  // likewise
};

/// "0 to 3000", or what the width allows where the manual gives no range.
std::string range_text(const RegisterRow& row);

}  // namespace understudy::emulator
