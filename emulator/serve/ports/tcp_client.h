// A client of a TCP door: its socket and its protocol.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "base/files/descriptor.h"
#include "emulator/serve/ports/client_protocol.h"

namespace understudy::emulator::serve {

/// The faults of the next answer.
struct Spoiling {
  bool has_wrong_transaction = false;
  bool has_wrong_unit = false;
  std::optional<std::size_t> split_at{};  // the remaining bytes are sent later
  std::chrono::nanoseconds split_for{0};
  std::optional<std::size_t> hangs_up_after{};  // after this many bytes
};

class TcpClient {
 public:
  TcpClient(Descriptor socket, std::unique_ptr<ClientProtocol> protocol, bool has_messages);

  ClientProtocol& protocol() { return *protocol_; }
  const ClientProtocol& protocol() const { return *protocol_; }
  int socket() const { return socket_.get(); }

  enum class ReadResult : std::uint8_t {
    nothing,          // for now, or because the client has sent everything
    protocol_bytes,   // bytes of its protocol
    foreign_bytes,    // bytes that are not part of its protocol; the client is disconnected
    connection_gone,  // nothing can be sent any more
  };
  /// Reads some of the bytes that the client has sent.
  ReadResult read();
  /// Returns false if nothing is read from the client now, because it has closed its sending half or is ahead
  /// of the line.
  bool is_read() const { return !has_finished_sending_ && protocol_->has_room(); }
  /// Returns true if the client has closed its sending half. It still gets the answers to its requests.
  bool has_finished_sending() const { return has_finished_sending_; }

  /// Sends as many bytes as the network accepts. A later read shows whether the client has disconnected.
  void send_out();
  /// Returns the total number of bytes sent to the client.
  std::uint64_t sent() const { return sent_; }
  bool has_unsent() const { return !unsent_.empty(); }

  // Applies faults to the next answer. The bytes of one call are a complete answer if the protocol
  // `has_messages`, otherwise a part of an answer.
  void spoil(const Spoiling& spoiling) { spoiling_ = spoiling; }
  const Spoiling& spoiling() const { return spoiling_; }
  /// Returns, once, the delay of the rest of an answer.
  std::optional<std::chrono::nanoseconds> take_pause() { return std::exchange(pause_, {}); }
  bool has_rest() const { return !rest_.empty(); }
  void send_rest();
  /// Returns true if the connection ends as soon as all unsent bytes are sent.
  bool hangs_up() const { return hangs_up_; }

  /// Closes the socket. The client's requests are still executed.
  void forget_socket();
  bool is_gone() const { return !socket_; }

 private:
  Descriptor socket_;
  std::unique_ptr<ClientProtocol> protocol_;
  ClientProtocol::Bytes unsent_;  // at most as many bytes as were passed at once
  std::uint64_t sent_ = 0;
  bool has_finished_sending_ = false;
  void spoil_unsent();

  bool has_messages_;
  Spoiling spoiling_;
  ClientProtocol::Bytes rest_;
  std::optional<std::chrono::nanoseconds> pause_;
  bool hangs_up_ = false;
};

}  // namespace understudy::emulator::serve
