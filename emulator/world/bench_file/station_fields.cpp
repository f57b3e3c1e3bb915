#include "emulator/world/bench_file/station_fields.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/view/bench_inventory.h"

namespace understudy::emulator::world {

std::size_t read_port(const YamlFields& station, const Model& model) {
  const auto field = station.find("port");
  if (!field) return 0;
  if (const auto port = find_port(model, field->text())) return *port;
  std::vector<std::string> names;
  for (const PortRow& row : model.line.ports) names.emplace_back(row.name);
  field->fail(quoted(field->text()) + " is not a port of " + std::string(model.name) +
              suggestion(field->text(), names));
}

void require_room(const YamlFields& station, const StationSetup& wanted, const LineSetup& line,
                  const Bench& bench) {
  const auto rules_of = [&](const StationSetup& some) -> const LineRules& {
    return bench.devices[some.device].model->line;
  };
  const auto is_alone = [&](const StationSetup& some) {
    return !rules_of(some).station_numbers || rules_of(some).ports[some.port].kind == PortRow::Kind::rs232;
  };
  if (line.stations.empty()) return;
  if (!is_alone(wanted) && !is_alone(line.stations.front())) {
    const Protocol& first = rules_of(line.stations.front()).protocol;
    const Protocol& other = rules_of(wanted).protocol;
    if (&first == &other) return;
    station.fail(quoted(bench.devices[wanted.device].settings.name) + " speaks " + std::string(other.name) +
                 ", but the line speaks " + std::string(first.name) + "; expected one protocol on a line");
  }
  const StationSetup& lone = is_alone(wanted) ? wanted : line.stations.front();
  const LineRules& rules = rules_of(lone);
  const std::string why =
      rules.station_numbers
          ? " is on this line with " + std::string(rules.ports[lone.port].name) + ", an RS232 port,"
          : " speaks " + std::string(rules.protocol.name);
  station.fail(quoted(bench.devices[lone.device].settings.name) + why +
               " and must be alone on its line; expected no other station on it");
}

std::optional<int> read_address(const YamlFields& station, DeviceSetup& device) {
  const auto field = station.find("address");
  if (!field) return std::nullopt;
  const auto& numbers = device.model->line.station_numbers;
  if (!numbers)
    field->fail(std::string(device.model->name) + " has no station number; expected no `address`");
  const auto address = static_cast<int>(field->integer(numbers->lowest, numbers->highest));
  std::optional<int>& known = device.settings.address;
  if (known && *known != address) {
    field->fail("the device has one station number, and on another line it is " + std::to_string(*known) +
                "; expected the same number");
  }
  known = address;
  return address;
}

namespace {

/// Returns true if the bench sets the register in which the device stores its number.
bool sets_number(const DeviceSetup& device) {
  const Model& model = *device.model;
  const Firmware firmware = device.settings.firmware != 0 ? device.settings.firmware : model.firmwares.back();
  const auto kept_in = find_register(model, model.line.station_numbers->kept_in, firmware);
  const auto is_it = [&](const auto& pair) {
    const auto named = find_register(model, pair.first, firmware);
    return named && kept_in && named->place.is_same_register(kept_in->place);
  };
  return std::any_of(device.settings.set.begin(), device.settings.set.end(), is_it);
}

/// Returns nothing if only a memory file contains the number.
std::optional<int> number_of(const NumberedStation& station, const Bench& bench,
                             const BenchInventory& inventory) {
  if (!station.device) return station.address;
  const DeviceSetup& device = bench.devices[*station.device];
  const auto& numbers = device.model->line.station_numbers;
  if (!numbers || numbers->kept_in.empty())
    return station.address ? station.address : device.settings.address;
  const bool is_set = sets_number(device);
  if (!is_set && (device.settings.address || !device.nv_path.empty())) return device.settings.address;
  return inventory.device(*station.device).station_number();
}

}  // namespace

void check_addresses(const std::vector<std::vector<NumberedStation>>& lines, const Bench& bench,
                     Diagnostics& diagnostics) {
  const BenchInventory inventory(bench);
  for (const std::vector<NumberedStation>& line : lines) {
    std::set<int> taken;
    for (const NumberedStation& station : line) {
      const auto number = number_of(station, bench, inventory);
      if (!number || taken.insert(*number).second) continue;
      diagnostics.attempt([&] {
        station.fields.fail("address " + std::to_string(*number) +
                            " is taken on this line; expected another address");
      });
    }
  }
}

}  // namespace understudy::emulator::world
