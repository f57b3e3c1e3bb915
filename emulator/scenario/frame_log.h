// Remembers the last frames that went over the lines of a world, to be told when something has failed.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "emulator/world/world.h"
#include "pty/capture_frames.h"

namespace understudy::emulator {

class FrameLog {
 public:
  /// The world must outlive it.
  explicit FrameLog(World& world);
  ~FrameLog();
  FrameLog(const FrameLog&) = delete;
  FrameLog& operator=(const FrameLog&) = delete;

  /// The last `most`, the oldest first: "3.0512s rs485 <- feeder.Cord_A = 32000".
  std::vector<std::string> last(std::size_t most);

  /// The lines were put into another state: what they were just hearing is forgotten.
  void begin_anew();

 private:
  struct Frame {
    std::size_t line = 0;
    pty::Way way = pty::Way::from_host;
    SimTime time{0};
    std::vector<std::uint8_t> bytes;
    std::string comment{};
  };
  void watch();
  void ignore();
  void add(const pty::CapturedPacket& packet);
  const Frame* request_before(std::size_t reply) const;

  World& world_;
  std::deque<Frame> frames_;
  std::vector<std::unique_ptr<pty::CaptureFrames>> framers_;  // one a line
};

}  // namespace understudy::emulator
