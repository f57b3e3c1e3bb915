// Determines, from the traffic on a world's lines, when the last write of any host was executed, and what
// stations have sent since the last request on a line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "emulator/world/world.h"
#include "pty/capture_frames.h"

namespace understudy::emulator::play {

class WriteClock {
 public:
  /// The world must outlive this object.
  explicit WriteClock(world::World& world);
  ~WriteClock();
  WriteClock(const WriteClock&) = delete;
  WriteClock& operator=(const WriteClock&) = delete;

  /// Returns the tick from which the last write takes effect, or 0 if there was none. Refused writes do not
  /// count.
  Tick tick_of_last_write() const { return last_; }
  /// Returns the bytes that stations have sent since the last request on the line.
  const std::vector<std::uint8_t>& answer_on(std::size_t line) const { return answers_[line]; }
  /// Discards partially received frames after the lines were put into another state.
  void restart();

 private:
  void watch();
  void ignore();
  void on_packet(std::size_t line, const pty::CapturedPacket& packet);

  world::World& world_;
  std::vector<std::unique_ptr<pty::CaptureFrames>> framers_;  // one per line
  std::vector<std::vector<std::uint8_t>> answers_;            // one per line
  Tick last_ = 0;
  Tick before_ = 0;  // the tick of the previous write
  static constexpr std::size_t kNone = SIZE_MAX;
  std::size_t unanswered_ = kNone;  // the line on which the last write is waiting for its reply
};

}  // namespace understudy::emulator::play
