// Whom the units of Modbus TCP stand for on a line.
#pragma once

#include <cstdint>
#include <string>

#include "emulator/world/bench/listening.h"
#include "emulator/world/view/world_view.h"

namespace understudy::emulator::serve {

/// The number on the line of the station that is meant by `unit`: its own where a station answers to it, or
/// the one that 255 (or any unit) stands for; otherwise `unit`.
std::uint8_t station_of_unit(std::uint8_t unit, const world::GatewaySettings& settings,
                             const world::WorldLine& line);

/// What is worth a line in the log where a master asks for that station by that function: that nobody is
/// there who would answer, and who is there. Empty: somebody answers, or nobody should.
std::string why_unanswered(std::uint8_t station, std::uint8_t function, const world::WorldLine& line);

}  // namespace understudy::emulator::serve
