// The rules for every file that the program writes, whether the file grows (a recording, a trace, a capture)
// or is replaced as a whole (a memory, a snapshot, a picture):
// - The program writes only to a regular file or a free path, never to a pipe, a device, a socket or a
//   folder.
// - It follows a symbolic link and writes the target; the link stays. In a folder that everyone can write to
//   (/tmp), it refuses another user's link or file.
// - It never replaces another kind of file (content_kind.h), because the path may be a typing error.
// - It keeps the old content until the first bytes are written, so all outputs can be opened before any is
//   truncated.
// - A new file that replaces an old one has the same owner and permissions.
// - It locks a file that grows, so two programs never write to the same file.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/files/content_kind.h"
#include "base/files/descriptor.h"

namespace understudy {

/// Thrown if a file cannot be written. The message contains the reason and what was expected; the caller adds
/// the path.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the kind of a file for messages: "a regular file", "a pipe".
std::string kind_of_file(mode_t mode);

/// Returns the absolute path of the file that writing to `path` would write or create. Throws OutputError if
/// that path may not be written.
std::string output_target(const std::string& path);

/// Throws OutputError if the file at `target` is of another kind or cannot be read.
void require_replaceable(const std::string& target, ContentKind kind);

/// Returns why contents of that kind cannot be written to `path`. The string is empty if they can, or if only
/// opening the file would reveal the reason.
std::string why_not_writable(const std::string& path, ContentKind kind);
/// Like why_not_writable(), but also returns why opening would fail: a missing folder or a missing
/// permission. It creates nothing, so it suits commands that may fail before they have anything to write.
std::string why_not_openable(const std::string& path, ContentKind kind);

/// A file's owner, group and permissions.
struct FileAccess {
  uid_t owner = 0;
  gid_t group = 0;
  mode_t mode = 0;
};
/// Returns nothing if the file does not exist.
std::optional<FileAccess> access_of(const std::string& path);
/// Sets the file's owner, group and mode to these values as far as this process is allowed to: an ordinary
/// user cannot change the owner.
void give_access(int file, const FileAccess& access);
void give_access(const std::string& path, const FileAccess& access);
/// Creates an empty file with these permissions. Errors are ignored: opening the file later reports them.
void make_like(const std::string& path, const FileAccess& access);

class OutputFile {
 public:
  /// Opens or creates the file, and locks it. Throws OutputError.
  OutputFile(const std::string& path, ContentKind kind);

  /// Returns the path with links resolved.
  const std::string& target() const { return target_; }
  /// Replaces the old content with these first bytes. Throws OutputError if they cannot be written, so a run
  /// does not start with an output that fails.
  void begin(std::string_view head);
  /// Keeps the first `size` bytes of the old content and appends to them. Throws OutputError.
  void continue_at(std::uint64_t size);
  /// Writes the whole piece and returns 0, or writes nothing and returns the error number: half a packet
  /// would corrupt the packets before it.
  int write(std::string_view piece);

 private:
  std::string target_;
  Descriptor file_;
  std::uint64_t written_ = 0;  // bytes
};

}  // namespace understudy
