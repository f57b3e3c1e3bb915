// CRC-16/MODBUS: polynomial 0xA001 (reflected), start value 0xFFFF, low byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace understudy::pty {

inline constexpr std::size_t kRtuMinFrame = 4;  // address, function, CRC

std::uint16_t rtu_crc(std::span<const std::uint8_t> bytes);

/// Returns true if the last two bytes are the right checksum of those before. False for fewer than 4 bytes.
bool rtu_crc_ok(std::span<const std::uint8_t> frame);

/// Completes a frame by appending the checksum of its bytes.
void append_rtu_crc(std::vector<std::uint8_t>& frame);

/// Does the same in a fixed buffer whose first `size` bytes are the frame. Returns the new size. Requires
/// buffer.size() >= size + 2.
std::size_t append_rtu_crc(std::span<std::uint8_t> buffer, std::size_t size);

}  // namespace understudy::pty
