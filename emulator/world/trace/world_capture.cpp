#include "emulator/world/trace/world_capture.h"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/capture.h"

namespace understudy::emulator::world {

namespace {

/// Returns "pc" or, if the device has several ports, "pc (mill PC)".
std::string interface_name(const WorldLine& line) {
  std::string ports;
  for (const auto& station : line.stations) {
    const Device& device = station->device();
    const auto rows = device.model().line.ports;
    if (rows.size() < 2) continue;
    ports += (ports.empty() ? "" : ", ") + device.name() + " " + std::string(rows[station->port()].name);
  }
  return line.line.name() + (ports.empty() ? "" : " (" + ports + ")");
}

std::vector<pty::CapturedLine> lines_of(World& world, bool names_ports) {
  std::vector<pty::CapturedLine> lines;
  for (std::size_t i = 0; i < world.line_count(); ++i) {
    const pty::Line& line = world.line(i).line;
    lines.push_back(
        {names_ports ? interface_name(world.line(i)) : line.name(), line.options().settings.baud});
  }
  return lines;
}

}  // namespace

WorldCapture::WorldCapture(World& world, const std::string& path, std::function<void(const std::string&)> log)
    : world_(world), names_ports_(path.ends_with(".pcapng")), file_(path, std::move(log)) {}

void WorldCapture::begin() {
  file_.begin(lines_of(world_, names_ports_));
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    const WorldLine& line = world_.line(i);
    lines_.push_back(line.packets(i, [this, &line](const pty::CapturedPacket& packet) {
      const bool is_request =
          packet.direction == pty::Direction::from_host && packet.remark == pty::Remark::none;
      const std::string command = is_request ? line.command_text(packet.bytes) : std::string();
      pty::CapturedPacket with_command = packet;
      with_command.command = command;
      file_.add(with_command);
    }));
    world_.add_observer(i, *lines_.back());
  }
}

WorldCapture::~WorldCapture() { finish(); }

std::string WorldCapture::finish() {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    world_.remove_observer(i, *lines_[i]);
    lines_[i]->finish();
  }
  lines_.clear();
  file_.finish();
  return file_.failure();
}

}  // namespace understudy::emulator::world
