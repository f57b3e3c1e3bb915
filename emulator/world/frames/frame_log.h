// Remembers the last frames that went over a world's lines, to show them when something has failed, or when
// somebody wants to look. They are put into words only when they are shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/world/world.h"
#include "pty/capture_frames.h"

namespace understudy::emulator::world {

class FrameLog {
 public:
  /// Remembers at most `kept`. The world must outlive it.
  explicit FrameLog(World& world, std::size_t kept = kKept);
  ~FrameLog();
  FrameLog(const FrameLog&) = delete;
  FrameLog& operator=(const FrameLog&) = delete;

  /// Has each frame told to `onlooker` as well.
  void tell(std::function<void(const pty::CapturedPacket&)> onlooker) { onlooker_ = std::move(onlooker); }

  /// The last `most`, the oldest first: "3.0512s rs485 <- feeder.Cord_A = 32000".
  std::vector<std::string> last(std::size_t most);

  /// A frame in words. Frames are numbered in their order, from 1 on.
  struct Told {
    std::uint64_t number = 0;
    SimTime time{0};
    std::string line;
    pty::Way way = pty::Way::from_host;
    std::string text;
    std::string remark;                     // why it was dropped, and the like
    std::span<const std::uint8_t> bytes{};  // for as long as nothing more is remembered
    bool is_refusal = false;                // an answer that says that nothing was done
    std::optional<SimTime> latency{};       // of an answer: since its request began
  };
  /// At most `most` of the remembered ones, from that number on.
  std::vector<Told> since(std::uint64_t number, std::size_t most) const;
  /// A remembered one's request; nothing if it is none's answer, or that is forgotten.
  std::optional<Told> request_of(std::uint64_t number) const;
  /// Of the frame that comes next.
  std::uint64_t next_number() const { return next_number_; }

  /// The lines were put into another state: half-heard frames are forgotten.
  void begin_anew();

  /// A frame as it is remembered.
  struct Frame {
    std::size_t line = 0;
    pty::Way way = pty::Way::from_host;
    SimTime time{0};
    std::vector<std::uint8_t> bytes;
    std::string comment{};
  };
  /// At most `most` of the remembered ones from that number on: the last of them.
  std::vector<Frame> kept_since(std::uint64_t number, std::size_t most) const;
  /// Like begin_anew(), and these went before, the oldest first: they get new numbers.
  void begin_anew_after(std::vector<Frame> frames);

 private:
  // A reply is read by its request, which several other stations' frames may have followed.
  static constexpr std::size_t kKept = 32;

  void watch();
  void ignore();
  void add(const pty::CapturedPacket& packet);
  const Frame* request_before(std::size_t reply) const;
  Told told(std::size_t place) const;

  World& world_;
  std::size_t kept_;
  std::function<void(const pty::CapturedPacket&)> onlooker_;
  std::uint64_t next_number_ = 1;
  std::deque<Frame> frames_;
  std::vector<std::unique_ptr<pty::CaptureFrames>> framers_;  // one a line
};

}  // namespace understudy::emulator::world
