// What a device must know about the machines on its axes to skip many ticks in one step
// (Device::fast_forward_to()): how far each axis can move before anything but positions changes, and what its
// encoder will count.
#pragma once

#include <cstdint>

namespace understudy::emulator {

/// A range of further pulses, in the motor's direction; both ends are included.
struct PulseRoom {
  std::int64_t min = 0;
  std::int64_t max = 0;
};

class ClearTravel {
 public:
  /// Returns how far an axis can move before anything but its position and its encoder count changes.
  virtual PulseRoom room(int axis) const = 0;
  virtual bool has_encoder(int axis) const = 0;
  /// Returns the encoder count after this many more pulses, which must be within the room.
  virtual std::int64_t encoder_counts(int axis, std::int64_t pulses) const = 0;

 protected:
  ~ClearTravel() = default;
};

}  // namespace understudy::emulator
