#include "emulator/world/bench/listening.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/suggestion.h"

namespace understudy::emulator::world {

namespace {

struct Scheme {
  std::string_view text;
  TcpProtocol protocol;
};
constexpr std::array kSchemes{Scheme{"rtu://", TcpProtocol::rtu}, Scheme{"rfc2217://", TcpProtocol::rfc2217},
                              Scheme{"modbus-tcp://", TcpProtocol::modbus_tcp}};
constexpr int kLastTcpPort = 65'535;
constexpr int kLastStation = 247;
constexpr std::chrono::milliseconds kLongestTimeout = std::chrono::hours(1);

[[noreturn]] void not_an_address() {
  throw ListeningError("is not an address; " + std::string(kListeningExpected));
}

/// A setting of a gateway, written after the address: "?timeout=200ms&unit=2".
struct SettingRow {
  std::string_view name;
  std::string_view expected;
  // Returns false if the value is not valid.
  bool (*set)(GatewaySettings& gateway, std::string_view value);
};

bool set_timeout(GatewaySettings& gateway, std::string_view value) {
  const auto time = value == "0" ? SimTime{0} : parse_duration(value);
  if (time == SimTime{0}) {
    gateway.reports_timeout = false;
    return true;
  }
  if (!time || *time < std::chrono::milliseconds(1) || *time > kLongestTimeout) return false;
  gateway.timeout = std::chrono::duration_cast<std::chrono::milliseconds>(*time);
  return true;
}

bool set_exception(GatewaySettings& gateway, std::string_view value) {
  if (value != "on" && value != "off") return false;
  gateway.reports_timeout = value == "on";
  return true;
}

bool set_unit(GatewaySettings& gateway, std::string_view value) {
  if (value == "any") {
    gateway.unit = GatewaySettings::kAnyUnit;
    return true;
  }
  const auto number = parse_integer(value);
  if (!number || *number < 1 || *number > kLastStation) return false;
  gateway.unit = static_cast<int>(*number);
  return true;
}

constexpr std::array kSettings{
    SettingRow{"timeout", "a duration of 1ms to 1h such as 200ms, or 0 for no reply", set_timeout},
    SettingRow{"exception", "on or off", set_exception},
    SettingRow{"unit", "the number of a station, 1 to 247, or any", set_unit}};

void read_setting(GatewaySettings& gateway, std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string name(text.substr(0, equals));
  const auto* const row = std::ranges::find(kSettings, name, &SettingRow::name);
  if (row == kSettings.end()) {
    std::vector<std::string> known;
    for (const SettingRow& each : kSettings) known.emplace_back(each.name);
    throw ListeningError("has " + quoted(name) + ", which is not a setting" + suggestion(name, known));
  }
  const std::string value(equals == std::string_view::npos ? "" : text.substr(equals + 1));
  if (!row->set(gateway, value))
    throw ListeningError("has " + name + " " + quoted(value) + "; expected " + std::string(row->expected));
}

int read_port(std::string_view text) {
  const auto port = parse_integer(text);
  if (!port) not_an_address();
  if (*port < 0 || *port > kLastTcpPort)
    throw ListeningError("has port " + one_line(std::string(text)) + "; expected 0 to 65535");
  return static_cast<int>(*port);
}

/// Returns the host, or the default. The brackets of an IPv6 address are removed; '%' and an interface may
/// follow the address.
std::string read_host(std::string_view text) {
  if (text.empty()) return "127.0.0.1";
  if (text.starts_with('[')) {
    if (!text.ends_with(']')) not_an_address();
    const std::string host(text.substr(1, text.size() - 2));
    in6_addr ignored{};
    if (inet_pton(AF_INET6, host.substr(0, host.find('%')).c_str(), &ignored) != 1) not_an_address();
    return host;
  }
  if (text.find(':') != std::string_view::npos)
    throw ListeningError("has an IPv6 address without brackets; expected it as in rtu://[::1]:5020");
  const bool is_plain = std::ranges::none_of(text, [](char c) { return c <= ' ' || c == '/' || c == '@'; });
  if (!is_plain) not_an_address();
  return std::string(text);
}

}  // namespace

TcpAddress parse_tcp_address(std::string_view text) {
  const auto* const scheme =
      std::ranges::find_if(kSchemes, [&](const Scheme& row) { return text.starts_with(row.text); });
  if (scheme == kSchemes.end()) not_an_address();
  std::string_view place = text.substr(scheme->text.size());
  const std::size_t mark = place.find('?');
  TcpAddress address{.protocol = scheme->protocol, .host = {}};
  if (mark != std::string_view::npos) {
    if (address.protocol != TcpProtocol::modbus_tcp)
      throw ListeningError("has gateway settings; expected them only with modbus-tcp://");
    std::vector<std::string_view> given;
    for (std::string_view rest = place.substr(mark + 1); !rest.empty();) {
      const std::size_t end = std::min(rest.find('&'), rest.size());
      const std::string_view setting = rest.substr(0, end);
      given.push_back(setting.substr(0, setting.find('=')));
      if (std::ranges::count(given, given.back()) > 1)
        throw ListeningError("has " + std::string(given.back()) + " twice; expected it only once");
      read_setting(address.gateway, setting);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    place = place.substr(0, mark);
  }
  const std::size_t colon = place.rfind(':');
  if (colon == std::string_view::npos || place.ends_with(']')) not_an_address();
  address.port = read_port(place.substr(colon + 1));
  address.host = read_host(place.substr(0, colon));
  return address;
}

std::string to_string(const TcpAddress& address) {
  const auto* const scheme = std::ranges::find(kSchemes, address.protocol, &Scheme::protocol);
  const bool is_ipv6 = address.host.find(':') != std::string::npos;
  return std::string(scheme->text) + (is_ipv6 ? "[" + address.host + "]" : address.host) + ":" +
         std::to_string(address.port);
}

}  // namespace understudy::emulator::world
