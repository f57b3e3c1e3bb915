// Runs a recording again and compares every byte that is said.
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
    same,       // every byte, at its time
    different,  // `difference` is the first one
    stopped,    // as asked, or at its end if that comes first
  } verdict = Verdict::same;
  std::string difference;  // one line
  SimTime reached{0};
  std::uint64_t events = 0;
  std::uint64_t bytes_said = 0;
  bool has_end = false;  // false: the recording breaks off, as that of a killed program does
};

struct Replayed {
  RecordingHeader header;
  Bench bench;
  ReplayResult result;
};

/// Looks on while a recording runs: made when the world is as the recording begins, destroyed before the
/// world.
class ReplayWatcher {
 public:
  virtual ~ReplayWatcher() = default;
  /// Called at the world's present time, before the event is done to the world; `line_number` in the
  /// recording.
  virtual void happened(const RecordedEvent&, std::size_t /*line_number*/) {}
  /// The recording was played to its end, or to where it differs.
  virtual void ended() {}
};
using ReplayWatcherMaker = std::function<std::unique_ptr<ReplayWatcher>(World&)>;

/// Its devices are of one of the models. `name` stands for the file in messages: RecordingError "name:line:
/// field: what". `until`: goes no further than that. `watch` may return a watcher. `done` gets the world when
/// all is over.
Replayed replay(ModelList models, std::istream& recording, const std::string& name,
                std::optional<SimTime> until, const ReplayWatcherMaker& watch = {},
                const std::function<void(World&)>& done = {});

}  // namespace understudy::emulator::world
