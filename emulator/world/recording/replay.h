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
    same,       // every byte matches, at its time
    different,  // `difference` is the first one
    stopped,    // it stopped at the requested time, or at the recording's end if that comes first
  } verdict = Verdict::same;
  std::string difference;  // one line
  SimTime reached{0};
  std::uint64_t events = 0;
  std::uint64_t bytes_sent = 0;
  bool has_end = false;  // false if the recording breaks off, because its program was killed
};

struct Replayed {
  RecordingHeader header;
  Bench bench;
  ReplayResult result;
};

/// Observes a replay. It is created after the world has been put into the recording's first state, and
/// destroyed before the world.
class ReplayWatcher {
 public:
  virtual ~ReplayWatcher() = default;
  /// Called at the world's current time, before the event is applied; `line_number` is its line in the
  /// recording.
  virtual void happened(const RecordedEvent&, std::size_t /*line_number*/) {}
  /// Called at the end of the replay, whatever its verdict.
  virtual void ended() {}
};
using ReplayWatcherMaker = std::function<std::unique_ptr<ReplayWatcher>(World&)>;

/// Replays a recording whose devices are of the given models. `name` stands for the file in messages:
/// RecordingError "name:line: field: what". The replay does not continue beyond `until`. `watch` may return a
/// watcher. `done` receives the world at the end.
Replayed replay(ModelList models, std::istream& recording, const std::string& name,
                std::optional<SimTime> until, const ReplayWatcherMaker& watch = {},
                const std::function<void(World&)>& done = {});

}  // namespace understudy::emulator::world
