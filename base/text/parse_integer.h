#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace understudy {

/// Parses a whole number as people write it in files and on the command line: "12", "-12", "0x0C", "-0x0C".
/// Returns nothing for any other text, or if the number does not fit 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view text);

}  // namespace understudy
