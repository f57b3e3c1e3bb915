#include "emulator/world/bench/bench.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/simulated_time.h"
#include "base/text/parse_real.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "emulator/world/names/names.h"
#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {

KnownDevices known_devices_of(const Bench& bench) {
  KnownDevices known;
  for (const DeviceSetup& device : bench.devices) {
    const Firmware firmware = device.settings.firmware;
    known.push_back(
        {device.settings.name, device.model, firmware != 0 ? firmware : device.model->firmwares.back()});
  }
  for (KnownDevice& device : known) device.lines.resize(device.model->line.ports.size());
  for (const LineSetup& line : bench.lines) {
    for (const StationSetup& station : line.stations) known[station.device].lines[station.port] = line.name;
  }
  return known;
}

WireEnds ends_of(const WireSetup& wire, const KnownDevices& known) {
  const auto name = [&](std::size_t device, int axis, int terminal, std::string_view word) {
    const Model& model = *known[device].model;
    const std::string prefix = known[device].name + ".";
    if (axis < 0) return prefix + std::string(model.terminals[static_cast<std::size_t>(terminal)].name);
    return prefix + std::string(model.axes[static_cast<std::size_t>(axis)].name) + "." + std::string(word);
  };
  return {.from = name(wire.from_device, wire.from_axis, wire.from_terminal,
                       kContactNames[static_cast<std::size_t>(wire.from_contact)]),
          .to = name(wire.to_device, wire.to_axis, wire.to_terminal,
                     kDriveInputNames[static_cast<std::size_t>(wire.to_input)])};
}

Bench bench_of_one(const Model& model, DeviceSettings settings, const std::string& link) {
  Bench bench;
  const auto ports = model.line.ports;
  settings.bauds.resize(ports.size());
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const std::string name(ports.size() == 1 ? "line" : ports[i].name);
    const std::string suffix = i == 0 || link.empty() ? "" : "." + std::string(ports[i].name);
    bench.lines.push_back(
        {.name = name, .link = link + suffix, .baud = settings.bauds[i], .stations = {StationSetup(0, i)}});
  }
  bench.devices.push_back({.model = &model, .settings = std::move(settings)});
  return bench;
}

std::optional<SimTime> parse_byte_timeout(std::string_view text) {
  const auto time = parse_duration(text);
  return time && *time >= kShortestByteTimeout && *time <= kLongestByteTimeout ? time : std::nullopt;
}

std::optional<std::int64_t> parse_baud_tolerance(std::string_view text) {
  constexpr double kMaxPercent = 10;
  constexpr double kPpmOfPercent = 10'000;
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  const auto percent = parse_real(text);
  if (!percent || !(*percent >= 0 && *percent <= kMaxPercent)) return std::nullopt;
  return std::llround(*percent * kPpmOfPercent);
}

int input_of(const AxisRow& axis, const PlantAxis& machine, Contact contact) {
  if (!machine.has_contact(contact)) return -1;
  const PlantSetup& setup = machine.setup();
  const auto chosen = [](int own, int models) { return own >= 0 ? own : models; };
  switch (contact) {
    case Contact::home: return chosen(setup.home_input, axis.home_input);
    case Contact::lower_limit: return chosen(setup.lower_limit_input, axis.lower_limit_input);
    case Contact::upper_limit: return chosen(setup.upper_limit_input, axis.upper_limit_input);
    case Contact::alarm: return axis.alarm_input;
    case Contact::ready: return axis.ready_input;
    case Contact::near_home: return chosen(setup.near_home->input, axis.near_home_input);
    case Contact::mark: return chosen(setup.mark->input, axis.mark_input);
    case Contact::index: return chosen(setup.index->input, axis.index_input);
  }
  return -1;
}

}  // namespace understudy::emulator::world
