// Packets of pcap and pcapng files (draft-ietf-opsawg-pcap, draft-ietf-opsawg-pcapng), in either byte order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <span>
#include <string>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"

namespace understudy::emulator::box {

struct Packet {
  SimTime at{0};
  std::uint32_t link = 0;    // the number of the link type
  std::string interface {};  // its name; empty: it has none
  CapturedBytes bytes{};
  Side side = Side::unknown;  // inbound and outbound, if the file tells
  bool is_cut = false;        // it has not the whole packet
  std::size_t number = 1;
};

/// Reads numbers from a packet, with checks of its length.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes, bool is_little = false)
      : bytes_(bytes), is_little_(is_little) {}
  bool has(std::size_t count) const { return count <= bytes_.size(); }
  bool is_empty() const { return bytes_.empty(); }
  /// Bytes beyond the end are 0.
  std::uint32_t number(std::size_t size);
  std::span<const std::uint8_t> take(std::size_t count);
  std::span<const std::uint8_t> rest() const { return bytes_; }

 private:
  std::span<const std::uint8_t> bytes_;
  bool is_little_;
};

/// Returns true if a file with this beginning is pcap or pcapng.
bool is_packet_file(std::string_view head);

using PacketSink = std::function<void(Packet packet)>;
/// A file that was cut off while it was written ends there. Throws CaptureReadError.
void read_packets(std::istream& file, const std::string& path, const PacketSink& sink);

}  // namespace understudy::emulator::box
