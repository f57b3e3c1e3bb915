// What stands between a TCP client and a line: it knows what the client speaks. Bytes in, bytes out; who
// waits, and how long, is the caller's.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pty/line_settings.h"

namespace understudy::emulator::serve {

class TcpSpeech {
 public:
  using Bytes = std::vector<std::uint8_t>;
  virtual ~TcpSpeech() = default;

  /// Whether it wants to hear more of the client: what it keeps is bounded.
  virtual bool has_room() const = 0;
  /// False: this is not what should be spoken here; the client is let go.
  [[nodiscard]] virtual bool hear_client(std::span<const std::uint8_t> bytes) = 0;
  /// What is next for the line, at most `room` bytes. Empty: nothing yet.
  virtual Bytes take_for_line(std::size_t room) = 0;
  /// What the host had set when it wrote what was taken last; nothing: the client cannot tell.
  virtual std::optional<pty::HostSettings> settings() const { return std::nullopt; }
  /// Whether the client wants to have taken back what is not on the wire yet, or thrown away what it has not
  /// got yet. Asked after each taking for the line; true once.
  virtual bool takes_back() { return false; }
  virtual bool throws_away() { return false; }

  /// Whether the client wants to hear the line now.
  virtual bool listens() const { return true; }
  virtual void hear_line(std::span<const std::uint8_t> bytes) = 0;
  virtual Bytes take_for_client() = 0;

  /// How long, besides the time of an exchange on the wire, the request that was taken last waits for its
  /// answer; nothing: none waits.
  virtual std::optional<std::chrono::milliseconds> patience() const { return std::nullopt; }
  virtual void give_up() {}
  /// Of one that puts its requests on the line one after the other: nothing waits.
  virtual bool is_idle() const { return true; }
  /// Nobody hears the client's answers any more. Of requests that wait for one another the next is served.
  virtual void client_gone() {}
};

}  // namespace understudy::emulator::serve
