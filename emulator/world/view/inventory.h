// What a world has, by name and number, without looking at how it is doing: enough to understand names and to
// say whether a fault is possible. A running world has one, and so has a bench from which no world has been
// made.
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
  /// The devices by name; whatever else is asked about a device is asked by its place here.
  virtual const KnownDevices& known() const = 0;
  /// For what only a device can tell: which values it has by name. Not for the values themselves.
  virtual const Device& device(std::size_t number) const = 0;
  /// What the machine on an axis is like.
  virtual const PlantSetup& machine(std::size_t device, int axis) const = 0;

 protected:
  ~Inventory() = default;
};

}  // namespace understudy::emulator::world
