// Records a scenario's run, so that `understudy replay` can repeat it.
#pragma once

#include <memory>
#include <string>

#include "emulator/play/performing/observer.h"
#include "emulator/world/recording/recording_spool.h"

namespace understudy::emulator::play {

/// A recording cannot go back in time. When the scenario returns to an earlier state, or is a branch that
/// begins in such a state, the recording starts again from the snapshot of that state. Therefore, it always
/// leads from that state to the end.
class PerformanceRecorder final : public Observer {
 public:
  /// Begins with `header`, which must be for the world at power-up. The caller removes the file. Throws
  /// GrowingFileError.
  PerformanceRecorder(world::World& world, world::RecordingHeader header, std::string path);

  void world_restored(std::size_t steps) override;
  void step_over() override;
  /// Sets ScenarioResult::recording. Throws GrowingFileError if the recording is incomplete.
  void finish(ScenarioResult& result) override;

 private:
  void begin();

  world::World& world_;
  world::RecordingHeader header_;
  std::string path_;
  std::unique_ptr<world::RecordingSpool> spool_;
};

}  // namespace understudy::emulator::play
