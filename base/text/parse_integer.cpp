#include "base/text/parse_integer.h"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace understudy {

std::optional<std::int64_t> parse_integer(std::string_view text) {
  const bool negative = text.starts_with("-");
  if (negative) text.remove_prefix(1);
  const bool hexadecimal = text.starts_with("0x");
  if (hexadecimal) text.remove_prefix(2);
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value, hexadecimal ? 16 : 10);
  // from_chars would accept a second sign.
  if (text.starts_with("-") || error != std::errc{} || parsed != end) return std::nullopt;
  return negative ? -value : value;
}

}  // namespace understudy
