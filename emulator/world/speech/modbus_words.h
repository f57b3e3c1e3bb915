// Modbus RTU frames in words, with the registers' names: "write 0x1005 feeder.Aaxis_Move_INC = 1".
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "emulator/world/stations/line_station.h"

namespace understudy::emulator::world {

/// "01 03 00 00", cut if it is long.
std::string hex_text(std::span<const std::uint8_t> bytes);
/// "3 (illegal data value)".
std::string exception_text(int exception);

/// Whether a frame's function may change something in a device.
bool is_write(std::span<const std::uint8_t> frame);

/// A frame of a host to these stations. What cannot be read is given in bytes.
std::string modbus_request_text(const LineStations& stations, std::span<const std::uint8_t> request);
/// "mill: MOVE X 1000", of one that writes a command with a name; else empty.
std::string modbus_command_text(const LineStations& stations, std::span<const std::uint8_t> request);
/// What one of them answered. `request` is empty where it is not known.
std::string modbus_reply_text(const LineStations& stations, std::span<const std::uint8_t> request,
                              std::span<const std::uint8_t> reply);

}  // namespace understudy::emulator::world
