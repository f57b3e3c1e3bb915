// A port's second way in: one TCP client at a time, whose bytes (or, of Modbus TCP, requests) are those of a
// host that has opened the pseudo-terminal. So recordings, captures and wire time are the same for both.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/files/descriptor.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/ports/modbus_tcp.h"
#include "emulator/serve/ports/port.h"
#include "pty/line_settings.h"

namespace understudy::emulator::serve {

/// What a client speaks: the serial line's own bytes, or Modbus TCP.
enum class TcpProtocol : std::uint8_t { rtu, modbus_tcp };

/// Where to listen: a numeric IPv4 address and a port number; 0: any free one.
struct TcpAddress {
  TcpProtocol protocol = TcpProtocol::rtu;
  std::string host;
  int port = 0;
};

class TcpDoor {
 public:
  /// `settings` are the line's: raw bytes do not tell what a host has set. Throws pty::PortError.
  TcpDoor(EventLoop& loop, const Port& port, const pty::LineSettings& settings, const TcpAddress& address,
          std::function<void(const std::string&)> log);
  ~TcpDoor();
  TcpDoor(const TcpDoor&) = delete;
  TcpDoor& operator=(const TcpDoor&) = delete;

  /// "127.0.0.1:5020".
  std::string address() const;

 private:
  /// What one side has sent and the other has not taken yet: at most one reading. Until it is gone, no more
  /// is read.
  using Pending = std::vector<std::uint8_t>;

  void admit();
  void begin(Descriptor client);
  void end();
  bool read_into(Pending& pending, int descriptor);
  bool write_out(Pending& pending, int descriptor);
  void carry(Pending& pending, int from, int to);
  bool wants_to_hear(const Pending& pending) const;
  bool translate(Pending& heard);
  bool hand_on_translated();
  void await_reply();
  void follow_interest();

  EventLoop& loop_;
  const Port& port_;
  pty::LineSettings settings_;
  TcpAddress address_;
  std::function<void(const std::string&)> log_;
  Descriptor listener_;
  Descriptor client_;    // none: nobody is connected
  Descriptor terminal_;  // opened for the client, as a host would
  Pending to_line_;
  Pending to_client_;
  std::optional<ModbusTcp> modbus_;  // what stands between the two; none: raw bytes
  Descriptor timer_;                 // ends the time for a reply
  WallTime last_end_{0};             // when the last client went
};

}  // namespace understudy::emulator::serve
