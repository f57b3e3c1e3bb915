#pragma once

#include <optional>
#include <string>

namespace understudy::emulator {

/// The bytes of a file; nothing if there is none, or it cannot be read.
std::optional<std::string> read_text_file(const std::string& path);

}  // namespace understudy::emulator
