#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace understudy {

/// The largest file that is read as a whole: far above any bench, trace or snapshot.
inline constexpr std::size_t kMostTextBytes = std::size_t{64} << 20;

/// The bytes of a file; nothing if there is none, or it cannot be read.
struct FileText : std::optional<std::string> {
  std::string why{};  // where there is nothing, for messages: "cannot be read (Permission denied)"
};

/// Only a regular file is read, up to kMostTextBytes: a pipe would be waited for without end, and a device
/// may never come to its own.
FileText read_text_file(const std::string& path);
/// The same of what is open already, up to its end: standard input, say.
FileText read_text_of(int descriptor);

/// The same for what is read piece by piece, of any length: empty if it is a regular file.
std::string why_not_readable(const std::string& path);

/// Puts a file there as a whole, in place of what was there: written beside it, under a name that is free,
/// and on the disk before it gets its own. base/files/output_file.h has what may be replaced. Empty, or else
/// why it could not be, and what was there stays.
std::string replace_text_file(const std::string& path, const std::string& contents);

}  // namespace understudy
