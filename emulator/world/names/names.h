// Resolves names on a bench: "feeder.Cord_A", "feeder.STATUS.4", "feeder.DIN_10", "feeder.A". If there is
// only one device, its name may be omitted.
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

/// The message is one line with the unknown name and the nearest known name.
struct NameError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A device to which names can refer. Its number is its index in the list.
struct KnownDevice {
  std::string name;
  const Model* model = nullptr;
  Firmware firmware = 0;
  std::vector<std::string> lines{};  // by port; empty: the port is not connected
};
using KnownDevices = std::vector<KnownDevice>;

/// Returns the models of the devices without duplicates.
std::vector<ListedModel> models_of(const KnownDevices& devices);

/// All functions below throw NameError.
struct RegisterName {
  std::size_t device = 0;
  NamedPlace place;
};
RegisterName find_register(const KnownDevices& devices, std::string_view name);

/// A value of a device without registers (NamedValues), such as "robot.T2PE". Devices with registers have no
/// such values. Only the device can determine whether it has a value.
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
/// Finds inputs of every kind, including switches.
InputName find_input(const KnownDevices& devices, std::string_view name);
/// Throws NameError for a level that the input cannot have.
void require_level(const TerminalRow& row, std::string_view name, std::int64_t level);

struct AxisName {
  std::size_t device = 0;
  int axis = 0;
};
/// With `or_counted`, the caller also accepts a counted input. If there is neither, the message mentions
/// both.
AxisName find_axis(const KnownDevices& devices, std::string_view name, bool or_counted = false);

/// Returns true if a device has anything with that name.
using HasName = std::function<bool(const KnownDevice& device, std::string_view name)>;
/// Returns the error for a name that does not begin with a device although there are several. The name may be
/// a device (then `example` shows what can follow it), something that some devices have, or unknown.
NameError name_without_device(const KnownDevices& devices, std::string_view name, const HasName& has,
                              std::string_view example);

/// Returns a device by its name. An empty name is accepted if there is only one device.
std::size_t find_device(const KnownDevices& devices, std::string_view name);

}  // namespace understudy::emulator::world
