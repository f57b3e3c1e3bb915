#include "emulator/world/bench/listening.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/text/parse_integer.h"

namespace understudy::emulator::world {

namespace {

struct Scheme {
  std::string_view text;
  TcpProtocol protocol;
};
constexpr std::array kSchemes{Scheme{"rtu://", TcpProtocol::rtu}, Scheme{"rfc2217://", TcpProtocol::rfc2217},
                              Scheme{"modbus-tcp://", TcpProtocol::modbus_tcp}};
constexpr int kLastTcpPort = 65'535;

}  // namespace

std::optional<TcpAddress> parse_tcp_address(std::string_view text) {
  const auto* const scheme =
      std::ranges::find_if(kSchemes, [&](const Scheme& row) { return text.starts_with(row.text); });
  if (scheme == kSchemes.end()) return std::nullopt;
  const std::string_view place = text.substr(scheme->text.size());
  const std::size_t colon = place.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto port = parse_integer(place.substr(colon + 1));
  if (!port || *port < 0 || *port > kLastTcpPort) return std::nullopt;
  return TcpAddress{.protocol = scheme->protocol,
                    .host = colon == 0 ? "127.0.0.1" : std::string(place.substr(0, colon)),
                    .port = static_cast<int>(*port)};
}

std::string to_string(const TcpAddress& address) {
  const auto* const scheme = std::ranges::find(kSchemes, address.protocol, &Scheme::protocol);
  return std::string(scheme->text) + address.host + ":" + std::to_string(address.port);
}

bool is_numeric(const std::string& host) {
  in_addr ignored{};
  return inet_pton(AF_INET, host.c_str(), &ignored) == 1;
}

}  // namespace understudy::emulator::world
