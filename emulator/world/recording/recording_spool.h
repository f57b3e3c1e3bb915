// The recording of a daemon that may run for months. When the file has become too large, it is restarted from
// a snapshot. The previous file is kept as FILE.1, so at least the last `cap_bytes` of history are available.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/files/growing_file.h"
#include "emulator/world/recording/recorder.h"

namespace understudy::emulator::world {

inline constexpr std::size_t kRecordingCapBytes = std::size_t{64} << 20;
/// The suffix of the previous file's name.
inline constexpr const char* kOlderPart = ".1";

/// Returns why the previous file cannot be stored: something other than a recording has its path. Returns an
/// empty text if it can be stored.
std::string why_no_older_part(const std::string& path);

class RecordingSpool {
 public:
  /// Begins the file. The world must outlive this object. Throws GrowingFileError.
  RecordingSpool(World& world, RecordingHeader header, std::unique_ptr<GrowingFile> file,
                 std::size_t cap_bytes, std::function<void(const std::string&)> log);
  ~RecordingSpool();
  RecordingSpool(const RecordingSpool&) = delete;
  RecordingSpool& operator=(const RecordingSpool&) = delete;

  /// Writes the end, the final state and, if a scenario failed, its failure. Call this outside
  /// World::advance_to(). Afterwards, nothing is recorded.
  void finish(RecordedFailure failed = {});

  /// Writes an event that the world does not report.
  void note(RecordedEvent event);

  /// Waits until everything is written. Returns why the file ended early, or an empty string if it did not.
  std::string close();

  /// Starts a new file if the present one is too large. Call this outside World::advance_to().
  void poll();

 private:
  void begin();
  void put_aside();

  World& world_;
  RecordingHeader header_;
  std::size_t cap_bytes_;
  std::function<void(const std::string&)> log_;
  std::size_t bytes_ = 0;
  std::string failure_;
  std::unique_ptr<GrowingFile> before_;  // its thread may still be writing
  std::unique_ptr<GrowingFile> file_;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace understudy::emulator::world
