// What packets carry, by the type of their link: bytes of a serial line, or TCP.
#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <span>
#include <string>
#include <utility>

#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/packet_file.h"
#include "emulator/box/capture/piece_readers.h"
#include "emulator/box/capture/tcp_streams.h"
#include "pty/capture_pcapng.h"

namespace understudy::emulator::box {

namespace {

using ByteSpan = std::span<const std::uint8_t>;

// https://www.tcpdump.org/linktypes.html
constexpr std::uint32_t kNull = 0;
constexpr std::uint32_t kEthernet = 1;
constexpr std::array<std::uint32_t, 4> kRawIp{12, 14, 101, 228};
constexpr std::uint32_t kRawIpV6 = 229;
constexpr std::uint32_t kLoop = 108;
constexpr std::uint32_t kLinuxCooked = 113;
constexpr std::uint32_t kFirstUser = 147;
constexpr std::uint32_t kLastUser = 162;
constexpr std::uint32_t kRtacSerial = 250;
constexpr std::uint32_t kUpperPdu = 252;
constexpr std::uint32_t kLinuxCooked2 = 276;

constexpr std::uint32_t kIpV4Type = 0x0800;
constexpr std::uint32_t kIpV6Type = 0x86DD;
constexpr std::array<std::uint32_t, 3> kVlanTypes{0x8100, 0x88A8, 0x9100};

template <typename List>
bool contains(const List& list, std::uint32_t value) {
  for (const std::uint32_t one : list)
    if (one == value) return true;
  return false;
}

class PacketPieces {
 public:
  PacketPieces(const std::string& path, const PieceSink& sink) : path_(path), sink_(sink), tcp_(sink) {}

  void take(const Packet& packet) {
    ByteReader reader(packet.bytes);
    const std::uint32_t link = packet.link;
    if (link == kUpperPdu) return take_upper_pdu(packet, reader);
    if (link == kRtacSerial) return take_rtac(packet, reader);
    if (link >= kFirstUser && link <= kLastUser) return hand_on(packet, packet.side, reader.rest());
    if (link == kEthernet) {
      reader.take(12);
      std::uint32_t type = reader.number(2);
      while (contains(kVlanTypes, type)) {
        reader.take(2);
        type = reader.number(2);
      }
      return take_ip(packet, type, reader);
    }
    if (link == kLinuxCooked) {
      reader.take(14);
      const std::uint32_t type = reader.number(2);
      return take_ip(packet, type, reader);
    }
    if (link == kLinuxCooked2) {
      const std::uint32_t type = reader.number(2);
      reader.take(18);
      return take_ip(packet, type, reader);
    }
    if (link == kNull || link == kLoop) reader.take(4);
    if (link == kNull || link == kLoop || link == kRawIpV6 || contains(kRawIp, link)) {
      const bool is_v6 = !reader.is_empty() && reader.rest()[0] >> 4 == 6;
      return take_ip(packet, is_v6 ? kIpV6Type : kIpV4Type, reader);
    }
    throw CaptureReadError(
        path_ + ": packet " + std::to_string(packet.number) + ": is of link type " + std::to_string(link) +
        "; expected a serial line (user 0 to 15, RTAC, or of `serve --capture`) or TCP (Ethernet, "
        "loopback, Linux cooked, raw IP)");
  }

  void finish() { tcp_.finish(); }
  const TcpStreams& tcp() const { return tcp_; }

 private:
  void hand_on(const Packet& packet, Side side, ByteSpan bytes, bool is_ours = false) {
    sink_({.at = packet.at,
           .side = side,
           .line = packet.interface,
           .bytes = {bytes.begin(), bytes.end()},
           .place = packet.number,
           .is_frame = is_ours,
           .counts_from_power_up = is_ours});
  }

  /// Ours: tags, and then a frame. A packet that has only a comment has no bytes.
  void take_upper_pdu(const Packet& packet, ByteReader reader) {
    constexpr std::uint32_t kSourcePort = 25;
    std::uint32_t source = 0;
    while (reader.has(4)) {
      const std::uint32_t tag = reader.number(2);
      const std::uint32_t length = reader.number(2);
      if (tag == 0) break;
      ByteReader value(reader.take(length));
      if (tag == kSourcePort && length == 4) source = value.number(4);
    }
    hand_on(packet, source == pty::kPcapngStationPort ? Side::station : Side::host, reader.rest(), true);
  }

  /// The header of Schweitzer's RTAC: relative time, kind of event, control lines, footer.
  void take_rtac(const Packet& packet, ByteReader reader) {
    reader.take(8);
    const std::uint32_t event = reader.number(1);
    reader.take(3);
    constexpr std::array kSides{Side::unknown, Side::one, Side::other, Side::one, Side::other};
    if (event < kSides.size()) hand_on(packet, kSides[event], reader.rest());
  }

  void take_ip(const Packet& packet, std::uint32_t type, ByteReader reader) {
    if (type == kIpV4Type || type == kIpV6Type) tcp_.take(packet, type == kIpV6Type, reader.rest());
  }

  const std::string& path_;
  const PieceSink& sink_;
  TcpStreams tcp_;
};

}  // namespace

std::string read_packet_pieces(std::istream& file, const std::string& path, const PieceSink& sink) {
  PacketPieces pieces(path, sink);
  std::uint32_t link = kUpperPdu;
  read_packets(file, path, [&](const Packet& packet) {
    link = packet.link;
    pieces.take(packet);
  });
  pieces.finish();
  if (link == kUpperPdu) return "a capture of understudy";
  return pieces.tcp().has_segments() ? "packets of TCP" : "packets of a serial line";
}

}  // namespace understudy::emulator::box
