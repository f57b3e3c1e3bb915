#include "emulator/serve/ports/tcp_door.h"

#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"
#include "base/simulated_time.h"
#include "emulator/device/modbus/modbus_ascii.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/listener.h"
#include "emulator/serve/ports/client_protocol.h"
#include "emulator/serve/ports/gateway_units.h"
#include "emulator/serve/ports/modbus_tcp.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/raw_bytes.h"
#include "emulator/serve/ports/rfc2217.h"
#include "emulator/serve/ports/tcp_client.h"
#include "emulator/serve/ports/tcp_places.h"
#include "emulator/world/bench/listening.h"
#include "emulator/world/faults/fault.h"
#include "emulator/world/protocol/line_protocol.h"
#include "pty/line_settings.h"
#include "pty/port_link.h"

namespace understudy::emulator::serve {

namespace {

constexpr std::size_t kOneTaking = 4096;
constexpr std::size_t kMaxLeft = 16'384;  // from a client that has disconnected

// A client that sends no more may wait this long for its replies while another client wants the line.
constexpr std::chrono::nanoseconds kLongestGoodbye = std::chrono::seconds(1);

constexpr std::size_t kBitsOfByte = 11;
// The pause that ends a request, rounded up. The station cannot answer before its end.
constexpr std::size_t kSilence_bytes = 4;

}  // namespace

TcpDoor::TcpDoor(EventLoop& loop, Port& port, const world::TcpAddress& address,
                 std::function<void(const std::string&)> log, Service service)
    : loop_(loop),
      port_(port),
      address_(address),
      log_(std::move(log)),
      is_on_demand_(service == Service::on_demand),
      timer_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {
  if (!timer_)
    throw pty::PortError("--listen: no timer for " + world::to_string(address_) + ": " +
                         std::strerror(errno));
  std::vector<Descriptor> sockets = is_on_demand_ ? std::vector<Descriptor>() : listen_at(address_);
  for (Descriptor& socket : sockets) {
    listeners_.push_back(std::make_unique<Listener>(loop_, std::move(socket),
                                                    [this](Descriptor client) { admit(std::move(client)); }));
  }
  loop_.watch(timer_.get(), EventLoop::readable, [this](std::uint32_t) { on_timer(); });
  port_.add_tcp_place(world::to_string(address_));
}

TcpDoor::~TcpDoor() {
  listeners_.clear();
  loop_.unwatch(timer_.get());
  for (const auto& client : clients_) loop_.unwatch(client->socket());
}

std::unique_ptr<ClientProtocol> TcpDoor::make_protocol() {
  switch (address_.protocol) {
    case world::TcpProtocol::rtu: return std::make_unique<RawBytes>();
    case world::TcpProtocol::rfc2217: return std::make_unique<Rfc2217>(port_.line().options().settings);
    case world::TcpProtocol::modbus_tcp: break;
  }
  const auto station_of = [this, has_reported = false](std::uint8_t unit, std::uint8_t function) mutable {
    const std::uint8_t station = station_of_unit(unit, address_.gateway, port_.world_line());
    const std::string why = has_reported ? "" : why_unanswered(station, function, port_.world_line());
    if (!why.empty()) {
      has_reported = true;
      log_("a host at " + world::to_string(address_) + " sends requests to unit " + std::to_string(unit) +
           ", " + why);
    }
    return station;
  };
  const bool is_ascii = &port_.world_line().protocol.protocol() == &kModbusAscii;
  return std::make_unique<ModbusTcp>(GatewayRules{.timeout = address_.gateway.timeout,
                                                  .reports_timeout = address_.gateway.reports_timeout,
                                                  .is_ascii = is_ascii,
                                                  .station_of = station_of});
}

// --- clients that connect ------------------------------------------------------------------------

/// Admits a client. A line has only one host, so a second client is refused, or waits while the first one
/// gets its last replies.
void TcpDoor::admit(Descriptor socket) {
  if (is_gateway() && clients_.size() >= kMaxMasters) return refuse();
  if (!is_gateway()) {
    // The first client may just have sent its last bytes, or may have disconnected.
    while (!clients_.empty() && clients_.front()->is_read() && read_from(*clients_.front())) serve_line();
    serve_line();
    if (!clients_.empty()) {
      if (next_ || !clients_.front()->has_finished_sending()) return refuse();
      next_ = std::move(socket);
      return set_timer(kLongestGoodbye);
    }
  }
  if (clients_.empty() && !port_.admit(*this)) return refuse();
  let_in(std::move(socket));
}

void TcpDoor::refuse() {
  ++news_;
  if (port_.is_unplugged())
    return log_("a host tried to connect at " + world::to_string(address_) +
                ", but a fault has unplugged the line; the connection was refused");
  log_(is_gateway() && !clients_.empty()
           ? "the gateway at " + world::to_string(address_) + " has " + std::to_string(kMaxMasters) +
                 " masters, and another tried to connect; the connection was refused"
           : "a second host tried to connect at " + world::to_string(address_) +
                 "; the line allows only one, so the connection was refused");
}

void TcpDoor::let_in(Descriptor socket) {
  TcpClient& client =
      *clients_.emplace_back(std::make_unique<TcpClient>(std::move(socket), make_protocol(), is_gateway()));
  if (!is_on_demand_) {
    loop_.watch(client.socket(), EventLoop::readable,
                [this, &client](std::uint32_t ready) { on_client(client, ready); });
  }
  serve_line();
}

// --- input from clients --------------------------------------------------------------------------

/// Handles input. The loop reports a hang-up only for clients that can no longer receive either.
void TcpDoor::on_client(TcpClient& client, std::uint32_t ready) {
  if ((ready & EventLoop::departed) != 0) {
    let_go(client);
  } else if ((ready & EventLoop::readable) != 0 && client.is_read()) {
    read_from(client);
  }
  serve_line();
}

/// Reads from a client. Returns true if the client has sent something.
bool TcpDoor::read_from(TcpClient& client) {
  const TcpClient::ReadResult result = client.read();
  if (result == TcpClient::ReadResult::nothing) return false;
  if (result == TcpClient::ReadResult::protocol_bytes) return true;
  if (result == TcpClient::ReadResult::foreign_bytes)
    log_("the bytes from a client at " + world::to_string(address_) +
         " are not Modbus TCP; the client is disconnected");
  let_go(client);
  return false;
}

void TcpDoor::attend() {
  if (due_ && port_.now() >= *due_) {
    due_.reset();
    expire();
  }
  bool has_read = true;
  while (has_read) {
    has_read = false;
    for (std::size_t i = 0; i < clients_.size(); ++i) {
      TcpClient& client = *clients_[i];
      if (!client.is_gone() && client.is_read()) has_read = read_from(client) || has_read;
    }
    serve_line();
  }
}

std::uint64_t TcpDoor::news() const {
  std::uint64_t news = news_;
  for (const auto& client : clients_) news += client->sent();
  return news;
}

/// Disconnects a client. The line still serves the bytes that the client has sent. In Modbus TCP, that is one
/// request, because each request waits for the previous one.
void TcpDoor::let_go(TcpClient& client) {
  loop_.unwatch(client.socket());
  if (!is_gateway()) return leave(take_rest(client));
  ++news_;
  client.forget_socket();
  for (const auto& listener : listeners_) listener->try_again();
}

ClientProtocol::Bytes TcpDoor::take_rest(TcpClient& client) {
  ClientProtocol::Bytes rest;
  for (bool continues = true; continues && rest.size() < kMaxLeft;) {
    const ClientProtocol::Bytes some = client.protocol().take_for_line(kOneTaking);
    rest.insert(rest.end(), some.begin(), some.end());
    client.protocol().take_for_client();
    continues = !some.empty() || client.read() == TcpClient::ReadResult::protocol_bytes;
  }
  return rest;
}

// --- the line ------------------------------------------------------------------------------------

bool TcpDoor::waits_for_reply() const {
  return std::ranges::any_of(clients_, [](const auto& client) {
    return client->protocol().patience().has_value() || client->has_rest();
  });
}

/// Puts the next request on the line. Clients take turns. Returns false if there is no request, or if it must
/// wait.
bool TcpDoor::serve_next() {
  if (waits_for_reply()) return false;
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    const std::size_t which = (turn_ + i) % clients_.size();
    ClientProtocol& protocol = clients_[which]->protocol();
    const ClientProtocol::Bytes bytes = protocol.take_for_line(port_.room());
    const bool discards_input = protocol.discards_input();
    const bool discards_output = protocol.discards_output();
    if (discards_input) port_.discard_input();
    if (discards_output) port_.discard_output();
    if (!bytes.empty()) {
      turn_ = which + 1;
      if (is_gateway()) clients_[which]->spoil({});
      const pty::LineSettings line = port_.line().options().settings;
      await_reply(protocol);
      port_.take_from_guest(bytes, protocol.settings().value_or(
                                       pty::HostSettings{.baud = line.baud, .stop_bits = line.stop_bits}));
    }
    if (!bytes.empty() || discards_input || discards_output) return true;
  }
  return false;
}

/// Passes the clients' bytes to the line as far as it has room, and passes the line's output to the clients.
void TcpDoor::serve_line() {
  if (is_serving_) return;
  is_serving_ = true;
  do {
    for (const auto& client : clients_) send_out(*client);
  } while (serve_next());
  is_serving_ = false;
  see_off();
  for (const auto& client : clients_) {
    if (client->is_gone()) continue;
    loop_.change_interest(client->socket(), (client->is_read() ? EventLoop::readable : 0U) |
                                                (client->has_unsent() ? EventLoop::writable : 0U));
  }
}

void TcpDoor::send_out(TcpClient& client) {
  client.send_out();
  if (const auto pause = client.take_pause()) set_timer(std::max(*pause, std::chrono::nanoseconds(1)));
}

void TcpDoor::follow() { serve_line(); }

void TcpDoor::await_reply(const ClientProtocol& protocol) {
  const auto patience = protocol.patience();
  if (!patience) return;
  const auto bits = static_cast<std::int64_t>((protocol.exchange_bytes() + kSilence_bytes) * kBitsOfByte);
  set_timer(*patience +
            std::chrono::nanoseconds(std::chrono::seconds(bits)) / port_.line().options().settings.baud);
}

void TcpDoor::set_timer(std::chrono::nanoseconds time) {
  if (is_on_demand_) {
    due_ = port_.now() + time;
    return;
  }
  itimerspec when{};
  when.it_value.tv_sec = std::chrono::duration_cast<std::chrono::seconds>(time).count();
  when.it_value.tv_nsec = (time % std::chrono::seconds(1)).count();
  timerfd_settime(timer_.get(), 0, &when, nullptr);
}

void TcpDoor::on_timer() {
  std::uint64_t times = 0;
  if (read(timer_.get(), &times, sizeof times) < 0) return;  // meanwhile, the timer was set again
  expire();
}

void TcpDoor::expire() {
  if (next_ && !clients_.empty()) let_go(*clients_.front());
  for (const auto& client : clients_) client->has_rest() ? client->send_rest() : client->protocol().give_up();
  serve_line();
}

/// Takes output from the line. If a client reads more slowly, the line buffers the rest, up to a limit. A
/// gateway takes all bytes, but sends no further request while a reply is pending.
std::size_t TcpDoor::take(std::span<const std::uint8_t> bytes) {
  if (clients_.empty()) return bytes.size();
  if (!is_gateway() && (clients_.front()->has_unsent() || !clients_.front()->protocol().listens())) return 0;
  for (const auto& client : clients_) {
    client->protocol().receive_from_line(bytes);
    send_out(*client);
  }
  return bytes.size();
}

// --- clients that leave --------------------------------------------------------------------------

/// Returns true if a client that sends no more has received all replies.
bool TcpDoor::has_all(const TcpClient& client) const {
  if (client.has_unsent() || client.has_rest()) return false;
  if (is_gateway()) return client.protocol().is_idle();
  // A client that does not listen now will not receive anything later.
  return port_.room() > 0 && (port_.is_quiet() || !client.protocol().listens());
}

void TcpDoor::see_off() {
  const auto is_done = [this](const auto& client) {
    const bool has_gone = client->hangs_up() && !client->has_unsent();
    return has_gone || ((client->is_gone() || client->has_finished_sending()) && has_all(*client));
  };
  if (std::ranges::none_of(clients_, is_done)) return;
  for (const auto& client : clients_) {
    if (!is_done(client)) continue;
    news_ += client->sent() + 1;
    if (!client->is_gone()) loop_.unwatch(client->socket());
  }
  std::erase_if(clients_, is_done);
  if (clients_.empty()) return leave({});
  for (const auto& listener : listeners_) listener->try_again();
}

// --- faults --------------------------------------------------------------------------------------

/// Applies a fault to the reply to a gateway's pending request, or else to the next output of the line.
void TcpDoor::spoil(const world::Fault& fault) {
  using Kind = world::Fault::Kind;
  for (const auto& client : clients_) {
    if (is_gateway() && !client->protocol().patience()) continue;
    Spoiling spoiling = client->spoiling();
    const auto size = static_cast<std::size_t>(fault.amount);
    if (fault.kind == Kind::hang_up) spoiling.hangs_up_after = size;
    if (is_gateway() && fault.kind == Kind::wrong_transaction) spoiling.has_wrong_transaction = true;
    if (is_gateway() && fault.kind == Kind::wrong_unit) spoiling.has_wrong_unit = true;
    if (is_gateway() && fault.kind == Kind::split) {
      spoiling.split_at = size;
      spoiling.split_for = time_of(fault.over_ticks);
    }
    client->spoil(spoiling);
  }
}

void TcpDoor::hang_up() {
  for (const auto& client : clients_) loop_.unwatch(client->socket());
  next_.close();
  leave({});
}

/// Releases the line after the last client has left.
void TcpDoor::leave(const ClientProtocol::Bytes& last) {
  news_ = news() + 1;
  clients_.clear();
  port_.leave(last);
  for (const auto& listener : listeners_) listener->try_again();
  if (next_) admit(std::exchange(next_, {}));
}

}  // namespace understudy::emulator::serve
