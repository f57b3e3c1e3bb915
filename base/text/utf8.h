// Checks that text is valid UTF-8.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace understudy {

/// Returns the position of the first byte that is not part of a well-formed character (RFC 3629), or nothing
/// if all are.
std::optional<std::size_t> first_not_utf8(std::string_view text);

}  // namespace understudy
