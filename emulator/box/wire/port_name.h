// Parses the place where a real controller is reached, as a user writes it: a serial port of this machine
// ("/dev/ttyUSB0,19200,8E1"), or one behind TCP ("rtu://HOST:PORT", "rfc2217://HOST:PORT,9600",
// "modbus-tcp://HOST:PORT").
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "emulator/world/bench/listening.h"
#include "pty/line_settings.h"

namespace understudy::emulator::box {

/// Thrown for a bad text. The message says what was expected.
struct PortNameError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct PortName {
  std::string place;  // without settings
  std::optional<world::TcpAddress> tcp{};
  // The user's settings; the model has the rest.
  std::optional<int> baud{};
  std::optional<pty::LineSettings> framing{};  // data bits, parity and stop bits

  /// Returns true if speed and framing can be set from here.
  bool has_settings() const { return !tcp || tcp->protocol == world::TcpProtocol::rfc2217; }
  bool is_modbus_tcp() const { return tcp && tcp->protocol == world::TcpProtocol::modbus_tcp; }
};

/// Throws PortNameError.
PortName parse_port_name(std::string_view text);

}  // namespace understudy::emulator::box
