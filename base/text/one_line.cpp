#include "base/text/one_line.h"

#include <array>
#include <cstdio>
#include <string>
#include <string_view>

namespace understudy {

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7F) {
      line += c;
    } else if (c == '\n') {
      line += "\\n";
    } else {
      std::array<char, 8> escaped{};
      std::snprintf(escaped.data(), escaped.size(), "\\x%02X", byte);
      line += escaped.data();
    }
  }
  return line;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  return "'" + one_line(text.substr(0, kLongest)) + (text.size() > kLongest ? "..." : "") + "'";
}

}  // namespace understudy
