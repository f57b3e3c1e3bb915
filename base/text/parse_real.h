// Decimal numbers as people write them: "-12", "0.5", "1e-3".
#pragma once

#include <optional>
#include <string_view>

namespace understudy {

/// Returns the nearest double, or nothing if the text is not a number or is out of range.
std::optional<double> parse_real(std::string_view text);

}  // namespace understudy
