// Executes a frame for a Modbus station, independent of the framing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/world/stations/line_station.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

using ReplyFrame = std::array<std::uint8_t, pty::kRtuMaxFrame>;

/// Executes an RTU frame, counts it, and stores the reply, which is also an RTU frame, in `reply`. Returns
/// the size of the reply; 0: no reply. `request` is the frame as it was on the line.
std::size_t answer_frame(Device& device, FaultyWire& wire, StationCounters& counters,
                         const ReceivedFrame& request, std::span<const std::uint8_t> frame, ReplyFrame& reply,
                         pty::Transmitter& out);

}  // namespace understudy::emulator::world
