#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "base/files/content_kind.h"

namespace understudy {

/// The size limit for files that are read as a whole, far above any bench, trace or snapshot.
inline constexpr std::size_t kMaxTextBytes = std::size_t{64} << 20;

/// The bytes of a file, or nothing if it does not exist or cannot be read.
struct FileText : std::optional<std::string> {
  std::string why{};  // if there are no bytes, the reason, for messages: "cannot be read (Permission denied)"
};

/// Reads a regular file of up to kMaxTextBytes and removes a byte order mark. Other files are refused: a pipe
/// might block forever, and a device may never end.
FileText read_text_file(const std::string& path);
/// Like read_text_file(), but reads an open descriptor, such as standard input, to its end.
FileText read_text_of(int descriptor);

/// Returns why a file of any length cannot be read piece by piece. Empty if it is a readable regular file.
std::string why_not_readable(const std::string& path);

/// Returns the first bytes of a file, enough to recognize its kind (content_kind.h), or an empty string if it
/// cannot be read.
std::string head_of_file(const std::string& path);

/// Replaces a file as a whole: writes a new file next to it, and renames the new file when its bytes are on
/// the disk. base/files/output_file.h contains the rules for replacing files. The new file gets the owner and
/// mode of the old one. Returns an empty string, or the reason for a failure; in that case the old file
/// stays.
std::string replace_text_file(const std::string& path, const std::string& contents, ContentKind kind);

/// Removes temporary files that killed processes left next to `path` in replace_text_file(). It removes files
/// of this kind that no process has locked.
void remove_left_beside(const std::string& path, ContentKind kind);

}  // namespace understudy
