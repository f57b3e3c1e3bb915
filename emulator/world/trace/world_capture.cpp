#include "emulator/world/trace/world_capture.h"

#include <utility>

namespace understudy::emulator::world {

namespace {

std::vector<pty::CapturedLine> lines_of(World& world) {
  std::vector<pty::CapturedLine> lines;
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    const pty::Line& line = world.line(i).line;
    lines.push_back({line.name(), line.options().settings.baud});
  }
  return lines;
}

}  // namespace

WorldCapture::WorldCapture(World& world, const std::string& path, std::function<void(const std::string&)> log)
    : world_(world), file_(path, std::move(log)) {}

void WorldCapture::begin() {
  file_.begin(lines_of(world_));
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    const WorldLine& line = world_.line(i);
    lines_.push_back(line.packets(i, [this](const pty::CapturedPacket& packet) { file_.add(packet); }));
    world_.add_observer(i, *lines_.back());
  }
}

WorldCapture::~WorldCapture() {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    world_.remove_observer(i, *lines_[i]);
    lines_[i]->finish();
  }
  file_.finish();
}

}  // namespace understudy::emulator::world
