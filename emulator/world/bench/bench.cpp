#include "emulator/world/bench/bench.h"

#include <cmath>

#include "base/text/parse_real.h"

namespace understudy::emulator::world {

KnownDevices known_devices_of(const Bench& bench) {
  KnownDevices known;
  for (const DeviceSetup& device : bench.devices) {
    const Firmware firmware = device.settings.firmware;
    known.push_back(
        {device.settings.name, device.model, firmware != 0 ? firmware : device.model->firmwares.back()});
  }
  for (const LineSetup& line : bench.lines) {
    for (const std::size_t device : line.stations) known[device].line = line.name;
  }
  return known;
}

std::optional<std::int64_t> parse_baud_tolerance(std::string_view text) {
  constexpr double kMostPercent = 10;
  constexpr double kPpmOfPercent = 10'000;
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  const auto percent = parse_real(text);
  if (!percent || !(*percent >= 0 && *percent <= kMostPercent)) return std::nullopt;
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
