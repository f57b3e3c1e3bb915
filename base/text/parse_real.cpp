#include "base/text/parse_real.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace understudy {

std::optional<double> parse_real(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || error != std::errc{} || parsed != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace understudy
