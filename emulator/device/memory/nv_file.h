// NV images on disk. A file is replaced as a whole by one that has been written beside it, so that a reader
// finds the old image or the new one, whenever the writer dies.
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

/// What is wrong with the image of a file, as "path:line: field: what is wrong".
FileError::Complaint complaint_of(const NvError& wrong, const std::string& path);

/// Nothing if there is no file. Throws FileError "path:line: field: what is wrong"; the file is left as it
/// is.
std::optional<NvImage> read_nv_file(const std::string& path);

/// Writes images for an owner that may not wait: a helper thread does it.
class NvWriter {
 public:
  /// Of images for one file that follow each other sooner than this, only the last is written.
  static constexpr std::chrono::milliseconds kCoalesce{100};

  NvWriter();
  ~NvWriter();  // writes what waits
  NvWriter(const NvWriter&) = delete;
  NvWriter& operator=(const NvWriter&) = delete;

  /// Takes the file's new contents.
  void write(const std::string& path, std::string contents);
  /// Like the above; the helper thread makes the image, and its text.
  void write(const std::string& path, LateImage image);
  /// Waits until everything taken is on the disk, or was refused by it.
  void flush();
  /// Nothing waits, nothing is being written, and there is no news.
  bool is_idle() const;
  /// News since the last call: a line when a file cannot be written, and one when it can again.
  std::vector<std::string> take_news();

 private:
  using Contents = std::variant<std::string, LateImage>;
  void run();
  void take(const std::string& path, Contents contents);
  void replace(const std::string& path, const std::string& contents);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Contents> waiting_;  // by path
  std::vector<std::string> news_;
  bool is_busy_ = false;
  bool is_hurried_ = false;  // somebody waits: do not wait for more
  bool is_finishing_ = false;
  std::map<std::string, bool> has_failed_;  // of the helper thread
  std::thread thread_;                      // last: it uses all the others
};

}  // namespace understudy::emulator
