// Parses the TCP addresses of a line in the form that users write: "rfc2217://127.0.0.1:5020". For a gateway,
// settings can follow: "modbus-tcp://:5020?timeout=200ms". docs/network.md describes the protocols.
#pragma once

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace understudy::emulator::world {

/// The protocol of a client: plain serial bytes, serial bytes with line settings, or Modbus TCP.
enum class TcpProtocol : std::uint8_t { rtu, rfc2217, modbus_tcp };

/// Settings of the gateway between Modbus TCP clients and a line.
struct GatewaySettings {
  static constexpr int kAnyUnit = -1;
  static constexpr int kOnlyStation = 0;
  /// How long a station may take to answer, excluding the transmission time.
  std::chrono::milliseconds timeout{1000};
  /// If true, the gateway answers with exception 11 when a station does not answer.
  bool reports_timeout = true;
  /// The station for unit 255. With kOnlyStation, it is the station on the line, if there is only one. With
  /// kAnyUnit, it is that station for all units.
  int unit = kOnlyStation;

  bool operator==(const GatewaySettings&) const = default;
};

/// An address at which a line listens. Port number 0 means any free port.
struct TcpAddress {
  TcpProtocol protocol = TcpProtocol::rtu;
  std::string host;  // a name or a numeric address; IPv6 addresses have no brackets
  int port = 0;
  GatewaySettings gateway{};
};

inline constexpr std::string_view kListeningExpected =
    "expected rtu://HOST:PORT, rfc2217://HOST:PORT or modbus-tcp://HOST:PORT, such as rtu://127.0.0.1:5020";

/// Thrown for an invalid address. The message contains what is wrong and what was expected: "has port 99999;
/// expected 0 to 65535".
struct ListeningError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Without a host, the address is 127.0.0.1. Throws ListeningError.
TcpAddress parse_tcp_address(std::string_view text);
/// Returns "rtu://127.0.0.1:5020" or "rtu://[::1]:5020", without settings.
std::string to_string(const TcpAddress& address);

/// Returns true if a program cannot listen on both addresses at the same time.
inline bool is_same_place(const TcpAddress& a, const TcpAddress& b) {
  return a.port != 0 && a.port == b.port && a.host == b.host;
}

}  // namespace understudy::emulator::world
