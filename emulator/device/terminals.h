// What a device does with its terminals, by their number in the model's table. A facet: Device::terminals()
// is null where a device has none. Levels from outside are with every device (Device::set_input()): they
// outlive its power.
#pragma once

namespace understudy::emulator {

class Terminals {
 public:
  /// How many of those that the model lists this device has: a chain may be shorter.
  virtual bool has_terminal(int /*terminal*/) const { return true; }
  /// Whether an output conducts.
  virtual bool output(int terminal) const = 0;

 protected:
  ~Terminals() = default;
};

}  // namespace understudy::emulator
