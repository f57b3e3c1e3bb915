// A file that a command writes at its end, for example with results or a page.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/files/content_kind.h"
#include "base/files/descriptor.h"
#include "base/files/growing_file.h"
#include "base/files/output_file.h"
#include "base/files/text_file.h"

namespace understudy::emulator::command_line {

/// The path for standard output.
inline constexpr std::string_view kStandardOutput = "-";

/// A result file. It is opened before anything runs, so a wrong path is reported immediately. Paths that are
/// not regular files, such as /dev/stdout, are allowed.
class ResultFile {
 public:
  /// An empty path means that nothing is written.
  ResultFile(const char* flag, const std::string& path, ContentKind kind)
      : flag_(flag), path_(path), kind_(kind) {
    if (path_.empty()) return;
    if (path_ == kStandardOutput) {
      stream_ = Descriptor(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0));
      if (!stream_) refuse(std::strerror(errno));
      return;
    }
    try {
      if (!is_stream(path_)) {
        is_new_ = !std::filesystem::exists(path_);
        file_.emplace(path_, kind);
        return;
      }
      stream_ = Descriptor(::open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    } catch (const OutputError& error) {
      refuse(error.what());
    }
    if (!stream_) refuse(errno == ENXIO ? "no program reads the pipe" : std::strerror(errno));
    ::fcntl(stream_.get(), F_SETFL, 0);  // from here on, writes may block
  }
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;
  /// A command that fails before it has a result leaves no empty file behind.
  ~ResultFile() {
    if (file_ && is_new_ && !has_begun_) ::unlink(file_->target().c_str());
  }
  bool is_wanted() const { return !path_.empty(); }
  /// Empties the file, so that its old content is not mistaken for the result of an interrupted run.
  void empty() {
    if (file_) begin();
  }
  /// Writes the whole result. If that fails, the old file stays as it was.
  void replace(const std::string& text) {
    if (!file_ || !may_create_beside()) return write(text);
    if (const std::string why = replace_text_file(path_, text, kind_); !why.empty()) refuse(why);
    has_begun_ = true;
  }
  /// Appends text.
  void write(std::string_view text) {
    if (file_) {
      if (!has_begun_) begin();
      if (const int error = file_->write(text); error != 0) refuse(std::strerror(error));
      return;
    }
    while (!text.empty()) {
      const ssize_t size = ::write(stream_.get(), text.data(), text.size());
      if (size < 0 && errno != EINTR) refuse(std::strerror(errno));
      if (size > 0) text.remove_prefix(static_cast<std::size_t>(size));
    }
  }

 private:
  static bool is_stream(const std::string& path) {
    struct stat status = {};
    return ::stat(path.c_str(), &status) == 0 && (S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode));
  }
  bool may_create_beside() const {
    return ::access(std::filesystem::path(file_->target()).parent_path().c_str(), W_OK | X_OK) == 0;
  }
  void begin() {
    has_begun_ = true;
    try {
      file_->begin("");
    } catch (const OutputError& error) {
      refuse(error.what());
    }
  }
  [[noreturn]] void refuse(const std::string& why) const {
    const std::string what = path_ == kStandardOutput ? "standard output" : path_;
    throw GrowingFileError(flag_ + ": " + what + " cannot be written: " + why);
  }
  std::string flag_;
  std::string path_;
  ContentKind kind_;
  std::optional<OutputFile> file_;
  bool is_new_ = false;  // opening the file has created it
  bool has_begun_ = false;
  Descriptor stream_;
};

}  // namespace understudy::emulator::command_line
