#pragma once

#include <optional>
#include <string>

namespace understudy::emulator {

/// The bytes of a file; nothing if there is none, or it cannot be read.
std::optional<std::string> read_text_file(const std::string& path);

/// Puts a file there as a whole, in place of what was there: written beside it and on the disk before it gets
/// its name. 0, or the error (errno), and what was there stays.
int replace_text_file(const std::string& path, const std::string& contents);

}  // namespace understudy::emulator
