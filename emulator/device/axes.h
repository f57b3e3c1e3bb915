// The motor axes of a device, by their number in the model's table. This is a facet: Device::axes() is null
// if a device has no axes.
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
  /// Returns true if this device has the axis. A chain may have fewer axes than its model lists.
  virtual bool has_axis(int /*axis*/) const { return true; }
  /// Returns the pulses that the device sent in this tick, in the motor's direction, including all reversals.
  virtual std::int64_t pulses_this_tick(int axis) const = 0;
  /// Returns the planned speed in pulses per second. It may be a fraction, although the pulses of a tick are
  /// whole.
  virtual double speed_pps(int axis) const = 0;
  /// Returns how many pulses remain until the end of the current move or path, in the motor's direction.
  /// Returns 0 at rest, and if the end is unknown (a move at constant speed, a search for home, following).
  virtual std::int64_t pulses_to_come(int /*axis*/) const { return 0; }
  /// Returns true if the device has switched on the axis's servo, even if no output shows it. Returns nothing
  /// if the device has no such state.
  virtual std::optional<bool> servo_on(int /*axis*/) const { return std::nullopt; }
  /// Returns the name of the current pulse format in the manual, or an empty text if there is only one
  /// format.
  virtual std::string_view pulse_format() const { return {}; }
  /// Returns all pulse formats of the device.
  virtual std::span<const std::string_view> pulse_formats() const { return {}; }
  virtual std::size_t pulse_format_number() const { return 0; }
  /// Returns the duty cycle in percent of an axis in PWM mode, 0 in all other modes, or nothing if the axis
  /// has no such mode.
  virtual std::optional<int> duty_percent(int /*axis*/) const { return std::nullopt; }
  /// Connects an encoder that is at `counts` to the axis. Called when the world is created, before anything
  /// moves.
  virtual void connect_encoder(int /*axis*/, std::int64_t /*counts*/) {}
  /// The plant calls this to set the absolute count of the axis's encoder.
  virtual void set_encoder(int axis, std::int64_t counts) = 0;

  // --- edges between ticks, for devices that detect them; other devices see levels once per tick ---------
  /// Returns true if the device detects the switches of its machines at the exact pulse. The answer never
  /// changes.
  virtual bool meets_edges() const { return false; }
  /// Returns the position that the device has counted, in the motor's direction. When this position or the
  /// machine jumps, the edges are set again.
  virtual std::int64_t place_pulses(int /*axis*/) const { return 0; }
  /// Sets the switch edges along the axis. Called again at power-on and after a restore; unchanged edges must
  /// have no effect. The edges are not part of the state.
  virtual void set_edges(int /*axis*/, const MachineEdges& /*edges*/) {}

 protected:
  ~Axes() = default;
};

}  // namespace understudy::emulator
