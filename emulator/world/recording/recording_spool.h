// The recording of a daemon that may run for months: a file that grows, and starts again from a snapshot when
// it has grown too large. The previous one stays beside it as FILE.1, so the last `cap_bytes` of history are
// always there.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/files/growing_file.h"
#include "emulator/world/recording/recorder.h"

namespace understudy::emulator::world {

inline constexpr std::size_t kRecordingCapBytes = std::size_t{64} << 20;
/// How the previous one's name ends.
inline constexpr const char* kOlderPart = ".1";

/// Why nothing may be put aside there: something else than a recording stands there. Empty if it may.
std::string why_no_older_part(const std::string& path);

class RecordingSpool {
 public:
  /// Begins the file. The world must outlive it. Throws GrowingFileError.
  RecordingSpool(World& world, RecordingHeader header, std::unique_ptr<GrowingFile> file,
                 std::size_t cap_bytes, std::function<void(const std::string&)> log);
  ~RecordingSpool();
  RecordingSpool(const RecordingSpool&) = delete;
  RecordingSpool& operator=(const RecordingSpool&) = delete;

  /// Writes that it ends, in which state, and in what a scenario failed, if one did. Call it between two
  /// looks at the world; nothing is recorded after it.
  void finish(std::string failed = {});

  /// Waits until all is written. Returns why it has ended early, or nothing.
  std::string close();

  /// Starts again if it is time to. Call it between two looks at the world, not from within
  /// World::advance_to().
  void look();

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
