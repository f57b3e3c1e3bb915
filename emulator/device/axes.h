// The motor axes of a device, by their number in the model's table. This is a facet: Device::axes() is null
// if a device drives no axes.
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
  /// Returns the pulses that left the device in this tick, in the motor's direction, with every reversal
  /// applied.
  virtual std::int64_t pulses_this_tick(int axis) const = 0;
  /// Returns the planned speed in pulses per second. It is a real number; the pulses of a tick are whole.
  virtual double speed_pps(int axis) const = 0;
  /// Returns the pulses until the end of the current move or path, in the motor's direction. Returns 0 at
  /// rest, and if the end is unknown (a move at constant speed, a search for home, following).
  virtual std::int64_t pulses_to_come(int /*axis*/) const { return 0; }
  /// Returns whether the device has switched the axis's servo on, whether or not an output shows it. Returns
  /// nothing if the device has no such state.
  virtual std::optional<bool> servo_on(int /*axis*/) const { return std::nullopt; }
  /// Returns the manual's name for the pulse format in use, or an empty text if there is only one format.
  virtual std::string_view pulse_format() const { return {}; }
  /// Returns all pulse formats of the device.
  virtual std::span<const std::string_view> pulse_formats() const { return {}; }
  virtual std::size_t pulse_format_number() const { return 0; }
  /// Returns the duty in percent of an axis in PWM mode, 0 in all other modes, or nothing if the axis has no
  /// such mode.
  virtual std::optional<int> duty_percent(int /*axis*/) const { return std::nullopt; }
  /// Gives the axis an encoder, which is at `counts`. Called when the world is made, before anything moves.
  virtual void connect_encoder(int /*axis*/, std::int64_t /*counts*/) {}
  /// Sets the absolute count of the axis's encoder, from the plant.
  virtual void set_encoder(int axis, std::int64_t counts) = 0;

  // --- edges between ticks, for devices that ask for them; others see levels once a tick -----------------
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
