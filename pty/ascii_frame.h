// Modbus ASCII frames: ':', two hexadecimal digits for each byte of the address and the PDU, two for the LRC,
// CR, LF. They carry the same bytes as RTU frames, so all that is above a station knows only RTU frames.
// Source: MODBUS over Serial Line V1.02, 2.5.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace understudy::pty {

/// ':', 254 bytes and the LRC as digits, CR, LF.
inline constexpr std::size_t kAsciiMaxFrame = 513;

/// Returns the two's complement of the sum of the bytes.
std::uint8_t lrc(std::span<const std::uint8_t> bytes);

/// Returns the ASCII frame with the content of an RTU frame, whose checksum it leaves out.
std::vector<std::uint8_t> ascii_of_rtu(std::span<const std::uint8_t> frame);

/// Returns the RTU frame, with its checksum, that has the content of an ASCII frame. Digits may be small
/// letters. Nothing: not a frame, or a wrong LRC.
std::optional<std::vector<std::uint8_t>> rtu_of_ascii(std::span<const std::uint8_t> frame);

/// Returns true for a frame in which everything is right, except perhaps the LRC.
bool has_ascii_form(std::span<const std::uint8_t> frame);

}  // namespace understudy::pty
