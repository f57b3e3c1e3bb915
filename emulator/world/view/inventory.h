// Describes the contents of a world by name and number, but not its current state. This is enough to resolve
// names and to check whether a fault is possible. A running world has an inventory, and so does a bench from
// which no world has been created.
#pragma once

#include <cstddef>
#include <string>

#include "emulator/device/device.h"
#include "emulator/world/names/names.h"
#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {

class Inventory {
 public:
  virtual std::size_t line_count() const = 0;
  virtual const std::string& line_name(std::size_t number) const = 0;
  /// Returns the devices by name. A device's index in this list is its number in other functions.
  virtual const KnownDevices& known() const = 0;
  /// Returns a device, for facts that only the device can determine, such as the names of its values. Do not
  /// read the values.
  virtual const Device& device(std::size_t number) const = 0;
  /// Returns the setup of an axis's machine.
  virtual const PlantSetup& machine(std::size_t device, int axis) const = 0;

 protected:
  ~Inventory() = default;
};

}  // namespace understudy::emulator::world
