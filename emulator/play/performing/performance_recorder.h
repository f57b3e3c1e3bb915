// Records a play, so that it can be run again: `understudy replay`.
#pragma once

#include <memory>
#include <string>

#include "emulator/play/performing/onlooker.h"
#include "emulator/world/recording/recording_spool.h"

namespace understudy::emulator::play {

/// A recording cannot go back in time. When the play returns to an earlier state, or is a branch that begins
/// in one, the recording starts again from that state's snapshot, so it always leads from there to the play's
/// end.
class PerformanceRecorder final : public Onlooker {
 public:
  /// Begins with the header for the world's power-up. The file remains until somebody else removes it. Throws
  /// GrowingFileError.
  PerformanceRecorder(world::World& world, world::RecordingHeader header, std::string path);

  void world_restored(std::size_t steps) override;
  void step_over() override;
  /// Into ScenarioResult::recording. Throws GrowingFileError where it has not become whole.
  void finish(ScenarioResult& result) override;

 private:
  void begin();

  world::World& world_;
  world::RecordingHeader header_;
  std::string path_;
  std::unique_ptr<world::RecordingSpool> spool_;
};

}  // namespace understudy::emulator::play
