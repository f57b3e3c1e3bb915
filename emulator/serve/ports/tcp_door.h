// A port's second way in: one TCP client at a time, who is the line's host as if it had opened a
// pseudo-terminal. So recordings, captures and wire time are the same for both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/ports/port.h"
#include "emulator/serve/ports/tcp_speech.h"
#include "emulator/world/bench/listening.h"

namespace understudy::emulator::serve {

class TcpDoor final : private Port::Guest {
 public:
  /// The port must outlive it; it is told where the door listens. Throws pty::PortError.
  TcpDoor(EventLoop& loop, Port& port, const world::TcpAddress& address,
          std::function<void(const std::string&)> log);
  /// Nobody is told any more that a client has gone.
  ~TcpDoor() override;
  TcpDoor(const TcpDoor&) = delete;
  TcpDoor& operator=(const TcpDoor&) = delete;

 private:
  std::size_t take(std::span<const std::uint8_t> bytes) override;
  void follow() override;

  void admit();
  void on_client(std::uint32_t ready);
  bool read_client();
  bool read_rest();
  void send_out();
  void serve_line();
  void await_reply();
  void end();
  void forget_client();

  EventLoop& loop_;
  Port& port_;
  world::TcpAddress address_;
  std::function<void(const std::string&)> log_;
  Descriptor listener_;
  Descriptor client_;                  // none: nobody is connected
  std::unique_ptr<TcpSpeech> speech_;  // while somebody is
  TcpSpeech::Bytes unsent_;            // what the client has not taken yet: as much as came at once
  bool is_serving_ = false;            // the line speaks while it is spoken to
  Descriptor timer_;                   // ends the time for a reply
};

}  // namespace understudy::emulator::serve
