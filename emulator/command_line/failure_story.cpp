#include "emulator/command_line/failure_story.h"

#include <cstddef>
#include <exception>
#include <fstream>
#include <ios>
#include <memory>
#include <string>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/world/events/event_log.h"
#include "emulator/world/events/history.h"
#include "emulator/world/events/story.h"
#include "emulator/world/frames/frame_log.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

namespace {

constexpr std::size_t kFramesKept = 1024;  // the most frames kept between two events of the recording

class FailureWatcher final : public world::ReplayWatcher {
 public:
  FailureWatcher(world::World& world, std::vector<std::string>& lines)
      : world_(world), frames_(world, kFramesKept), events_(world, frames_), lines_(lines) {}
  void happened(const world::RecordedEvent& event, std::size_t) override {
    history_.collect(world_, frames_, events_);
    if (event.failed.what.empty()) return;
    lines_ = world::moment_lines(world::story_of(world_, event.failed, history_.events()));
  }

 private:
  world::World& world_;
  world::FrameLog frames_;
  world::EventLog events_;
  world::History history_;
  std::vector<std::string>& lines_;
};

}  // namespace

std::vector<std::string> events_before_failure(ModelList models, const std::string& recording) {
  std::vector<std::string> lines;
  std::ifstream file(recording, std::ios::binary);
  try {
    world::replay(models, file, recording, {},
                  [&](world::World& world) { return std::make_unique<FailureWatcher>(world, lines); });
  } catch (const std::exception&) {
    return {};
  }
  return lines;
}

}  // namespace understudy::emulator::command_line
