// Modbus RTU frames in words, with the registers' names: "write 0x1005 feeder.Aaxis_Move_INC = 1".
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// "01 03 00 00", cut if it is long.
std::string hex_text(std::span<const std::uint8_t> bytes);
/// "3 (illegal data value)".
std::string exception_text(int exception);

/// A frame of a host on that line. If it cannot be read it is shown as bytes.
std::string request_text(const World& world, std::size_t line, std::span<const std::uint8_t> request);
/// What a station answered. `request` is empty if it is not known.
std::string reply_text(const World& world, std::size_t line, std::span<const std::uint8_t> request,
                       std::span<const std::uint8_t> reply);

}  // namespace understudy::emulator::world
