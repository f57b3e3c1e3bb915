#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace understudy {

/// "12", "-12", "0x0C", "-0x0C": a whole number as people write it in files and on the command line. Nothing
/// for anything else, or if 64 bits do not hold it.
std::optional<std::int64_t> parse_integer(std::string_view text);

}  // namespace understudy
