// The protocol between a TCP client and a line. It converts bytes, and the caller waits.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pty/line_settings.h"

namespace understudy::emulator::serve {

class ClientProtocol {
 public:
  using Bytes = std::vector<std::uint8_t>;
  virtual ~ClientProtocol() = default;

  /// Returns true if the protocol can receive more bytes from the client; its buffer is limited.
  virtual bool has_room() const = 0;
  /// Returns false if the bytes do not follow the protocol; the client is then disconnected.
  [[nodiscard]] virtual bool receive_from_client(std::span<const std::uint8_t> bytes) = 0;
  /// Returns the next bytes for the line, at most `room`. Empty if there are no bytes yet.
  virtual Bytes take_for_line(std::size_t room) = 0;
  /// Returns the host's settings for the last taken bytes, or nothing if the protocol does not transmit
  /// settings.
  virtual std::optional<pty::HostSettings> settings() const { return std::nullopt; }
  /// Return true, once, if the client flushes bytes that are not transmitted yet, or discards bytes that it
  /// has not received yet. Called after each take_for_line().
  virtual bool discards_input() { return false; }
  virtual bool discards_output() { return false; }

  /// Returns true if the client wants to receive from the line now.
  virtual bool listens() const { return true; }
  virtual void receive_from_line(std::span<const std::uint8_t> bytes) = 0;
  virtual Bytes take_for_client() = 0;

  /// Returns how long the last taken request waits for its answer, not counting the time on the line, or
  /// nothing if no request waits.
  virtual std::optional<std::chrono::milliseconds> patience() const { return std::nullopt; }
  /// Returns the number of bytes of that request and its longest reply, both in the line's format.
  virtual std::size_t exchange_bytes() const { return 0; }
  virtual void give_up() {}
  /// Returns true if no request is waiting. Overridden by protocols that transmit one request at a time.
  virtual bool is_idle() const { return true; }
  /// Called when the client no longer receives answers. The next waiting request is served.
  virtual void client_gone() {}
};

}  // namespace understudy::emulator::serve
