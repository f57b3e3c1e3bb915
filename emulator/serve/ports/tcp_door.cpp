#include "emulator/serve/ports/tcp_door.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/tcp_speech.h"
#include "emulator/world/bench/listening.h"
#include "pty/line_settings.h"
#include "pty/port_link.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kOneReading = 4096;
constexpr std::size_t kMostLeft = 16'384;  // of what a client that has gone has sent

// A client whose machine has gone without a word is noticed after about half a minute.
constexpr int kIdleSeconds = 15;
constexpr int kProbeSeconds = 5;
constexpr int kProbes = 3;

// The longest request and reply.
constexpr int kLongestExchange_bits = 2 * 256 * 11;

sockaddr_in socket_address(const world::TcpAddress& address) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_port = htons(static_cast<std::uint16_t>(address.port));
  if (inet_pton(AF_INET, address.host.c_str(), &result.sin_addr) != 1)
    throw pty::PortError("--listen: " + address.host +
                         " is not an address; expected a numeric one such as 127.0.0.1");
  return result;
}

void notice_dead_peers(int client) {
  const auto set = [client](int level, int name, int value) {
    setsockopt(client, level, name, &value, sizeof value);
  };
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, kIdleSeconds);
  set(IPPROTO_TCP, TCP_KEEPINTVL, kProbeSeconds);
  set(IPPROTO_TCP, TCP_KEEPCNT, kProbes);
  set(IPPROTO_TCP, TCP_USER_TIMEOUT, 1000 * (kIdleSeconds + kProbes * kProbeSeconds));
  set(IPPROTO_TCP, TCP_NODELAY, 1);
}

bool is_for_later() { return errno == EAGAIN || errno == EINTR; }

}  // namespace

TcpDoor::TcpDoor(EventLoop& loop, Port& port, const world::TcpAddress& address,
                 std::function<void(const std::string&)> log)
    : loop_(loop),
      port_(port),
      address_(address),
      log_(std::move(log)),
      listener_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  sockaddr_in where = socket_address(address_);
  const int yes = 1;
  setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  socklen_t size = sizeof where;
  auto* const raw = reinterpret_cast<sockaddr*>(&where);
  if (bind(listener_.get(), raw, size) != 0 || listen(listener_.get(), 4) != 0 ||
      getsockname(listener_.get(), raw, &size) != 0)
    throw pty::PortError("--listen: cannot listen at " + world::to_string(address_) + ": " +
                         std::strerror(errno) + "; expected a free port");
  address_.port = ntohs(where.sin_port);
  port_.add_tcp_place(world::to_string(address_));
  loop_.watch(listener_.get(), EventLoop::readable, [this](std::uint32_t) { admit(); });
}

TcpDoor::~TcpDoor() {
  forget_client();
  loop_.unwatch(listener_.get());
}

/// A line has one owner: whoever comes second is let go at once.
void TcpDoor::admit() {
  Descriptor client(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client) return;
  Descriptor timer(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC));
  if (!timer) return log_("no timer for " + world::to_string(address_) + ": " + std::strerror(errno));
  if (!port_.admit(*this))
    return log_("a second host wants to connect at " + world::to_string(address_) +
                "; the line has one, so it is refused");
  notice_dead_peers(client.get());
  client_ = std::move(client);
  timer_ = std::move(timer);
  speech_ = make_tcp_speech(address_.protocol, port_.line().options().settings);
  loop_.watch(client_.get(), EventLoop::readable | EventLoop::departed,
              [this](std::uint32_t ready) { on_client(ready); });
  loop_.watch(timer_.get(), EventLoop::readable, [this](std::uint32_t) {
    std::uint64_t times = 0;
    if (read(timer_.get(), &times, sizeof times) < 0) return;  // it was set anew meanwhile
    speech_->give_up();
    serve_line();
  });
  serve_line();
}

void TcpDoor::on_client(std::uint32_t ready) {
  if ((ready & EventLoop::departed) != 0) return end();
  if ((ready & EventLoop::readable) != 0 && speech_->has_room() && !read_client()) return end();
  serve_line();
}

/// False: the client has gone, or is let go.
bool TcpDoor::read_client() {
  std::array<std::uint8_t, kOneReading> bytes;
  const ssize_t count = recv(client_.get(), bytes.data(), bytes.size(), 0);
  if (count <= 0) return count < 0 && is_for_later();
  if (speech_->hear_client(std::span(bytes).first(static_cast<std::size_t>(count)))) return true;
  log_("what a client sends at " + world::to_string(address_) + " is not Modbus TCP; it is let go");
  return false;
}

/// What the client has sent, as far as the line has room, and what there is for the client.
void TcpDoor::serve_line() {
  if (is_serving_) return;
  is_serving_ = true;
  for (bool goes_on = true; goes_on;) {
    const TcpSpeech::Bytes bytes = speech_->take_for_line(port_.room());
    const bool takes_back = speech_->takes_back();
    const bool throws_away = speech_->throws_away();
    if (takes_back) port_.take_back();
    if (throws_away) port_.throw_away();
    if (!bytes.empty()) {
      const pty::LineSettings line = port_.line().options().settings;
      await_reply();
      port_.hear(bytes, speech_->settings().value_or(
                            pty::HostSettings{.baud = line.baud, .stop_bits = line.stop_bits}));
    }
    goes_on = !bytes.empty() || takes_back || throws_away;
  }
  send_out();
  is_serving_ = false;
  loop_.change_interest(client_.get(), EventLoop::departed |
                                           (speech_->has_room() ? EventLoop::readable : 0U) |
                                           (unsent_.empty() ? 0U : EventLoop::writable));
}

void TcpDoor::await_reply() {
  const auto patience_ms = speech_->patience_ms();
  if (!patience_ms) return;
  const WallTime on_wire = std::chrono::seconds(kLongestExchange_bits) / port_.line().options().settings.baud;
  const WallTime patience = on_wire + std::chrono::milliseconds(*patience_ms);
  itimerspec when{};
  when.it_value.tv_sec = std::chrono::duration_cast<std::chrono::seconds>(patience).count();
  when.it_value.tv_nsec = (patience % std::chrono::seconds(1)).count();
  timerfd_settime(timer_.get(), 0, &when, nullptr);
}

/// A client that reads more slowly than the line speaks leaves the rest to the line, which keeps some.
std::size_t TcpDoor::take(std::span<const std::uint8_t> bytes) {
  if (!unsent_.empty() || !speech_->listens()) return 0;
  speech_->hear_line(bytes);
  send_out();
  return bytes.size();
}

void TcpDoor::follow() { serve_line(); }

/// That the client has gone is learnt by reading.
void TcpDoor::send_out() {
  while (true) {
    if (unsent_.empty()) unsent_ = speech_->take_for_client();
    if (unsent_.empty()) return;
    const ssize_t count = send(client_.get(), unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
    if (count < 0 && is_for_later()) return;
    unsent_.erase(unsent_.begin(), count < 0 ? unsent_.end() : unsent_.begin() + count);
  }
}

/// Reads some of what a client that has gone has sent; false: there is no more.
bool TcpDoor::read_rest() {
  std::array<std::uint8_t, kOneReading> bytes;
  const ssize_t count = recv(client_.get(), bytes.data(), bytes.size(), 0);
  return count > 0 && speech_->hear_client(std::span(bytes).first(static_cast<std::size_t>(count)));
}

/// What it has sent is served still; of Modbus TCP that is one request, as each waits for the one before.
void TcpDoor::end() {
  TcpSpeech::Bytes last;
  const bool is_gateway = address_.protocol == world::TcpProtocol::modbus_tcp;
  bool goes_on = true;
  if (is_gateway) read_rest();
  while (goes_on && last.size() < kMostLeft) {
    const TcpSpeech::Bytes some = speech_->take_for_line(kOneReading);
    last.insert(last.end(), some.begin(), some.end());
    speech_->take_for_client();
    goes_on = !is_gateway && (!some.empty() || read_rest());
  }
  forget_client();
  port_.leave(last);
}

void TcpDoor::forget_client() {
  if (!client_) return;
  loop_.unwatch(client_.get());
  loop_.unwatch(timer_.get());
  client_.close();
  timer_.close();
  speech_.reset();
  unsent_.clear();
}

}  // namespace understudy::emulator::serve
