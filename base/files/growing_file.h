// A file that grows while a world runs, written by a helper thread: a recording, a trace.
// base/files/output_file.h decides which files may be written, and when the old content goes.
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

/// The file cannot be written. One line: what is wrong, what was expected.
struct GrowingFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class GrowingFile {
 public:
  /// It is opened and locked; what is there stays until the first line comes. Throws GrowingFileError.
  GrowingFile(const std::string& path, ContentKind kind, std::function<void(const std::string&)> log);
  ~GrowingFile();  // finishes

  /// Whole lines. The first is written at once, replacing what was there: throws GrowingFileError if that
  /// fails. If a line cannot be taken (the disk is full, or too slow) the file ends there, with a line in the
  /// log: with a gap it would be worthless.
  void take(std::string_view line);
  /// Waits until all is written. Returns why it has ended early, or nothing.
  std::string finish();
  /// Where it really is.
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
  std::unique_ptr<BackgroundWriter> writer_;  // last: its thread uses the others
};

}  // namespace understudy
