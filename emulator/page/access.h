// Decides which requests the page accepts. The loopback interface is no protection: other users of the
// machine reach it, and so does every web page open in the user's browser, through a name that resolves to
// 127.0.0.1. So a request must name a host from the list, a WebSocket must come from one of our pages, and
// its first message must contain the token of this run.
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

/// Names a host such as "localhost:8080". The text is parsed completely, not only compared by its beginning.
struct HostName {
  std::string name;  // in lower case; an IPv6 address without its brackets
  std::uint16_t port = 80;
  bool operator==(const HostName&) const = default;
};
/// Returns nothing if the text is not a host, for example if it has user names, paths, spaces, ports beyond
/// 65535, or empty names.
std::optional<HostName> parse_host(std::string_view text);

struct WebAccess {
  std::vector<HostName> hosts;
  bool admits_host(std::string_view host) const;
  /// Returns true if pages from this origin are accepted. It is a text such as "http://localhost:8080".
  bool admits_origin(std::string_view origin) const;
};

/// Returns the access that accepts the loopback's names at that port, and the other names that the user has
/// given.
WebAccess access_of(const WebAddress& address, const std::vector<std::string>& other_names);

/// Returns 128 random bits from the system, in hexadecimal digits.
std::string make_token();
/// Compares a given text with the token in constant time.
bool is_token(std::string_view given, std::string_view token);

}  // namespace understudy::emulator::page
