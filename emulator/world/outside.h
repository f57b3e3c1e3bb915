// Reports to recorders everything that reaches a world from outside, except the hosts' traffic on its lines
// (pty/line_observer.h). The run can be reproduced by repeating both in a world from the same bench, at the
// same simulated times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "emulator/device/register_map/access.h"
#include "emulator/world/faults/fault.h"

namespace understudy::emulator::world {

class OutsideListener {
 public:
  virtual ~OutsideListener() = default;
  virtual void on_input(std::size_t device, int terminal, std::int32_t level) = 0;
  virtual void on_power(std::size_t device, bool on) = 0;
  virtual void on_inject(const Fault& fault) = 0;
  virtual void on_clear_fault(std::size_t number) = 0;
  /// Called when a register was written without using the line.
  virtual void on_write(std::size_t device, const PreparedWrite& write) = 0;
  /// Called when a value of a device without registers was set by name.
  virtual void on_assign(std::size_t device, std::string_view name, double value) = 0;
  /// Called when a program was loaded into the device, or the device refused it.
  virtual void on_program(std::size_t device, std::string_view text, bool is_refused) = 0;
  /// Called when a command was executed by its name, without using the line.
  virtual void on_command(std::size_t device, std::string_view text) = 0;
  /// Called when a fault of the machine or of a device begins or ends. This follows from other events, so
  /// recordings do not need it.
  virtual void on_fault(std::size_t /*number*/, bool /*in_force*/) {}
};

}  // namespace understudy::emulator::world
