// CRC-16/MODBUS: polynomial 0xA001 (reflected), start 0xFFFF, sent low byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace understudy::pty {

inline constexpr std::size_t kRtuMinFrame = 4;  // address, function, CRC

std::uint16_t rtu_crc(std::span<const std::uint8_t> bytes);

/// True if the last two bytes are the right checksum of those before. Never for a cut frame (< 4 bytes).
bool rtu_crc_ok(std::span<const std::uint8_t> frame);

/// Completes a frame: appends the checksum of what is there.
void append_rtu_crc(std::vector<std::uint8_t>& frame);

/// Like the above, in a fixed buffer whose first `size` bytes are the frame. Returns the new size. Demands
/// buffer.size() >= size + 2.
std::size_t append_rtu_crc(std::span<std::uint8_t> buffer, std::size_t size);

}  // namespace understudy::pty
