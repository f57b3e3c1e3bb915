#include "emulator/serve/ports/tcp_door.h"

#include <arpa/inet.h>
#include <asm/termbits.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <utility>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/ports/modbus_tcp.h"
#include "emulator/serve/ports/port.h"
#include "pty/line_settings.h"
#include "pty/port_link.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kOneReading = 4096;

// So long a client that has gone may still count as the port's host.
constexpr WallTime kUntilGone = std::chrono::milliseconds(50);

// A client whose machine has gone without a word is noticed after about half a minute.
constexpr int kIdleSeconds = 15;
constexpr int kProbeSeconds = 5;
constexpr int kProbes = 3;

// So long a station may take to answer a request of Modbus TCP, and a broadcast to be obeyed, besides the
// time on the wire of the longest request and reply.
constexpr WallTime kReplyPatience = std::chrono::seconds(1);
constexpr WallTime kAfterBroadcast = std::chrono::milliseconds(100);
constexpr int kLongestExchange_bits = 2 * 256 * 11;

sockaddr_in socket_address(const TcpAddress& address) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_port = htons(static_cast<std::uint16_t>(address.port));
  if (inet_pton(AF_INET, address.host.c_str(), &result.sin_addr) != 1)
    throw pty::PortError("--listen: " + address.host +
                         " is not an address; expected a numeric one such as 127.0.0.1");
  return result;
}

/// The line's own settings, as far as a pseudo-terminal has them.
void set_like_line(int terminal, const pty::LineSettings& settings) {
  termios2 its{};
  if (ioctl(terminal, TCGETS2, &its) != 0) return;
  its.c_cflag &= ~static_cast<tcflag_t>(CBAUD | CSTOPB);
  its.c_cflag |= BOTHER | (settings.stop_bits == 2 ? CSTOPB : 0U);
  its.c_ispeed = its.c_ospeed = static_cast<speed_t>(settings.baud);
  ioctl(terminal, TCSETS2, &its);
}

void notice_dead_peers(int client) {
  const auto set = [client](int level, int name, int value) {
    setsockopt(client, level, name, &value, sizeof value);
  };
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, kIdleSeconds);
  set(IPPROTO_TCP, TCP_KEEPINTVL, kProbeSeconds);
  set(IPPROTO_TCP, TCP_KEEPCNT, kProbes);
  set(IPPROTO_TCP, TCP_NODELAY, 1);
}

bool is_for_later() { return errno == EAGAIN || errno == EINTR; }

}  // namespace

TcpDoor::TcpDoor(EventLoop& loop, const Port& port, const pty::LineSettings& settings,
                 const TcpAddress& address, std::function<void(const std::string&)> log)
    : loop_(loop),
      port_(port),
      settings_(settings),
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
    throw pty::PortError("--listen: cannot listen at " + this->address() + ": " + std::strerror(errno) +
                         "; expected a free port");
  address_.port = ntohs(where.sin_port);
  loop_.watch(listener_.get(), EventLoop::readable, [this](std::uint32_t) { admit(); });
}

TcpDoor::~TcpDoor() {
  end();
  loop_.unwatch(listener_.get());
}

std::string TcpDoor::address() const { return address_.host + ":" + std::to_string(address_.port); }

/// A line has one owner: whoever comes second is let go at once.
void TcpDoor::admit() {
  Descriptor client(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client) return;
  const bool has_other_host = port_.host_present() && wall_now() > last_end_ + kUntilGone;
  if (client_ || has_other_host)
    return log_("a second host wants to connect at " + address() + "; the line has one, so it is refused");
  begin(std::move(client));
}

void TcpDoor::begin(Descriptor client) {
  Descriptor terminal(open(port_.terminal().path().c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!terminal) return log_("cannot open the port of " + address() + ": " + std::strerror(errno));
  const bool translates = address_.protocol == TcpProtocol::modbus_tcp;
  Descriptor timer(translates ? timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC) : -1);
  if (translates && !timer) return log_("no timer for " + address() + ": " + std::strerror(errno));
  set_like_line(terminal.get(), settings_);
  notice_dead_peers(client.get());
  client_ = std::move(client);
  terminal_ = std::move(terminal);
  // Where nobody asked whether a side can be read, it has hung up.
  loop_.watch(client_.get(), EventLoop::readable, [this](std::uint32_t ready) {
    if ((ready & EventLoop::readable) != 0 && !wants_to_hear(to_line_)) return end();
    carry(to_line_, client_.get(), terminal_.get());
  });
  loop_.watch(terminal_.get(), EventLoop::readable, [this](std::uint32_t ready) {
    if ((ready & EventLoop::readable) != 0 && !wants_to_hear(to_client_)) return end();
    carry(to_client_, terminal_.get(), client_.get());
  });
  if (!translates) return;
  modbus_.emplace();
  timer_ = std::move(timer);
  loop_.watch(timer_.get(), EventLoop::readable, [this](std::uint32_t) {
    std::uint64_t times = 0;
    if (read(timer_.get(), &times, sizeof times) < 0) return;  // it was set anew meanwhile
    modbus_->give_up();
    if (!hand_on_translated()) return end();
    follow_interest();
  });
}

void TcpDoor::end() {
  if (!client_) return;
  loop_.unwatch(client_.get());
  loop_.unwatch(terminal_.get());
  if (timer_) loop_.unwatch(timer_.get());
  timer_.close();
  modbus_.reset();
  client_.close();
  terminal_.close();
  to_line_.clear();
  to_client_.clear();
  last_end_ = wall_now();
}

/// Both return false if that side has gone.
bool TcpDoor::read_into(Pending& pending, int descriptor) {
  if (!wants_to_hear(pending)) return true;
  std::array<std::uint8_t, kOneReading> bytes;
  const ssize_t count = read(descriptor, bytes.data(), bytes.size());
  if (count <= 0) return count < 0 && is_for_later();
  pending.assign(bytes.begin(), bytes.begin() + count);
  return true;
}

bool TcpDoor::write_out(Pending& pending, int descriptor) {
  if (pending.empty()) return true;
  // A socket whose client has gone must not end us with SIGPIPE; a terminal knows no send().
  ssize_t count = send(descriptor, pending.data(), pending.size(), MSG_NOSIGNAL);
  if (count < 0 && errno == ENOTSOCK) count = write(descriptor, pending.data(), pending.size());
  if (count < 0) return is_for_later();
  pending.erase(pending.begin(), pending.begin() + count);
  return true;
}

/// Whichever side was ready: what waits for the other side too goes first.
void TcpDoor::carry(Pending& pending, int from, int to) {
  Pending& other = &pending == &to_line_ ? to_client_ : to_line_;
  const bool hears = wants_to_hear(pending);
  if (!write_out(other, from) || !read_into(pending, from)) return end();
  if (!modbus_ && !write_out(pending, to)) return end();
  if (modbus_ && ((hears && !translate(pending)) || !hand_on_translated())) return end();
  follow_interest();
}

/// A side is read only once what it has said has been taken.
bool TcpDoor::wants_to_hear(const Pending& pending) const {
  return pending.empty() && (!modbus_ || &pending == &to_client_ || modbus_->has_room());
}

/// False: the client speaks something else.
bool TcpDoor::translate(Pending& heard) {
  const Pending bytes = std::exchange(heard, {});
  if (&heard == &to_client_) {
    modbus_->hear_line(bytes);
    return true;
  }
  if (modbus_->hear_client(bytes)) return true;
  log_("what a client sends at " + address() + " is not Modbus TCP; it is let go");
  return false;
}

/// False: a side has gone.
bool TcpDoor::hand_on_translated() {
  if (!write_out(to_client_, client_.get())) return false;
  if (to_client_.empty()) to_client_ = modbus_->take_for_client();
  if (!write_out(to_client_, client_.get())) return false;
  if (to_line_.empty()) {
    to_line_ = modbus_->take_for_line();
    if (!to_line_.empty()) await_reply();
  }
  return write_out(to_line_, terminal_.get());
}

void TcpDoor::await_reply() {
  const WallTime on_wire = std::chrono::seconds(kLongestExchange_bits) / settings_.baud;
  const WallTime patience = on_wire + (modbus_->is_broadcast() ? kAfterBroadcast : kReplyPatience);
  itimerspec when{};
  when.it_value.tv_sec = std::chrono::duration_cast<std::chrono::seconds>(patience).count();
  when.it_value.tv_nsec = (patience % std::chrono::seconds(1)).count();
  timerfd_settime(timer_.get(), 0, &when, nullptr);
}

void TcpDoor::follow_interest() {
  const auto interest = [this](const Pending& said, const Pending& waits_for_it) {
    return (wants_to_hear(said) ? EventLoop::readable : 0U) |
           (waits_for_it.empty() ? 0U : EventLoop::writable);
  };
  loop_.change_interest(client_.get(), interest(to_line_, to_client_));
  loop_.change_interest(terminal_.get(), interest(to_client_, to_line_));
}

}  // namespace understudy::emulator::serve
