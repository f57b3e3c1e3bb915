// Describes Modbus RTU frames in words, with the names of registers: "write 0x1005 feeder.Aaxis_Move_INC =
// 1".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emulator/world/stations/line_station.h"

namespace understudy::emulator::world {

/// Returns "01 03 00 00", shortened if it is long.
std::string hex_text(std::span<const std::uint8_t> bytes);
/// Returns "3 (illegal data value)".
std::string exception_text(int exception);

/// Returns true if the function of a frame may change something in a device.
bool is_write(std::span<const std::uint8_t> frame);

/// Returns the numbers of the stations that a frame addresses now. The first one is the station whose number
/// it contains, if any. Without power, or before it has started, that station receives nothing, but the frame
/// is still addressed to it.
std::vector<std::size_t> addressed_by(const LineStations& stations, std::span<const std::uint8_t> request);

/// Describes a host's frame. `to` is the device that it addresses, or null if there is none. A frame that
/// cannot be decoded is shown as bytes.
std::string modbus_request_text(const Device* to, std::span<const std::uint8_t> request);
/// Returns "mill: MOVE X 1000" for a frame that writes a command with a name, and an empty text for all other
/// frames.
std::string modbus_command_text(const Device* to, std::span<const std::uint8_t> request);
/// Describes an answer. `request` is empty if it is not known. `to` is the device that the request addressed.
std::string modbus_reply_text(const Device* to, std::span<const std::uint8_t> request,
                              std::span<const std::uint8_t> reply);

}  // namespace understudy::emulator::world
