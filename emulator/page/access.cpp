#include "emulator/page/access.h"

#include <sys/random.h>
#include <sys/types.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace understudy::emulator::page {

namespace {

bool is_of_name(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '.' || letter == '-' ||
         letter == '_';
}

bool is_of_address(char letter) {
  return std::isxdigit(static_cast<unsigned char>(letter)) != 0 || letter == ':' || letter == '.';
}

}  // namespace

std::optional<HostName> parse_host(std::string_view text) {
  HostName host;
  std::size_t end = 0;
  if (text.starts_with('[')) {
    end = text.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    host.name = text.substr(1, end - 1);
    if (!std::all_of(host.name.begin(), host.name.end(), is_of_address)) return std::nullopt;
    ++end;
  } else {
    end = std::min(text.find(':'), text.size());
    host.name = text.substr(0, end);
    if (!std::all_of(host.name.begin(), host.name.end(), is_of_name)) return std::nullopt;
  }
  if (host.name.empty() || host.name.size() > 253) return std::nullopt;
  for (char& letter : host.name) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  const std::string_view rest = text.substr(end);
  if (rest.empty()) return host;
  if (rest.size() < 2 || rest.front() != ':') return std::nullopt;
  const char* const last = rest.data() + rest.size();
  const auto [parsed, error] = std::from_chars(rest.data() + 1, last, host.port);
  if (error != std::errc{} || parsed != last) return std::nullopt;
  return host;
}

bool WebAccess::admits_host(std::string_view host) const {
  const auto parsed = parse_host(host);
  return parsed && std::find(hosts.begin(), hosts.end(), *parsed) != hosts.end();
}

bool WebAccess::admits_origin(std::string_view origin) const {
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && admits_host(origin.substr(kScheme.size()));
}

WebAccess access_of(const WebAddress& address, const std::vector<std::string>& other_names) {
  WebAccess access;
  for (const char* name : {"127.0.0.1", "localhost", "::1"}) access.hosts.push_back({name, address.port});
  for (const std::string& name : other_names) {
    if (auto host = parse_host(
            name.find(':') != std::string::npos && !name.starts_with('[') ? "[" + name + "]" : name)) {
      access.hosts.push_back({host->name, address.port});
    }
  }
  return access;
}

std::string make_token() {
  std::array<unsigned char, 16> bytes{};
  std::size_t count = 0;
  while (count < bytes.size()) {
    const ssize_t got = getrandom(bytes.data() + count, bytes.size() - count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::system_error(errno, std::generic_category(), "getrandom");
    count += static_cast<std::size_t>(got);
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

bool is_token(std::string_view given, std::string_view token) {
  if (given.size() != token.size()) return false;
  unsigned differs = 0;
  for (std::size_t i = 0; i < token.size(); ++i) {
    differs |= static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(token[i]);
  }
  return differs == 0;
}

}  // namespace understudy::emulator::page
