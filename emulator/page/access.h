// Who may ask the page anything. The loopback is no boundary: other users of the machine reach it, and so
// does every web page that is open in the user's browser, by a name that turns out to mean 127.0.0.1. So a
// request must name a host of the list, a WebSocket must come from a page of ours, and its first message must
// bring the token of this run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::page {

struct WebAddress {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;
};

/// "localhost:8080": parsed, not compared by its beginning.
struct HostName {
  std::string name;  // in lower case; an IPv6 address without its brackets
  std::uint16_t port = 80;
  bool operator==(const HostName&) const = default;
};
/// Nothing for what is none: user names, paths, spaces, ports beyond 65535, empty names.
std::optional<HostName> parse_host(std::string_view text);

struct WebAccess {
  std::vector<HostName> hosts;
  bool admits_host(std::string_view host) const;
  /// "http://localhost:8080".
  bool admits_origin(std::string_view origin) const;
};

/// The loopback's names at that port, and others that the user has named.
WebAccess access_of(const WebAddress& address, const std::vector<std::string>& other_names);

/// 128 bits from the system, in hexadecimal digits.
std::string make_token();
/// In a time that does not tell how much of it is right.
bool is_token(std::string_view given, std::string_view token);

}  // namespace understudy::emulator::page
