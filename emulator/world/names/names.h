// Names of things on a bench: "feeder.Cord_A", "feeder.STATUS.4", "feeder.DIN_10", "feeder.A"; the device may
// be left out where there is only one.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator::world {

/// One line: which name is unknown, and the nearest known one.
struct NameError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What names can be about; a device's number is its place here.
struct KnownDevice {
  std::string name;
  const Model* model = nullptr;
  Firmware firmware = 0;
  std::vector<std::string> lines{};  // that it stands on, by its ports; empty: a port is on none
};
using KnownDevices = std::vector<KnownDevice>;

/// The models that they are of, each once.
std::vector<ListedModel> models_of(const KnownDevices& devices);

/// All of these throw NameError.
struct RegisterName {
  std::size_t device = 0;
  NamedPlace place;
};
RegisterName find_register(const KnownDevices& devices, std::string_view name);

/// A value of a device without registers (NamedValues), "robot.T2PE"; nothing where the device has registers.
/// Only the device knows whether it has such a value.
struct ValueName {
  std::size_t device = 0;
  std::string name;
};
std::optional<ValueName> find_value(const KnownDevices& devices, std::string_view name);

struct InputName {
  std::size_t device = 0;
  int terminal = 0;
  const TerminalRow& row(const KnownDevices& devices) const {
    return devices[device].model->terminals[static_cast<std::size_t>(terminal)];
  }
};
/// Inputs of every kind, switches included.
InputName find_input(const KnownDevices& devices, std::string_view name);
/// Throws NameError for a level that the input cannot have.
void demand_level(const TerminalRow& row, std::string_view name, std::int64_t level);

struct AxisName {
  std::size_t device = 0;
  int axis = 0;
};
/// `or_counted`: a counted input would have done as well, which is said where there is neither.
AxisName find_axis(const KnownDevices& devices, std::string_view name, bool or_counted = false);

/// Whether something of that name is at a device.
using HasName = std::function<bool(const KnownDevice& device, std::string_view name)>;
/// What is wrong with a name that does not begin with a device, if there are several: it is a device's name
/// (then `example` is what may follow it), or something that some of them have, or unknown.
NameError name_without_device(const KnownDevices& devices, std::string_view name, const HasName& has,
                              std::string_view example);

/// A device by its name; an empty name will do if there is only one.
std::size_t find_device(const KnownDevices& devices, std::string_view name);

}  // namespace understudy::emulator::world
