#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "base/files/content_kind.h"

namespace understudy {

/// The largest file that is read as a whole: far above any bench, trace or snapshot.
inline constexpr std::size_t kMostTextBytes = std::size_t{64} << 20;

/// The bytes of a file; nothing if it does not exist or cannot be read.
struct FileText : std::optional<std::string> {
  std::string why{};  // where there is nothing, for messages: "cannot be read (Permission denied)"
};

/// Only a regular file is read, up to kMostTextBytes: a pipe might make us wait for ever, and a device may
/// never end.
FileText read_text_file(const std::string& path);
/// Like the above, for something that is open already, such as standard input, up to its end.
FileText read_text_of(int descriptor);

/// Like the above, for files of any length that are read piece by piece: empty if it is a regular file.
std::string why_not_readable(const std::string& path);

/// The first bytes of a file, so many that they tell what it holds (content_kind.h); none if it cannot be
/// read.
std::string head_of_file(const std::string& path);

/// Replaces a file as a whole: writes beside it, under a free name, and renames when the bytes are on the
/// disk. base/files/output_file.h says what may be replaced. What stands there keeps its owner and mode.
/// Returns nothing, or why it failed, and then what was there stays.
std::string replace_text_file(const std::string& path, const std::string& contents, ContentKind kind);

/// Removes what writers that were killed have left beside `path`: files of the names that replace_text_file()
/// uses, of that kind, that nobody is writing.
void remove_left_beside(const std::string& path, ContentKind kind);

}  // namespace understudy
