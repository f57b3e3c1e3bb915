// Where a line can be reached by TCP, as a user writes it: "rfc2217://127.0.0.1:5020", and how a gateway
// behaves there: "modbus-tcp://:5020?timeout=200ms". What is spoken there is docs/network.md.
#pragma once

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace understudy::emulator::world {

/// What a client speaks: the serial line's own bytes; those and its settings; or Modbus TCP.
enum class TcpProtocol : std::uint8_t { rtu, rfc2217, modbus_tcp };

/// How the gateway behaves behind which a line is reached by Modbus TCP.
struct GatewaySettings {
  static constexpr int kAnyUnit = -1;
  static constexpr int kOnlyStation = 0;
  /// How long a station may take to answer, besides the time on the wire.
  std::chrono::milliseconds timeout{1000};
  /// Whether a master is told, by exception 11, that a station has not answered.
  bool tells = true;
  /// The station that unit 255 stands for; kOnlyStation: the one that stands there, if it is the only one;
  /// kAnyUnit: as before, and whatever unit is asked.
  int unit = kOnlyStation;

  bool operator==(const GatewaySettings&) const = default;
};

/// A port number 0: any free one.
struct TcpAddress {
  TcpProtocol protocol = TcpProtocol::rtu;
  std::string host;  // a name, or a numeric address, that of IPv6 without its brackets
  int port = 0;
  GatewaySettings gateway{};
};

inline constexpr std::string_view kListeningExpected =
    "expected rtu://HOST:PORT, rfc2217://HOST:PORT or modbus-tcp://HOST:PORT, such as rtu://127.0.0.1:5020";

/// What is wrong with an address, and what was expected: "has port 99999; expected 0 to 65535".
struct ListeningError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Without a host it is 127.0.0.1. Throws ListeningError.
TcpAddress parse_tcp_address(std::string_view text);
/// "rtu://127.0.0.1:5020", "rtu://[::1]:5020"; without its settings.
std::string to_string(const TcpAddress& address);

/// Whether two of them cannot both be listened at.
inline bool is_same_place(const TcpAddress& a, const TcpAddress& b) {
  return a.port != 0 && a.port == b.port && a.host == b.host;
}

}  // namespace understudy::emulator::world
