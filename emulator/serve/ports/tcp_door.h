// A port's second entrance: TCP clients act as the line's host as if they had opened a pseudo-terminal. So
// recordings, captures and wire time are the same for both. A line has one host: one client, or a gateway
// whose clients take turns.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/listener.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/tcp_client.h"
#include "emulator/serve/ports/tcp_speech.h"
#include "emulator/world/bench/listening.h"

namespace understudy::emulator::serve {

class TcpDoor final : private Port::Guest {
 public:
  static constexpr std::size_t kMaxMasters = 32;

  /// The port must outlive it, and is given the address. Throws pty::PortError.
  TcpDoor(EventLoop& loop, Port& port, const world::TcpAddress& address,
          std::function<void(const std::string&)> log);
  /// After this, clients are not notified any more that they have gone.
  ~TcpDoor() override;
  TcpDoor(const TcpDoor&) = delete;
  TcpDoor& operator=(const TcpDoor&) = delete;

  /// Takes a connected socket.
  void admit(Descriptor socket);

 private:
  std::size_t take(std::span<const std::uint8_t> bytes) override;
  void follow() override;
  void spoil(const world::Fault& fault) override;
  void hang_up() override;

  bool is_gateway() const { return address_.protocol == world::TcpProtocol::modbus_tcp; }
  std::unique_ptr<TcpSpeech> make_speech();
  void let_in(Descriptor socket);
  void refuse();
  void on_client(TcpClient& client, std::uint32_t ready);
  bool hear(TcpClient& client);
  void let_go(TcpClient& client);
  void on_timer();
  void set_timer(std::chrono::nanoseconds time);
  bool waits_for_reply() const;
  bool serve_next();
  void serve_line();
  void send_out(TcpClient& client);
  void await_reply(const TcpSpeech& speech);
  bool has_all(const TcpClient& client) const;
  void see_off();
  void leave(const TcpSpeech::Bytes& last);
  TcpSpeech::Bytes take_rest(TcpClient& client);

  EventLoop& loop_;
  Port& port_;
  world::TcpAddress address_;
  std::function<void(const std::string&)> log_;
  Descriptor timer_;  // ends the time for a reply, or for a client that has sent everything
  std::vector<std::unique_ptr<TcpClient>> clients_;
  std::size_t turn_ = 0;     // the client whose request is next
  Descriptor next_;          // a client that waits until a finished one has its replies
  bool is_serving_ = false;  // the line speaks while it is spoken to
  std::vector<std::unique_ptr<Listener>> listeners_;
};

}  // namespace understudy::emulator::serve
