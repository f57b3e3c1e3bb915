#include "emulator/serve/daemon/missing_stations.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/world/stations/line_station.h"
#include "emulator/world/world.h"
#include "pty/ascii_frame.h"
#include "pty/capture.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMaxListed = 4;

/// Returns true if the station obeys requests to that address, or may obey them because it has no Modbus or
/// no number. Runs for each request, so it checks Modbus first: finding a station number in a register takes
/// longer.
bool may_receive(const Device& device, std::uint8_t address) {
  if (device.modbus() == nullptr || device.modbus()->addressing(address) != Addressing::ignore) return true;
  const auto number = device.station_number();
  return !number || *number == address;
}

bool may_receive(const world::WorldLine& line, std::uint8_t address) {
  return std::any_of(line.stations.begin(), line.stations.end(),
                     [&](const auto& station) { return may_receive(station->device(), address); });
}

/// Lists the stations of the line with their numbers, for the log.
std::string stations_of(const world::WorldLine& line) {
  std::string text;
  const std::size_t count = line.stations.size();
  for (std::size_t i = 0; i < std::min(count, kMaxListed); ++i) {
    const Device& device = line.stations[i]->device();
    text += (i == 0 ? "" : ", ") + std::to_string(device.station_number().value_or(0)) + " (" +
            device.name() + ")";
  }
  return count > kMaxListed ? text + ", and " + std::to_string(count - kMaxListed) + " more" : text;
}

}  // namespace

void MissingStations::check(const pty::CapturedPacket& packet) {
  const bool is_request = packet.direction == pty::Direction::from_host &&
                          packet.remark == pty::Remark::none && !packet.bytes.empty();
  if (!is_request) return;
  const world::WorldLine& line = world_.line(packet.line);
  const auto carried = packet.is_text ? pty::rtu_of_ascii(packet.bytes) : std::nullopt;
  const std::uint8_t address = carried ? carried->front() : packet.bytes.front();
  if (line.stations.empty() || may_receive(line, address) || !is_new(packet.line, address)) return;
  log_("line " + line.line.name() + ": a host sends requests to station " + std::to_string(address) +
       ", which does not exist; the line has " + stations_of(line));
}

bool MissingStations::is_new(std::size_t line, std::uint8_t address) {
  if (reported_.size() <= line) reported_.resize(line + 1);
  std::vector<std::uint8_t>& reported = reported_[line];
  if (reported.size() == kMaxReported ||
      std::find(reported.begin(), reported.end(), address) != reported.end())
    return false;
  reported.push_back(address);
  return true;
}

}  // namespace understudy::emulator::serve
