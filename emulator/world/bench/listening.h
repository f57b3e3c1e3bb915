// Where a line can be reached by TCP, as a user writes it: "rfc2217://127.0.0.1:5020". What is spoken there
// is docs/network.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy::emulator::world {

/// What a client speaks: the serial line's own bytes; those and its settings; or Modbus TCP.
enum class TcpProtocol : std::uint8_t { rtu, rfc2217, modbus_tcp };

/// A numeric IPv4 address and a port number; 0: any free one.
struct TcpAddress {
  TcpProtocol protocol = TcpProtocol::rtu;
  std::string host;
  int port = 0;
};

inline constexpr std::string_view kListeningExpected =
    "expected rtu://HOST:PORT, rfc2217://HOST:PORT or modbus-tcp://HOST:PORT, such as rtu://127.0.0.1:5020";

/// Without a host it is 127.0.0.1. Nothing if it is written otherwise.
std::optional<TcpAddress> parse_tcp_address(std::string_view text);
/// "rtu://127.0.0.1:5020"
std::string to_string(const TcpAddress& address);

bool is_numeric(const std::string& host);

}  // namespace understudy::emulator::world
