#include "emulator/play/executors/write_clock.h"

#include <cstddef>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/world/view/world_view.h"
#include "emulator/world/world.h"
#include "pty/capture.h"

namespace understudy::emulator::play {

namespace {

/// Longer than any frame. A program may send lines of text for hours without a request.
constexpr std::size_t kMaxAnswer = 1024;

}  // namespace

WriteClock::WriteClock(world::World& world) : world_(world) { watch(); }

WriteClock::~WriteClock() { ignore(); }

void WriteClock::watch() {
  answers_.assign(world_.line_count(), {});
  for (std::size_t i = 0; i < world_.line_count(); ++i) {
    const world::WorldLine& line = world_.line(i);
    framers_.push_back(
        line.packets(i, [this, i](const pty::CapturedPacket& packet) { on_packet(i, packet); }));
    world_.add_observer(i, *framers_.back());
  }
}

void WriteClock::ignore() {
  for (std::size_t i = 0; i < framers_.size(); ++i) world_.remove_observer(i, *framers_[i]);
  framers_.clear();
}

void WriteClock::restart() {
  ignore();
  watch();
  unanswered_ = kNone;
}

/// Receives frames. A request is received when it is executed, a reply when it begins.
void WriteClock::on_packet(std::size_t line, const pty::CapturedPacket& packet) {
  if (packet.bytes.empty()) return;  // the entry only reports the effect of a fault
  const world::WorldLine& on = world_.line(line);
  if (packet.direction == pty::Direction::from_host) {
    answers_[line].clear();
    if (!on.protocol.may_change(on.stations, packet)) return;
    before_ = std::exchange(last_, tick_at(world_.now()) + 1);
    unanswered_ = line;
    return;
  }
  if (answers_[line].size() < kMaxAnswer)
    answers_[line].insert(answers_[line].end(), packet.bytes.begin(), packet.bytes.end());
  if (unanswered_ != line) return;
  if (on.protocol.is_refusal(packet.bytes)) last_ = before_;
  unanswered_ = kNone;
}

}  // namespace understudy::emulator::play
