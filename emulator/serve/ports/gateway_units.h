// Maps Modbus TCP units to stations on a line.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/world/bench/listening.h"
#include "emulator/world/view/world_view.h"

namespace understudy::emulator::serve {

/// Returns the station number for `unit`: the same number if a station with this number exists, or the
/// station to which unit 255 (or any unit) is mapped; otherwise `unit`.
std::uint8_t station_of_unit(std::uint8_t unit, const world::GatewaySettings& settings,
                             const world::WorldLine& line);

/// Returns a line for the log, with the existing stations, if a master reads by broadcast, which no station
/// answers. Otherwise returns an empty text. MissingStations reports missing stations for all kinds of hosts.
std::string why_unanswered(std::uint8_t station, std::uint8_t function, const world::WorldLine& line);

}  // namespace understudy::emulator::serve
