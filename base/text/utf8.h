// Text in UTF-8.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace understudy {

/// The place of the first byte that is not a part of a well-formed character (RFC 3629); nothing if all are.
std::optional<std::size_t> first_not_utf8(std::string_view text);

}  // namespace understudy
