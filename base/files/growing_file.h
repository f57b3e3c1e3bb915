// A file that grows while a world runs (a recording or a trace), written by a helper thread.
// base/files/output_file.h decides which files may be written, and when the old content is deleted.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/files/background_writer.h"
#include "base/files/content_kind.h"
#include "base/files/output_file.h"

namespace understudy {

/// Thrown if the file cannot be written. The message is one line: what is wrong, and what was expected.
struct GrowingFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class GrowingFile {
 public:
  /// Opens and locks the file. Its old content stays until the first line is written. Throws
  /// GrowingFileError.
  GrowingFile(const std::string& path, ContentKind kind, std::function<void(const std::string&)> log);
  ~GrowingFile();  // calls finish()

  /// Appends whole lines. The first call writes immediately and replaces the old content; it throws
  /// GrowingFileError if that fails. If a later line cannot be written (the disk is full or too slow), the
  /// file ends there and the log reports it, because a file with a gap would be worthless.
  void take(std::string_view line);
  /// Waits until everything is written. Returns why the file ended early, or an empty string if it did not.
  std::string finish();
  /// Returns the path with links resolved.
  const std::string& target() const { return file_.target(); }

 private:
  void begin(std::string_view line);
  void give_up(const std::string& why);

  std::string path_;
  std::string what_;  // for messages: "the recording"
  std::function<void(const std::string&)> log_;
  OutputFile file_;
  bool has_begun_ = false;
  std::string failure_;
  std::unique_ptr<BackgroundWriter> writer_;  // declared last, because its thread uses the other members
};

}  // namespace understudy
