#include "emulator/play/stages/write_clock.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/modbus/modbus_station.h"
#include "emulator/device/model.h"
#include "emulator/play/stages/modbus_host.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/capture.h"
#include "pty/capture_frames.h"

namespace understudy::emulator::play {

WriteClock::WriteClock(world::World& world) : world_(world) { watch(); }

WriteClock::~WriteClock() { ignore(); }

void WriteClock::watch() {
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    world::WorldLine& line = world_.line(i);
    framers_.push_back(std::make_unique<pty::CaptureFrames>(
        i, line.framing, [this, i](const pty::CapturedPacket& packet) { hear(i, packet); },
        line.protocol == Protocol::text));
    line.line.add_observer(*framers_.back());
  }
}

void WriteClock::ignore() {
  for (std::size_t i = 0; i < framers_.size(); ++i) world_.line(i).line.remove_observer(*framers_[i]);
  framers_.clear();
}

void WriteClock::begin_anew() {
  ignore();
  watch();
  unanswered_ = kNone;
}

/// A request is heard at the moment at which it is carried out, a reply when it begins.
void WriteClock::hear(std::size_t line, const pty::CapturedPacket& packet) {
  if (packet.bytes.empty()) return;  // only what a fault has done
  if (world_.line(line).protocol == Protocol::text) {
    if (packet.way == pty::Way::from_host) last_ = tick_at(world_.now()) + 1;
    return;
  }
  if (packet.way == pty::Way::to_host) {
    const bool is_refused = packet.bytes.size() >= 2 && (packet.bytes[1] & 0x80) != 0;
    if (std::exchange(unanswered_, unanswered_ == line ? kNone : unanswered_) == line && is_refused)
      last_ = before_;
    return;
  }
  if (packet.remark != pty::Remark::none || !is_write(packet.bytes)) return;
  if (!is_for_somebody(line, packet.bytes[0])) return;
  before_ = std::exchange(last_, tick_at(world_.now()) + 1);
  unanswered_ = line;
}

bool WriteClock::is_for_somebody(std::size_t line, std::uint8_t address) const {
  const auto& stations = world_.line(line).stations;
  return std::any_of(stations.begin(), stations.end(), [&](const auto& station) {
    const ModbusStation* const modbus = station->device().modbus();
    return station->device().powered() && modbus != nullptr &&
           modbus->addressing(address) != Addressing::ignore;
  });
}

}  // namespace understudy::emulator::play
