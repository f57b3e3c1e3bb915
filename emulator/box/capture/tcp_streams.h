// Bytes of TCP connections in their order, and the frames of Modbus TCP in them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/packet_file.h"
#include "emulator/box/capture/piece_readers.h"

namespace understudy::emulator::box {

/// Bytes that are not Modbus TCP are passed on as they are: a gateway may send those of a serial line.
class TcpStreams {
 public:
  explicit TcpStreams(const PieceSink& sink) : sink_(sink) {}

  /// Takes a packet of IP.
  void take(const Packet& packet, bool is_v6, std::span<const std::uint8_t> bytes);
  void finish();
  bool has_segments() const { return has_segments_; }

 private:
  struct Segment {
    std::uint32_t sequence = 0;
    CapturedBytes bytes{};
    SimTime at{0};
    std::size_t place = 0;
  };
  /// One direction of a connection.
  struct Stream {
    std::optional<std::uint32_t> next{};  // the number of the byte that comes next
    std::vector<Segment> ahead{};         // came before an earlier one
    CapturedBytes bytes{};                // the beginning of a frame
    SimTime last_at{0};
    bool is_modbus_tcp = false;
    bool is_known = false;  // whether it is
  };
  struct Connection {
    std::string server{};
    bool is_first_server = false;  // of the two ends, in their order
    std::uint64_t number = 0;
    std::array<Stream, 2> streams{};
  };
  struct Header;
  Connection& connection_of(const std::string& key, const Header& header);
  void take_segment(Connection& connection, std::size_t from, Segment segment);
  void deliver(Connection& connection, std::size_t from, const Segment& segment);

  const PieceSink& sink_;
  std::map<std::string, Connection> connections_;
  std::list<std::string> order_;  // the oldest first
  std::uint64_t count_ = 0;
  bool has_segments_ = false;
};

}  // namespace understudy::emulator::box
