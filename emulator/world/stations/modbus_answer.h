// Carries out a frame for a Modbus station, whatever its framing is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "emulator/world/stations/line_station.h"
#include "pty/rtu_framer.h"

namespace understudy::emulator::world {

using ReplyFrame = std::array<std::uint8_t, pty::kRtuMaxFrame>;

/// Executes an RTU frame, counts it, and puts the reply, also an RTU frame, into `reply`. Returns its size;
/// 0: no reply. `request` is the frame as the wire had it.
std::size_t answer_frame(Device& device, FaultyWire& wire, StationCounters& counters,
                         const ReceivedFrame& request, std::span<const std::uint8_t> frame, ReplyFrame& reply,
                         pty::Transmitter& out);

}  // namespace understudy::emulator::world
