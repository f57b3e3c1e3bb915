#include "emulator/box/capture/tcp_streams.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/packet_file.h"
#include "emulator/box/capture/rtu_frames.h"
#include "pty/rtu_crc.h"

namespace understudy::emulator::box {

namespace {

using ByteSpan = std::span<const std::uint8_t>;

constexpr std::uint32_t kTcp = 6;
constexpr std::size_t kMaxConnections = 256;
/// Segments that wait for a lost one. When there are more, it is not in the file.
constexpr std::size_t kMaxAhead = 32;
constexpr std::uint32_t kModbusPort = 502;
constexpr std::uint8_t kSyn = 2;
constexpr std::uint8_t kAck = 16;

std::string address_text(ByteSpan address) {
  std::string text;
  char part[8];
  if (address.size() == 4) {
    for (const std::uint8_t byte : address) text += (text.empty() ? "" : ".") + std::to_string(byte);
    return text;
  }
  for (std::size_t i = 0; i + 1 < address.size(); i += 2) {
    std::snprintf(part, sizeof part, "%x", static_cast<unsigned>(address[i] << 8 | address[i + 1]));
    text += (text.empty() ? "" : ":") + std::string(part);
  }
  return "[" + text + "]";
}

/// Numbers of bytes wrap round.
std::int32_t distance(std::uint32_t from, std::uint32_t to) { return static_cast<std::int32_t>(to - from); }

/// Returns true if Modbus TCP may begin so.
bool is_header(ByteSpan bytes) {
  if (bytes.size() < 6 || bytes[2] != 0 || bytes[3] != 0) return false;
  const std::size_t length = static_cast<std::size_t>(bytes[4]) << 8 | bytes[5];
  return length >= 2 && length <= 254;
}

}  // namespace

struct TcpStreams::Header {
  std::string source{};
  std::string target{};
  std::uint32_t source_port = 0;
  std::uint32_t target_port = 0;
  std::uint32_t sequence = 0;
  std::uint8_t flags = 0;
  ByteSpan payload{};

  static std::optional<Header> of(bool is_v6, ByteSpan bytes) {
    ByteReader ip(bytes);
    Header header;
    std::uint32_t size = 0;
    if (is_v6) {
      ip.take(4);
      size = ip.number(2);
      if (ip.number(1) != kTcp) return {};
      ip.take(1);
      header.source = address_text(ip.take(16));
      header.target = address_text(ip.take(16));
    } else {
      const std::uint32_t words = ip.number(1) & 0x0F;
      ip.take(1);
      const std::uint32_t total = ip.number(2);
      ip.take(2);
      const std::uint32_t fragment = ip.number(2);
      ip.take(1);
      if (ip.number(1) != kTcp || words < 5 || total < 4 * words || (fragment & 0x1FFF) != 0) return {};
      ip.take(2);
      header.source = address_text(ip.take(4));
      header.target = address_text(ip.take(4));
      ip.take(4 * words - 20);
      size = total - 4 * words;
    }
    ByteReader tcp(ip.take(size));
    if (!tcp.has(20)) return {};
    header.source_port = tcp.number(2);
    header.target_port = tcp.number(2);
    header.sequence = tcp.number(4);
    tcp.take(4);
    const std::uint32_t offset = tcp.number(1) >> 4;
    header.flags = static_cast<std::uint8_t>(tcp.number(1));
    tcp.take(6);
    if (offset < 5) return {};
    tcp.take(4 * offset - 20);
    header.payload = tcp.rest();
    return header;
  }
  std::string source_end() const { return source + ":" + std::to_string(source_port); }
  std::string target_end() const { return target + ":" + std::to_string(target_port); }
  /// The server is who was called, has the port of Modbus, or the lower one.
  bool is_from_server() const {
    if ((flags & kSyn) != 0) return (flags & kAck) != 0;
    if ((source_port == kModbusPort) != (target_port == kModbusPort)) return source_port == kModbusPort;
    return source_port < target_port;
  }
};

TcpStreams::Connection& TcpStreams::connection_of(const std::string& key, const Header& header) {
  const auto [found, is_new] = connections_.try_emplace(key);
  if (!is_new) return found->second;
  order_.push_back(key);
  if (order_.size() > kMaxConnections) {
    connections_.erase(order_.front());
    order_.pop_front();
  }
  Connection& connection = found->second;
  const bool is_from_server = header.is_from_server();
  connection.server = is_from_server ? header.source_end() : header.target_end();
  connection.is_first_server = connection.server == std::min(header.source_end(), header.target_end());
  connection.number = ++count_;
  return connection;
}

void TcpStreams::take(const Packet& packet, bool is_v6, ByteSpan bytes) {
  const auto header = Header::of(is_v6, bytes);
  if (!header) return;
  const std::string first = std::min(header->source_end(), header->target_end());
  const std::string second = std::max(header->source_end(), header->target_end());
  std::string key = first + "-";
  key += second;
  Connection& connection = connection_of(key, *header);
  const std::size_t from = header->source_end() == first ? 0 : 1;
  Stream& stream = connection.streams[from];
  if ((header->flags & kSyn) != 0) {
    stream = {.next = header->sequence + 1};
    return;
  }
  if (header->payload.empty()) return;
  has_segments_ = true;
  take_segment(connection, from,
               {.sequence = header->sequence,
                .bytes = {header->payload.begin(), header->payload.end()},
                .at = packet.at,
                .place = packet.number});
}

void TcpStreams::take_segment(Connection& connection, std::size_t from, Segment segment) {
  Stream& stream = connection.streams[from];
  if (!stream.next) stream.next = segment.sequence;
  stream.ahead.push_back(std::move(segment));
  while (!stream.ahead.empty()) {
    const auto first = std::ranges::min_element(
        stream.ahead, {}, [&](const Segment& one) { return distance(*stream.next, one.sequence); });
    const std::int32_t gap = distance(*stream.next, first->sequence);
    if (gap > 0 && stream.ahead.size() <= kMaxAhead) return;
    Segment now = std::move(*first);
    stream.ahead.erase(first);
    if (gap > 0) {
      stream.bytes.clear();  // the rest of that frame is lost
    } else {
      // It may be sent again, wholly or in part.
      const auto known =
          std::min<std::size_t>(static_cast<std::size_t>(-std::int64_t{gap}), now.bytes.size());
      now.bytes.erase(now.bytes.begin(), now.bytes.begin() + static_cast<std::ptrdiff_t>(known));
      now.sequence += static_cast<std::uint32_t>(known);
      if (now.bytes.empty()) continue;
    }
    stream.next = now.sequence + static_cast<std::uint32_t>(now.bytes.size());
    // A segment that was sent again has come after those that waited for it.
    now.at = stream.last_at = std::max(stream.last_at, now.at);
    deliver(connection, from, now);
  }
}

void TcpStreams::deliver(Connection& connection, std::size_t from, const Segment& segment) {
  Stream& stream = connection.streams[from];
  const bool is_server = (from == 0) == connection.is_first_server;
  const Side side = is_server ? Side::station : Side::host;
  if (!stream.is_known) {
    stream.is_known = true;
    // A frame of a serial line can look like a header, but then its checksum is right.
    stream.is_modbus_tcp = is_header(segment.bytes) && !pty::rtu_crc_ok(segment.bytes);
  }
  if (!stream.is_modbus_tcp) {
    sink_({.at = segment.at,
           .side = side,
           .line = connection.server,
           .bytes = segment.bytes,
           .place = segment.place});
    return;
  }
  stream.bytes.insert(stream.bytes.end(), segment.bytes.begin(), segment.bytes.end());
  while (stream.bytes.size() >= 8) {
    auto frame = take_tcp_frame(stream.bytes);
    if (!frame) {
      if (is_header(stream.bytes)) return;
      stream.bytes.erase(stream.bytes.begin());
      continue;
    }
    stream.bytes.erase(stream.bytes.begin(), stream.bytes.begin() + static_cast<std::ptrdiff_t>(frame->size));
    sink_({.at = segment.at,
           .side = side,
           .line = connection.server,
           .bytes = std::move(frame->bytes),
           .place = segment.place,
           .is_frame = true,
           .pair = connection.number << 16 | frame->transaction});
  }
}

void TcpStreams::finish() {
  for (auto& [key, connection] : connections_) {
    for (std::size_t from = 0; from < connection.streams.size(); ++from) {
      for (const Segment& segment : std::exchange(connection.streams[from].ahead, {}))
        deliver(connection, from, segment);
    }
  }
}

}  // namespace understudy::emulator::box
