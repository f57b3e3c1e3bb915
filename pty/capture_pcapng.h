// Encodes a capture as pcapng for Wireshark and tshark. Pure: it appends whole blocks to a buffer.
//
// The link type is "Wireshark upper PDU": each packet names its own dissector, so that no decode-as flag is
// needed; lines of text are plain data. Stations send from port 19200 and hosts to it, so that Wireshark can
// distinguish requests from replies (`-o mbrtu.tcp.port:19200`), and each line's host has its own port,
// which keeps lines apart. Numbers are always little-endian, so a capture is the same file on every machine.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pty/capture.h"

namespace understudy::pty {

inline constexpr std::uint16_t kPcapngStationPort = 19200;

/// Appends the beginning of the file: a section header, and an interface description for each line.
void append_pcapng_head(std::string& file, std::span<const CapturedLine> lines);

/// Appends an enhanced packet block. `lost_before` is the number of packets of the same line that are
/// missing before this one.
void append_pcapng_packet(std::string& file, const CapturedPacket& packet, std::uint64_t lost_before);

}  // namespace understudy::pty
