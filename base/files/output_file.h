// The rule for every file that the program writes, whether it grows (a recording, a trace, a capture) or is
// replaced as a whole (a memory, a snapshot, a picture):
// - Only a regular file is written, or a free path. A pipe, a device, a socket, a folder is left alone.
// - A symbolic link is followed, and stays: the file that it leads to is written. In a folder where anybody
//   may leave one (/tmp), another user's link is refused, and another user's file as well.
// - A file of another kind is never replaced (content_kind.h): a path may be a slip of the hand.
// - What is there is kept until the first bytes are written. So everything can be opened before anything is
//   emptied.
// - What replaces a file may be read and written by the same people.
// - A file that grows is locked: two programs never write one.
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

/// A file cannot be written: why, and what was expected. The caller names the path.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// "a regular file", "a pipe"
std::string kind_of_file(mode_t mode);

/// The absolute path of the file that writing to `path` would write, or make. Throws OutputError if there is
/// something that may not be written.
std::string output_target(const std::string& path);

/// Throws OutputError if something of another kind stands at `target`, or cannot be read.
void demand_replaceable(const std::string& target, ContentKind kind);

/// Why nothing of that kind can be written to `path`; empty if it can, or opening it will say why not.
std::string why_not_writable(const std::string& path, ContentKind kind);

/// Whose a file is, and who may read and write it.
struct FileAccess {
  uid_t owner = 0;
  gid_t group = 0;
  mode_t mode = 0;
};
/// Nothing if no file is there.
std::optional<FileAccess> access_of(const std::string& path);
/// As far as this process may: an ordinary user cannot give a file away.
void give_access(int file, const FileAccess& access);
void give_access(const std::string& path, const FileAccess& access);
/// Makes an empty file for the same people. Where it cannot, whoever opens it gets an error.
void make_like(const std::string& path, const FileAccess& access);

class OutputFile {
 public:
  /// Opens the file, or makes it, and locks it. Throws OutputError.
  OutputFile(const std::string& path, ContentKind kind);

  /// Where it really is.
  const std::string& target() const { return target_; }
  /// Replaces what was there by these first bytes. Throws OutputError: a file to which nothing can be written
  /// should not begin.
  void begin(std::string_view head);
  /// Keeps the first bytes of what was there, and writes behind them. Throws OutputError.
  void go_on(std::uint64_t size);
  /// Writes all of it and returns 0, or none of it and returns the error: half a packet would spoil those
  /// before it.
  int write(std::string_view piece);

 private:
  std::string target_;
  Descriptor file_;
  std::uint64_t written_ = 0;  // bytes
};

}  // namespace understudy
