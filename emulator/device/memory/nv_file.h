// Stores NV images on disk. A file is replaced as a whole by a new file next to it, so a reader finds either
// the old or the new image, even if the writer is killed.
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/device/memory/nv_image.h"

namespace understudy::emulator {

/// Converts the error of an image to a message for its file: "path:line: field: what is wrong".
FileError::Diagnostic diagnostic_of(const NvError& wrong, const std::string& path);

/// Returns nothing if the file does not exist. Throws FileError "path:line: field: what is wrong"; the file
/// does not change.
std::optional<NvImage> read_nv_file(const std::string& path);

/// Writes images in a helper thread, for callers that must not wait.
class NvWriter {
 public:
  /// If several images for a file arrive within this time, only the last one is written.
  static constexpr std::chrono::milliseconds kCoalesce{100};

  NvWriter();
  ~NvWriter();  // first writes the waiting images
  NvWriter(const NvWriter&) = delete;
  NvWriter& operator=(const NvWriter&) = delete;

  /// Queues the file's new contents.
  void write(const std::string& path, std::string contents);
  /// Like the function above, but the helper thread creates the image and its text.
  void write(const std::string& path, LateImage image);
  /// Waits until every queued image has been written to the disk or has failed.
  void flush();
  /// Returns true if nothing is waiting or being written, and take_news() would return nothing.
  bool is_idle() const;
  /// Returns the messages since the last call: a line when a file cannot be written, and a line when it can
  /// be written again.
  std::vector<std::string> take_news();

 private:
  using Contents = std::variant<std::string, LateImage>;
  void run();
  void take(const std::string& path, Contents contents);
  void replace(const std::string& path, const std::string& contents);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Contents> waiting_;  // the contents that are waiting, by path
  std::vector<std::string> news_;
  bool is_busy_ = false;
  bool is_hurried_ = false;  // flush() is waiting: write without delay
  bool is_finishing_ = false;
  std::map<std::string, bool> has_failed_;  // only the helper thread uses it
  std::thread thread_;                      // declared last, because it uses all other members
};

}  // namespace understudy::emulator
