#include "emulator/serve/ports/tcp_client.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/types.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "base/files/descriptor.h"
#include "emulator/serve/ports/client_protocol.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kOneReading = 4096;

// A client whose machine disappears without closing is detected after about half a minute.
constexpr int kIdleSeconds = 15;
constexpr int kProbeSeconds = 5;
constexpr int kProbes = 3;

void set_option(int socket, int level, int name, int value) {
  setsockopt(socket, level, name, &value, sizeof value);
}

void notice_dead_peers(int socket) {
  set_option(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_option(socket, IPPROTO_TCP, TCP_KEEPIDLE, kIdleSeconds);
  set_option(socket, IPPROTO_TCP, TCP_KEEPINTVL, kProbeSeconds);
  set_option(socket, IPPROTO_TCP, TCP_KEEPCNT, kProbes);
  set_option(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, 1000 * (kIdleSeconds + kProbes * kProbeSeconds));
}

/// Acknowledges received bytes immediately. A host that writes a frame in pieces with Nagle's algorithm sends
/// the second piece only when the first one is acknowledged. The kernel delays the acknowledgement by 40 ms
/// unless this option is set after each read.
void acknowledge_at_once(int socket) { set_option(socket, IPPROTO_TCP, TCP_QUICKACK, 1); }

bool is_for_later() { return errno == EAGAIN || errno == EINTR; }

}  // namespace

TcpClient::TcpClient(Descriptor socket, std::unique_ptr<ClientProtocol> protocol, bool has_messages)
    : socket_(std::move(socket)), protocol_(std::move(protocol)), has_messages_(has_messages) {
  notice_dead_peers(socket_.get());
  set_option(socket_.get(), IPPROTO_TCP, TCP_NODELAY, 1);
  acknowledge_at_once(socket_.get());
}

TcpClient::ReadResult TcpClient::read() {
  std::array<std::uint8_t, kOneReading> bytes;
  const ssize_t count = recv(socket_.get(), bytes.data(), bytes.size(), 0);
  if (count < 0) return is_for_later() ? ReadResult::nothing : ReadResult::connection_gone;
  if (count == 0) {
    has_finished_sending_ = true;
    return ReadResult::nothing;
  }
  acknowledge_at_once(socket_.get());
  const bool is_known =
      protocol_->receive_from_client(std::span(bytes).first(static_cast<std::size_t>(count)));
  return is_known ? ReadResult::protocol_bytes : ReadResult::foreign_bytes;
}

void TcpClient::send_out() {
  while (true) {
    if (unsent_.empty()) {
      unsent_ = protocol_->take_for_client();
      spoil_unsent();
    }
    if (unsent_.empty()) return;
    if (is_gone()) {
      unsent_.clear();
      continue;
    }
    const ssize_t count = send(socket_.get(), unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
    if (count < 0 && is_for_later()) return;
    sent_ += static_cast<std::uint64_t>(std::max<ssize_t>(count, 0));
    unsent_.erase(unsent_.begin(), count < 0 ? unsent_.end() : unsent_.begin() + count);
  }
}

/// Applies faults to a reply, which begins with its transaction. Its unit follows the length
/// (modbus_tcp.cpp).
void TcpClient::spoil_unsent() {
  constexpr std::size_t kTransaction = 1;
  constexpr std::size_t kUnit = 6;
  if (hangs_up_) unsent_.clear();
  if (unsent_.empty()) return;
  if (spoiling_.has_wrong_transaction) ++unsent_.at(kTransaction);
  if (spoiling_.has_wrong_unit) ++unsent_.at(kUnit);
  if (spoiling_.hangs_up_after) {
    hangs_up_ = has_messages_ || unsent_.size() >= *spoiling_.hangs_up_after;
    unsent_.resize(std::min(unsent_.size(), *spoiling_.hangs_up_after));
    *spoiling_.hangs_up_after -= unsent_.size();
  }
  if (spoiling_.split_at && *spoiling_.split_at < unsent_.size()) {
    rest_.assign(unsent_.begin() + static_cast<std::ptrdiff_t>(*spoiling_.split_at), unsent_.end());
    unsent_.resize(*spoiling_.split_at);
    pause_ = spoiling_.split_for;
  }
  if (has_messages_) spoiling_ = {};
}

void TcpClient::send_rest() {
  unsent_.insert(unsent_.end(), rest_.begin(), rest_.end());
  rest_.clear();
  send_out();
}

void TcpClient::forget_socket() {
  socket_.close();
  unsent_.clear();
  rest_.clear();
  protocol_->client_gone();
}

}  // namespace understudy::emulator::serve
