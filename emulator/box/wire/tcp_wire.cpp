#include "emulator/box/wire/tcp_wire.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "base/files/descriptor.h"
#include "base/text/one_line.h"
#include "emulator/box/wire/descriptor_io.h"
#include "emulator/box/wire/wire.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/ports/telnet.h"
#include "emulator/world/bench/listening.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

namespace telnet = serve::telnet;

namespace {

constexpr WallTime kConnectTime = std::chrono::seconds(5);
constexpr WallTime kNegotiationTime = std::chrono::seconds(2);

// Codes of RFC 2217.
constexpr std::uint8_t kSetBaud = 1;
constexpr std::uint8_t kSetDataBits = 2;
constexpr std::uint8_t kSetParity = 3;
constexpr std::uint8_t kSetStopBits = 4;
constexpr std::uint8_t kFromServer = 100;

/// Returns 0, or the error number.
int connect_to(const Descriptor& client, const addrinfo& place) {
  if (::connect(client.get(), place.ai_addr, place.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  pollfd waited{.fd = client.get(), .events = POLLOUT, .revents = 0};
  const auto patience = std::chrono::duration_cast<std::chrono::milliseconds>(kConnectTime);
  if (::poll(&waited, 1, static_cast<int>(patience.count())) <= 0) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof error;
  getsockopt(client.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

Descriptor connect_to(const world::TcpAddress& address, const std::string& place) {
  const auto refuse = [&](const std::string& why) {
    return WireError(one_line(place) + ": " + why + "; expected an adapter that listens there");
  };
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int unknown = getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &found);
  if (unknown != 0) throw refuse(gai_strerror(unknown));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> freed(found, freeaddrinfo);
  int error = 0;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    Descriptor client(::socket(one->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    error = client ? connect_to(client, *one) : errno;
    if (error != 0) continue;
    const int yes = 1;
    setsockopt(client.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    return client;
  }
  throw refuse(std::strerror(error));
}

std::uint8_t code_of(pty::Parity parity) {
  return parity == pty::Parity::none ? 1 : parity == pty::Parity::odd ? 2 : 3;
}

}  // namespace

TcpWire::TcpWire(const world::TcpAddress& address)
    : place_(world::to_string(address)),
      is_telnet_(address.protocol == world::TcpProtocol::rfc2217),
      socket_(connect_to(address, place_)) {
  if (is_telnet_) offer();
}

void TcpWire::offer() {
  Bytes offers;
  for (const std::uint8_t option : {telnet::kBinary, telnet::kSuppressGoAhead, telnet::kComPort})
    offers.insert(offers.end(), {telnet::kIac, telnet::kWill, option});
  for (const std::uint8_t option : {telnet::kBinary, telnet::kSuppressGoAhead})
    offers.insert(offers.end(), {telnet::kIac, telnet::kDo, option});
  write_all(socket_, offers, place_);
  Bytes none;
  const WallTime deadline = serve::wall_now() + kNegotiationTime;
  while (!has_com_port_ && !refuses_com_port_ && serve::wall_now() < deadline) read_raw(none, deadline);
  if (!has_com_port_)
    throw WireError(one_line(place_) + ": does not speak RFC 2217; expected an adapter that does, or rtu://");
}

void TcpWire::answer(const telnet::Command& command) {
  const bool is_ours = command.option == telnet::kBinary || command.option == telnet::kSuppressGoAhead ||
                       command.option == telnet::kComPort;
  const bool is_com_port = command.option == telnet::kComPort;
  switch (command.verb) {
    case telnet::kDo:
      has_com_port_ = has_com_port_ || is_com_port;
      if (!is_ours) write_all(socket_, Bytes{telnet::kIac, telnet::kWont, command.option}, place_);
      break;
    case telnet::kDont: refuses_com_port_ = refuses_com_port_ || is_com_port; break;
    case telnet::kWill:
      if (!is_ours) write_all(socket_, Bytes{telnet::kIac, telnet::kDont, command.option}, place_);
      break;
    case telnet::kSubnegotiation:
      if (is_com_port && !command.body.empty() && command.body[0] == kSetBaud + kFromServer)
        ++settings_confirmed_;
      break;
    default: break;
  }
}

void TcpWire::read_raw(Bytes& data, WallTime until) {
  Bytes raw;
  read_some(socket_, raw, until, place_);
  reader_.append(raw);
  while (true) {
    reader_.take_data(data, telnet::Reader::kMaxReceived, true);
    const auto command = reader_.take_command();
    if (!command) break;
    answer(*command);
  }
}

void TcpWire::set_line(const pty::LineSettings& settings) {
  if (!is_telnet_) return;
  const auto baud = static_cast<std::uint32_t>(settings.baud);
  Bytes sent;
  const auto set = [&](std::uint8_t code, std::initializer_list<std::uint8_t> value) {
    Bytes body{telnet::kComPort, code};
    body.insert(body.end(), value);
    telnet::append_subnegotiation(sent, body);
  };
  set(kSetBaud, {static_cast<std::uint8_t>(baud >> 24), static_cast<std::uint8_t>(baud >> 16),
                 static_cast<std::uint8_t>(baud >> 8), static_cast<std::uint8_t>(baud)});
  set(kSetDataBits, {static_cast<std::uint8_t>(settings.data_bits)});
  set(kSetParity, {code_of(settings.parity)});
  set(kSetStopBits, {static_cast<std::uint8_t>(settings.stop_bits)});
  const int before = settings_confirmed_;
  write_all(socket_, sent, place_);
  Bytes none;
  const WallTime deadline = serve::wall_now() + kNegotiationTime;
  while (settings_confirmed_ == before && serve::wall_now() < deadline) read_raw(none, deadline);
}

void TcpWire::send(std::span<const std::uint8_t> bytes) {
  if (!is_telnet_) return write_all(socket_, bytes, place_);
  Bytes sent;
  telnet::append_data(sent, bytes, true);
  write_all(socket_, sent, place_);
}

bool TcpWire::receive(Bytes& bytes, WallTime until) {
  if (!is_telnet_) return read_some(socket_, bytes, until, place_);
  const std::size_t before = bytes.size();
  read_raw(bytes, until);
  return bytes.size() > before;
}

}  // namespace understudy::emulator::box
