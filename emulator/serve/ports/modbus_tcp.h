// Converts between Modbus TCP and RTU or ASCII, like a gateway. One request at a time is on the line, and
// other requests wait. This class only converts bytes, and the caller waits. Source: MODBUS Messaging on
// TCP/IP 1.0b, 3.1.3 and 4.4.2.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "emulator/serve/ports/client_protocol.h"

namespace understudy::emulator::serve {

/// The gateway's settings, and the stations on its line.
struct GatewayRules {
  std::chrono::milliseconds timeout{1000};  // the longest wait for a station's answer
  bool reports_timeout = true;              // a timeout is reported as exception 11
  bool is_ascii = false;                    // the line uses Modbus ASCII
  /// Returns the station for a unit; null: the station with the unit's number.
  std::function<std::uint8_t(std::uint8_t unit, std::uint8_t function)> station_of{};
};

class ModbusTcp final : public ClientProtocol {
 public:
  explicit ModbusTcp(GatewayRules rules = {}) : rules_(std::move(rules)) {}

  /// Returns false if the bytes contain an impossible length, so that the beginning of the next request is
  /// unknown. Earlier requests are still served, but that message and all later bytes are ignored.
  [[nodiscard]] bool receive_from_client(std::span<const std::uint8_t> bytes) override;
  void receive_from_line(std::span<const std::uint8_t> bytes) override;
  std::optional<std::chrono::milliseconds> patience() const override;
  std::size_t exchange_bytes() const override { return on_line_ ? on_line_->exchange_bytes : 0; }
  /// Call this when the time for the reply has passed. Reports to the client that the station does not
  /// answer, except after a broadcast, or if the settings forbid it.
  void give_up() override;
  bool is_idle() const override;
  void client_gone() override;

  /// Returns the next request as a frame with its checksum. Returns no bytes if there is no request, while
  /// another request is on the line, or until the client has taken the last answer.
  Bytes take_for_line(std::size_t room) override;
  Bytes take_for_client() override;

  /// Returns true if a request is on the line. After a broadcast (`is_broadcast`), no station answers, except
  /// a station with number 0.
  bool waits() const { return on_line_.has_value(); }
  bool is_broadcast() const { return on_line_ && on_line_->station == 0; }
  bool has_room() const override { return received_.size() < kMaxReceived; }

 private:
  static constexpr std::size_t kMaxReceived = 4096;

  struct Request {
    std::uint16_t transaction = 0;
    std::uint8_t unit = 0;     // the client's number of the station
    std::uint8_t station = 0;  // its number on the line
    std::uint8_t function = 0;
    std::size_t exchange_bytes = 0;
  };
  void answer(std::span<const std::uint8_t> pdu);
  void take_ascii_reply();
  bool is_reply(std::span<const std::uint8_t> frame) const;

  GatewayRules rules_;
  Bytes received_;           // from the client: complete requests, and the beginning of another
  bool is_refused_ = false;  // the client has sent bytes that are not Modbus TCP
  Bytes reply_;              // the bytes received from the line so far
  Bytes to_client_;
  std::optional<Request> on_line_;
};

}  // namespace understudy::emulator::serve
