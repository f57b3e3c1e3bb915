// Decimal numbers as people write them: "-12", "0.5", "1e-3".
#pragma once

#include <optional>
#include <string_view>

namespace understudy {

/// The nearest double; nothing if it is not a number, or beyond all doubles.
std::optional<double> parse_real(std::string_view text);

}  // namespace understudy
