#include "base/state/difference.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace understudy::state_fields {

std::string difference_text(const std::string& path, const std::string& what) {
  return path.empty() ? what : path + ": " + what;
}

std::string difference_text(const std::string& path, const std::string& a, const std::string& b) {
  return difference_text(path, a + " against " + b);
}

std::string path_to(const std::string& path, std::string_view name) {
  std::string longer = path;
  if (!longer.empty()) longer += '.';
  return longer += name;
}

std::string path_to_element(const std::string& path, const std::string& name) {
  return path + "[" + name + "]";
}

std::string text_in_quotes(std::string_view text) {
  std::string shown = "\"";
  for (const char each : text) {
    const bool is_shown = each >= ' ' && each <= '~' && each != '"' && each != '\\';
    std::array<char, 8> code{};
    if (!is_shown) std::snprintf(code.data(), code.size(), "\\x%02x", static_cast<unsigned char>(each));
    shown += is_shown ? std::string(1, each) : std::string(code.data());
  }
  return shown + "\"";
}

std::string number_text(std::int64_t value) { return std::to_string(value); }
std::string number_text(std::uint64_t value) { return std::to_string(value); }
std::string number_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

}  // namespace understudy::state_fields
