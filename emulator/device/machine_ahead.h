// What a device may know of the machines on its axes when it makes up many ticks in one step
// (Device::cross_to()): how far they are the same but for their place, and what their encoders will show.
#pragma once

#include <cstdint>

namespace understudy::emulator {

/// Pulses from now on, in the motor's sense; both included.
struct PulseRoom {
  std::int64_t least = 0;
  std::int64_t most = 0;
};

class MachineAhead {
 public:
  /// How far an axis may go before anything but its place and its encoder's count changes.
  virtual PulseRoom room(int axis) const = 0;
  virtual bool has_encoder(int axis) const = 0;
  /// The count after this many more pulses, within the room.
  virtual std::int64_t encoder_counts(int axis, std::int64_t pulses) const = 0;

 protected:
  ~MachineAhead() = default;
};

}  // namespace understudy::emulator
