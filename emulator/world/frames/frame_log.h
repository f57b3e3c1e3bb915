// Keeps the last frames of a world's lines, to show them after a failure or on request. Frames are converted
// to words only when they are shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/device.h"
#include "emulator/world/world.h"
#include "pty/capture_frames.h"

namespace understudy::emulator::world {

class FrameLog {
 public:
  /// Keeps at most `kept` frames. The world must outlive the log.
  explicit FrameLog(World& world, std::size_t kept = kKept);
  ~FrameLog();
  FrameLog(const FrameLog&) = delete;
  FrameLog& operator=(const FrameLog&) = delete;

  /// Also passes each frame to `observer`.
  void set_observer(std::function<void(const pty::CapturedPacket&)> observer) {
    observer_ = std::move(observer);
  }

  /// Returns the last `max` frames, the oldest first: "3.0512s rs485 <- feeder.Cord_A = 32000".
  std::vector<std::string> last(std::size_t max);

  /// A frame in words. Frames are numbered from 1.
  struct Decoded {
    std::uint64_t number = 0;
    SimTime time{0};
    std::string line;
    pty::Direction direction = pty::Direction::from_host;
    std::string text;
    std::string remark;                      // why it was dropped, or another remark
    std::span<const std::uint8_t> bytes{};   // valid until the next frame is added
    bool is_refusal = false;                 // a reply that refuses the request
    bool is_ignored = false;                 // a reply to a command that had no effect; `text` says why
    std::optional<SimTime> latency{};        // for a reply: since its request began
    std::optional<std::uint64_t> request{};  // for a reply: the number of the request
    /// For a request: the devices that it addressed when it was sent. On a line without addresses, there are
    /// none.
    std::vector<const Device*> devices{};
  };
  /// Returns at most `max` of the kept frames, beginning with number `number`.
  std::vector<Decoded> since(std::uint64_t number, std::size_t max) const;
  /// Returns the request to which a kept frame is the reply. Returns nothing if it is not a reply, or if the
  /// request is no longer kept.
  std::optional<Decoded> request_of(std::uint64_t number) const;
  /// Returns the number of the next frame.
  std::uint64_t next_number() const { return next_number_; }

  /// Discards partially received frames after the lines were put into another state.
  void restart();

  /// A frame in the form in which the log stores it.
  struct Frame {
    std::size_t line = 0;
    pty::Direction direction = pty::Direction::from_host;
    SimTime time{0};
    std::vector<std::uint8_t> bytes;
    std::string comment{};
    std::string why{};                     // of a reply: why the request had no effect or was refused
    std::uint64_t last_character = 0;      // of the request, or of the answered request; 0: unknown
    std::vector<std::size_t> addressed{};  // the line's stations that a request addressed when it was sent
  };
  /// Returns the last `max` kept frames whose numbers are at least `number`.
  std::vector<Frame> kept_since(std::uint64_t number, std::size_t max) const;
  /// Like restart(), but then adds these frames (the oldest first) with new numbers.
  void restart_after(std::vector<Frame> frames);

 private:
  // A reply is decoded together with its request, which may be several frames earlier, with frames of other
  // stations in between.
  static constexpr std::size_t kKept = 32;

  void watch();
  void ignore();
  void add(const pty::CapturedPacket& packet);
  const Frame* request_before(std::size_t reply) const;
  const Device* device_of(const Frame* request, const Frame& frame) const;
  std::uint64_t number_of(const Frame& kept) const;
  Decoded decode(std::size_t place) const;

  World& world_;
  std::size_t kept_;
  std::function<void(const pty::CapturedPacket&)> observer_;
  std::uint64_t next_number_ = 1;
  std::deque<Frame> frames_;
  std::vector<std::unique_ptr<pty::CaptureFrames>> framers_;  // one per line
};

}  // namespace understudy::emulator::world
