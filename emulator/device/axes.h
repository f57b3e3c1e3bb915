// The motor axes of a device, by their number in the model's table. A facet: Device::axes() is null where a
// device drives none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "emulator/device/machine_edges.h"

namespace understudy::emulator {

class Axes {
 public:
  /// How many of those that the model lists this device has: a chain may be shorter.
  virtual bool has_axis(int /*axis*/) const { return true; }
  /// Pulses that left the device in this tick, in the motor's sense (after every reversal).
  virtual std::int64_t pulses_this_tick(int axis) const = 0;
  /// The planned speed behind them: a real number, while the pulses of a tick are whole.
  virtual double speed_pps(int axis) const = 0;
  /// Pulses that are still to come until its move, or the path that it is on, is at its end: in the motor's
  /// sense. 0 at rest, and where no end is known (a velocity, a search for home, following).
  virtual std::int64_t pulses_to_come(int /*axis*/) const { return 0; }
  /// Whether the device has the axis's servo on, whatever its outputs do with that; nothing if it knows none.
  virtual std::optional<bool> servo_on(int /*axis*/) const { return std::nullopt; }
  /// The form in which they leave, as the manual calls it; empty if there is only one.
  virtual std::string_view pulse_format() const { return {}; }
  /// All forms that it knows, and which of them is in use.
  virtual std::span<const std::string_view> pulse_formats() const { return {}; }
  virtual std::size_t pulse_format_number() const { return 0; }
  /// The duty of an axis in PWM mode, 0 in all other modes; nothing if it has no such mode.
  virtual std::optional<int> duty_percent(int /*axis*/) const { return std::nullopt; }
  /// The machine has an encoder on the axis: told when the world is made, before anything moves.
  virtual void connect_encoder(int /*axis*/, std::int64_t /*counts*/) {}
  /// The count of the encoder on the axis, absolute, as the plant sees it.
  virtual void set_encoder(int axis, std::int64_t counts) = 0;

  // --- edges between ticks: of a device that asks for them. Others see levels, once a tick ---------------
  /// Whether it meets the switches of its machines at the pulse where they lie. Always the same.
  virtual bool meets_edges() const { return false; }
  /// Where it has counted its axis to be, in the motor's sense. When it jumps, or the machine does, the edges
  /// are told anew.
  virtual std::int64_t place_pulses(int /*axis*/) const { return 0; }
  /// What lies along the axis from now on. Told again when it is switched on and after a restore: what it
  /// knows already must change nothing. What is kept of it is not state.
  virtual void set_edges(int /*axis*/, const MachineEdges& /*edges*/) {}

 protected:
  ~Axes() = default;
};

}  // namespace understudy::emulator
