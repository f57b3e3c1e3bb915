// Encodes bytes for text files: base64 (RFC 4648), with padding, on one line.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace understudy {

std::string to_base64(std::span<const std::byte> bytes);
/// Returns nothing for text that to_base64() cannot produce.
std::optional<std::vector<std::byte>> from_base64(std::string_view text);

}  // namespace understudy
