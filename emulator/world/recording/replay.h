// Replays a recording and compares every byte that stations send.
#pragma once

#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <string>

#include "emulator/world/recording/recording.h"

namespace understudy::emulator::world {

struct ReplayResult {
  enum class Verdict : std::uint8_t {
    same,       // every byte matches, including its time
    different,  // `difference` is the first difference
    stopped,    // it stopped at the requested time, or earlier at the end of the recording
  } verdict = Verdict::same;
  std::string difference;  // one line
  SimTime reached{0};
  std::uint64_t events = 0;
  std::uint64_t bytes_sent = 0;
  bool has_end = false;  // false if the recording breaks off because its program was killed
};

struct Replayed {
  RecordingHeader header;
  Bench bench;
  ReplayResult result;
};

/// Observes a replay. It is created after the world was put into the recording's first state, and destroyed
/// before the world.
class ReplayWatcher {
 public:
  virtual ~ReplayWatcher() = default;
  /// Called at the world's current time, before the event is applied. `line_number` is the event's line in
  /// the recording.
  virtual void happened(const RecordedEvent&, std::size_t /*line_number*/) {}
  /// Called at the end of the replay, with any verdict.
  virtual void ended() {}
};
using ReplayWatcherMaker = std::function<std::unique_ptr<ReplayWatcher>(World&)>;

/// Replays a recording whose devices may have the given models. In messages, `name` is used as the file name:
/// RecordingError "name:line: field: what". The replay stops at `until` at the latest. `watch` may return a
/// watcher. `done` receives the world at the end.
Replayed replay(ModelList models, std::istream& recording, const std::string& name,
                std::optional<SimTime> until, const ReplayWatcherMaker& watch = {},
                const std::function<void(World&)>& done = {});

}  // namespace understudy::emulator::world
