#include "emulator/world/names/names.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"

namespace understudy::emulator::world {

std::vector<ListedModel> models_of(const KnownDevices& devices) {
  std::vector<ListedModel> models;
  for (const KnownDevice& device : devices) {
    if (std::find(models.begin(), models.end(), device.model) == models.end())
      models.emplace_back(device.model);
  }
  return models;
}

namespace {

struct Split {
  std::size_t device = 0;
  std::string_view rest;
};

int number_of(const KnownDevices& devices, std::string_view name) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

NameError no_device(const KnownDevices& devices, std::string_view name) {
  std::vector<std::string> names;
  for (const KnownDevice& device : devices) names.push_back(device.name);
  const std::string what = name.empty() ? "the device is missing" : "no device is called " + quoted(name);
  return NameError(what + suggestion(name, names));
}

NameError only_a_device(std::string_view name, std::string_view example) {
  return NameError(quoted(name) + " is a device; expected " + std::string(name) + "." + std::string(example));
}

/// Throws NameError if there is no such device, or if the device is omitted although there are several. `has`
/// selects the devices for the message.
Split split(const KnownDevices& devices, std::string_view name, const HasName& has,
            std::string_view example) {
  const std::size_t dot = name.find('.');
  if (dot != std::string_view::npos) {
    const int device = number_of(devices, name.substr(0, dot));
    if (device >= 0) return {static_cast<std::size_t>(device), name.substr(dot + 1)};
  }
  if (devices.size() != 1) throw name_without_device(devices, name, has, example);
  if (devices[0].name == name && !has(devices[0], name)) throw only_a_device(name, example);
  return {0, name};
}

bool has_register(const KnownDevice& device, std::string_view name) {
  return find_register(*device.model, name, device.firmware).has_value();
}

constexpr std::string_view kAnyRegister = "REGISTER";

}  // namespace

NameError name_without_device(const KnownDevices& devices, std::string_view name, const HasName& has,
                              std::string_view example) {
  if (number_of(devices, name) >= 0) return only_a_device(name, example);
  std::string whole_names;
  for (const KnownDevice& device : devices) {
    if (!has(device, name)) continue;
    whole_names += (whole_names.empty() ? "" : ", ") + device.name + "." + std::string(name);
  }
  if (whole_names.empty()) return no_device(devices, name.substr(0, name.find('.')));
  const bool is_of_several = whole_names.find(", ") != std::string::npos;
  return NameError(quoted(name) + " must begin with its device; expected " +
                   (is_of_several ? "one of " : "") + whole_names);
}

RegisterName find_register(const KnownDevices& devices, std::string_view name) {
  const auto [number, rest] = split(devices, name, has_register, kAnyRegister);
  const KnownDevice& device = devices[number];
  if (const auto place = find_register(*device.model, rest, device.firmware)) return {number, *place};
  throw NameError(device.name + ": " + why_no_register(*device.model, rest, device.firmware));
}

std::optional<ValueName> find_value(const KnownDevices& devices, std::string_view name) {
  const auto [number, rest] = split(devices, name, has_register, kAnyRegister);
  if (devices[number].model->registers != nullptr) return std::nullopt;
  return ValueName{number, std::string(rest)};
}

InputName find_input(const KnownDevices& devices, std::string_view name) {
  const auto has_input = [](const KnownDevice& device, std::string_view input) {
    const int terminal = find_terminal(*device.model, input);
    return terminal >= 0 && is_input(device.model->terminals[static_cast<std::size_t>(terminal)].kind);
  };
  const auto [number, rest] = split(devices, name, has_input, "INPUT");
  const Model& model = *devices[number].model;
  const int terminal = find_terminal(model, rest);
  if (terminal >= 0 && is_input(model.terminals[static_cast<std::size_t>(terminal)].kind)) {
    return {number, terminal};
  }
  std::vector<std::string> names;
  for (const TerminalRow& row : model.terminals) {
    if (is_input(row.kind)) names.emplace_back(row.name);
  }
  throw NameError("no input of " + devices[number].name + " is called " + quoted(rest) +
                  suggestion(rest, names));
}

void require_level(const TerminalRow& row, std::string_view name, std::int64_t level) {
  if (row.kind == TerminalRow::Kind::counted_in) {
    throw NameError(std::string(name) + " is a counted input; expected `turn` to change it");
  }
  if (level >= row.lowest && level <= row.highest) return;
  throw NameError(std::string(name) + ": " + std::to_string(level) + " is not a level; expected " +
                  (row.highest == 1 ? "0 or 1"
                                    : std::to_string(row.lowest) + " to " + std::to_string(row.highest) +
                                          (is_in_millivolts(row.kind) ? " millivolts" : "")));
}

AxisName find_axis(const KnownDevices& devices, std::string_view name, bool or_counted) {
  const auto has_axis = [](const KnownDevice& device, std::string_view axis) {
    return find_axis(*device.model, axis) >= 0;
  };
  const auto [number, rest] = split(devices, name, has_axis, "AXIS");
  const Model& model = *devices[number].model;
  if (const int axis = find_axis(model, rest); axis >= 0) return {number, axis};
  std::string axes;
  for (const AxisRow& row : model.axes) axes += (axes.empty() ? "" : ", ") + std::string(row.name);
  std::string counted;
  for (const TerminalRow& row : model.terminals) {
    if (or_counted && row.kind == TerminalRow::Kind::counted_in) counted += ", " + std::string(row.name);
  }
  throw NameError("no axis" + std::string(counted.empty() ? "" : " or counted input") + " of " +
                  devices[number].name + " is called " + quoted(rest) + "; expected one of " + axes +
                  counted);
}

std::size_t find_device(const KnownDevices& devices, std::string_view name) {
  if (name.empty() && devices.size() == 1) return 0;
  if (const int found = number_of(devices, name); found >= 0) return static_cast<std::size_t>(found);
  throw no_device(devices, name);
}

}  // namespace understudy::emulator::world
