#include "emulator/serve/ports/gateway_units.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/world/bench/listening.h"
#include "emulator/world/stations/server.h"
#include "emulator/world/view/world_view.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::uint8_t kThisDevice = 0xFF;  // MODBUS Messaging on TCP/IP 1.0b, 4.4.2.3
constexpr std::uint8_t kBroadcast = 0;
constexpr int kLastStation = 247;
constexpr std::size_t kMaxNamed = 8;

bool does(const world::LineStation& station, std::uint8_t number, Addressing what) {
  const ModbusStation* const modbus = station.device().modbus();
  return modbus != nullptr && modbus->addressing(number) == what;
}

bool is_answered(const world::WorldLine& line, std::uint8_t number) {
  return std::ranges::any_of(line.stations, [&](const auto& station) {
    return does(*station, number, Addressing::execute_and_reply);
  });
}

std::optional<std::uint8_t> number_of(const world::LineStation& station) {
  for (int number = 0; number <= kLastStation; ++number) {
    const auto unit = static_cast<std::uint8_t>(number);
    if (does(station, unit, Addressing::execute_and_reply)) return unit;
  }
  return std::nullopt;
}

bool reads(std::uint8_t function) {
  return std::ranges::any_of(world::kModbusFunctions, [&](const world::FunctionRow& row) {
    return row.code == function && row.kind == world::FunctionRow::Kind::read;
  });
}

/// Returns the stations on the line as text, such as "1 (feeder), 2 (turner)".
std::string who_is_there(const world::WorldLine& line) {
  std::string text;
  std::size_t named = 0;
  for (const auto& station : line.stations) {
    const auto number = number_of(*station);
    if (!number) continue;
    if (++named > kMaxNamed) return text + ", ...";
    text += (text.empty() ? "" : ", ") + std::to_string(*number) + " (" + station->device().name() + ")";
  }
  return text.empty() ? "nobody" : text;
}

}  // namespace

std::uint8_t station_of_unit(std::uint8_t unit, const world::GatewaySettings& settings,
                             const world::WorldLine& line) {
  using Settings = world::GatewaySettings;
  if (is_answered(line, unit)) return unit;
  if (unit != kThisDevice && settings.unit != Settings::kAnyUnit) return unit;
  if (settings.unit > 0) return static_cast<std::uint8_t>(settings.unit);
  if (line.stations.size() != 1) return unit;
  return number_of(*line.stations.front()).value_or(unit);
}

std::string why_unanswered(std::uint8_t station, std::uint8_t function, const world::WorldLine& line) {
  if (station != kBroadcast || is_answered(line, station) || !reads(function)) return {};
  return "which is a broadcast, and devices do not answer broadcasts; the line has " + who_is_there(line);
}

}  // namespace understudy::emulator::serve
