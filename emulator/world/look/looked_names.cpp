#include "emulator/world/look/looked_names.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/world/names/names.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

namespace {

constexpr std::string_view kDriver = "@by";

struct TerminalPlace {
  std::size_t device = 0;
  int terminal = 0;
};

/// "feeder.DIN_3", or "DIN_3" where there is one device.
std::optional<TerminalPlace> find_place(const KnownDevices& devices, std::string_view name) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    std::string_view rest = name;
    if (rest.starts_with(devices[i].name) && rest.substr(devices[i].name.size()).starts_with('.')) {
      rest.remove_prefix(devices[i].name.size() + 1);
    } else if (devices.size() > 1) {
      continue;
    }
    if (const int terminal = find_terminal(*devices[i].model, rest); terminal >= 0)
      return TerminalPlace{i, terminal};
  }
  return std::nullopt;
}

}  // namespace

std::string to_text(const TerminalDrivers& drivers) {
  std::string text;
  const auto add = [&](bool is_one, const char* word) {
    if (is_one) text += (text.empty() ? "" : "+") + std::string(word);
  };
  add(drivers.device, "device");
  add(drivers.fault, "fault");
  add(drivers.held, "held");
  add(drivers.machine, "machine");
  add(drivers.wire, "wire");
  return text;
}

TerminalDrivers drivers_of(const World& world, std::size_t device, int terminal) {
  const TerminalRow& row = world.device(device).model().terminals[static_cast<std::size_t>(terminal)];
  if (!is_input(row.kind)) return {.device = world.device(device).powered()};
  const World::Input& input = world.input(device, terminal);
  return {.fault = input.stuck.has_value(),
          .held = row.kind == TerminalRow::Kind::digital_in && input.external != 0,
          .machine = input.plant,
          .wire = input.wired};
}

std::optional<LookedNames::Known> LookedNames::find(const std::string& name) {
  if (name.ends_with(kDriver)) {
    const auto place =
        find_place(world_.known(), std::string_view(name).substr(0, name.size() - kDriver.size()));
    if (!place) return std::nullopt;
    return Known{.is_driver = true, .device = place->device, .terminal = place->terminal};
  }
  try {
    return Known{.handle = probes_->resolve(name).handle};
  } catch (const NameError&) {
    return std::nullopt;
  }
}

LookedNames::Looked LookedNames::look(const std::string& name) {
  if (!probes_ || known_.size() >= kMost) {
    known_.clear();
    probes_.emplace(world_);
  }
  auto found = known_.find(name);
  if (found == known_.end()) {
    // One that is unknown may be known later: a device that speaks text has its names only while it has
    // power.
    const auto known = find(name);
    if (!known) return {};
    found = known_.emplace(name, *known).first;
  }
  const Known& known = found->second;
  if (known.is_driver) return to_text(drivers_of(world_, known.device, known.terminal));
  const auto device = probes_->device_read(known.handle);
  if (device && !world_.device(*device).powered()) return {};
  try {
    return probes_->value(known.handle);
  } catch (const NameError&) {
    return {};
  }
}

}  // namespace understudy::emulator::world
