#include "emulator/serve/daemon/missing_stations.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/world/stations/line_station.h"
#include "emulator/world/world.h"
#include "pty/capture.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kMaxListed = 4;

/// Who is there, for people; empty if somebody hears what is sent to that address, or may do so.
std::string others_than(const world::WorldLine& line, std::uint8_t address) {
  std::string numbers;
  std::size_t count = 0;
  for (const auto& station : line.stations) {
    const Device& device = station->device();
    const auto number = device.station_number();
    const bool may_hear = device.modbus() == nullptr || !number || *number == address ||
                          device.modbus()->addressing(address) != Addressing::ignore;
    if (may_hear) return "";
    if (++count > kMaxListed) continue;
    numbers += (numbers.empty() ? "" : ", ") + device.name() + " is " + std::to_string(*number);
  }
  if (count > kMaxListed) numbers += ", and " + std::to_string(count - kMaxListed) + " more";
  return numbers;
}

}  // namespace

void MissingStations::look(const pty::CapturedPacket& packet) {
  const bool is_request =
      packet.way == pty::Way::from_host && packet.remark == pty::Remark::none && !packet.bytes.empty();
  if (!is_request) return;
  const world::WorldLine& line = world_.line(packet.line);
  const std::uint8_t address = packet.bytes.front();
  const std::string others = others_than(line, address);
  if (others.empty() || !is_new(packet.line, address)) return;
  log_("line " + line.line.name() + ": a host asks for station " + std::to_string(address) +
       ", which does not exist; " + others);
}

bool MissingStations::is_new(std::size_t line, std::uint8_t address) {
  if (told_.size() <= line) told_.resize(line + 1);
  std::vector<std::uint8_t>& told = told_[line];
  if (told.size() == kMaxTold || std::find(told.begin(), told.end(), address) != told.end()) return false;
  told.push_back(address);
  return true;
}

}  // namespace understudy::emulator::serve
