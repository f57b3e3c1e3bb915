// A port's TCP access: clients act as the line's host as if they had opened a pseudo-terminal. Therefore
// recordings, captures and transmission times are the same for both. A line has one host: either a single
// client, or a gateway whose clients take turns.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/listener.h"
#include "emulator/serve/ports/client_protocol.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/tcp_client.h"
#include "emulator/world/bench/listening.h"

namespace understudy::emulator::serve {

class TcpDoor final : private Port::Guest {
 public:
  static constexpr std::size_t kMaxMasters = 32;

  /// A door on demand serves a host in simulated time: nobody listens at the address, clients are passed to
  /// admit(), their bytes are read only by attend(), and its timeouts are in simulated time.
  enum class Service : std::uint8_t { at_once, on_demand };
  /// Adds the address to the port, which must outlive this object. Throws pty::PortError.
  TcpDoor(EventLoop& loop, Port& port, const world::TcpAddress& address,
          std::function<void(const std::string&)> log, Service service = Service::at_once);
  ~TcpDoor() override;
  TcpDoor(const TcpDoor&) = delete;
  TcpDoor& operator=(const TcpDoor&) = delete;

  /// Admits the client on a connected socket.
  void admit(Descriptor socket);

  const world::TcpAddress& address() const { return address_; }
  const Port& port() const { return port_; }
  /// Reads the bytes that the clients have sent, and sends pending output to them.
  void attend();
  /// Returns when to call attend() even if nobody sends, or nothing.
  std::optional<SimTime> due() const { return due_; }
  /// Returns a number that changes when something was sent to a client, or a client disconnected.
  std::uint64_t news() const;

 private:
  std::size_t take(std::span<const std::uint8_t> bytes) override;
  void follow() override;
  void spoil(const world::Fault& fault) override;
  void hang_up() override;

  bool is_gateway() const { return address_.protocol == world::TcpProtocol::modbus_tcp; }
  std::unique_ptr<ClientProtocol> make_protocol();
  void let_in(Descriptor socket);
  void refuse();
  void on_client(TcpClient& client, std::uint32_t ready);
  bool read_from(TcpClient& client);
  void let_go(TcpClient& client);
  void on_timer();
  void expire();
  void set_timer(std::chrono::nanoseconds time);
  bool waits_for_reply() const;
  bool serve_next();
  void serve_line();
  void send_out(TcpClient& client);
  void await_reply(const ClientProtocol& protocol);
  bool has_all(const TcpClient& client) const;
  void see_off();
  void leave(const ClientProtocol::Bytes& last);
  ClientProtocol::Bytes take_rest(TcpClient& client);

  EventLoop& loop_;
  Port& port_;
  world::TcpAddress address_;
  std::function<void(const std::string&)> log_;
  bool is_on_demand_;
  Descriptor timer_;            // ends the wait for a reply, or for a client that sends no more
  std::optional<SimTime> due_;  // the end of the same wait, for a door on demand
  std::uint64_t news_ = 0;      // the sum for clients that have left
  std::vector<std::unique_ptr<TcpClient>> clients_;
  std::size_t turn_ = 0;     // the index of the client whose request is next
  Descriptor next_;          // a client that waits until another one has its last replies
  bool is_serving_ = false;  // serve_line() is running; the line may send during that time
  std::vector<std::unique_ptr<Listener>> listeners_;
};

}  // namespace understudy::emulator::serve
