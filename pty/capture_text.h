// Encodes a capture as text, one line per packet:
//
//   0.005333333 out rs485 01 03 02 C0 01 29 84  # remark
//
//   0.105333333 out rs485  # fault 1 drop: not sent
//
// The columns are simulated seconds since power-up, `in` (from the host) or `out`, the line's name, and the
// bytes. If a line is tapped, they are real seconds since 1970, and `one`, `other` or `any` side. Pure.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pty/capture.h"

namespace understudy::pty {

void append_text_head(std::string& file, std::span<const CapturedLine> lines);

/// Appends a packet. `lost_before` is the number of packets of the same line that are missing before this
/// one.
void append_text_packet(std::string& file, std::span<const CapturedLine> lines, const CapturedPacket& packet,
                        std::uint64_t lost_before);

}  // namespace understudy::pty
