// Records a play, so that what came of it can be run again: `understudy replay`.
#pragma once

#include <memory>
#include <string>

#include "emulator/play/performing/onlooker.h"
#include "emulator/world/recording/recording_spool.h"

namespace understudy::emulator::play {

/// A recording has one course. Where the play goes back to an earlier state, or is a branch that begins in
/// one, the recording begins anew from that state's snapshot: it always leads from there to the play's end.
class PlayRecorder final : public Onlooker {
 public:
  /// The header as for the world's power-up. The file is there until somebody else removes it. Throws
  /// GrowingFileError.
  PlayRecorder(world::World& world, world::RecordingHeader header, std::string path);

  void world_restored(std::size_t steps) override;
  void step_over() override;
  /// Into ScenarioResult::recording.
  void finish(ScenarioResult& result) override;

 private:
  void begin();

  world::World& world_;
  world::RecordingHeader header_;
  std::string path_;
  std::unique_ptr<world::RecordingSpool> spool_;
};

}  // namespace understudy::emulator::play
