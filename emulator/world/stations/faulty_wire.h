// Applies faults between a line and a station: messages arrive late, garbled, twice or not at all. A station
// passes everything that it receives and sends to the wire, which returns what remains of it to the station
// (End) at the right time.
//
//   received ──passes()──> whole: the station serves it       sent ──answer()──> End::transmit()
//                 └──> pieces ──> End::serve_piece(), late ones in run()    └──> pieces, late ones in run()
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "emulator/world/stations/frame_faults.h"
#include "pty/station.h"

namespace understudy::emulator::world {

class FaultyWire {
 public:
  /// The maximum number of messages in transit. Further messages are lost.
  static constexpr std::size_t kMaxLate = 256;

  /// The end of the wire, which is the station.
  class End {
   public:
    /// Handles what remains of a request, as if it had been received in this form.
    virtual void serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                             pty::SimTime now, pty::Transmitter& out) = 0;
    /// Sends what remains of the answer to the request that ended with that character.
    virtual void transmit(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                          pty::Transmitter& out) = 0;

   protected:
    ~End() = default;
  };

  /// A message in transit.
  struct Late {
    pty::SimTime at{0};
    bool is_reply = false;  // false: a request
    std::uint64_t last_character = 0;
    std::vector<std::uint8_t> bytes{};
  };
  /// Throws std::invalid_argument if the late messages are impossible.
  static void check(const std::vector<Late>& late);

  /// `late` is the wire's state, in chronological order. It is part of the station's state.
  FaultyWire(End& end, std::vector<Late>& late) : end_(end), late_(late) {}

  /// Sets the source of faults; null: no faults. For each frame, the source receives the numbers of the
  /// device and the line.
  void set_faults(FrameFaults* faults, std::size_t device, std::size_t line) {
    faults_ = faults;
    device_ = device;
    line_ = line;
  }

  // --- what the station receives ------------------------------------------------------------------
  /// Returns true if there may be faults. Without faults, no frame is served early.
  bool is_broken() const { return faults_ != nullptr; }
  /// Called when a character completes this frame. A fault may treat the frame as complete immediately.
  void check_completed(const ReceivedFrame& frame);
  /// Called when the completed frame no longer exists.
  void forget_early_frame() { is_early_ = false; }
  /// Returns true once for a frame that must be served before the silence after it ends.
  bool take_early_frame();
  /// Called when a request is complete. Returns true if it arrived complete; otherwise, what remains of it
  /// arrives in pieces.
  bool passes(const ReceivedFrame& request, pty::Transmitter& out);

  // --- what the station does and sends -------------------------------------------------------------------
  /// Returns how a fault makes the device treat a request.
  FrameFaults::Treatment treatment_of(const ReceivedFrame& request);
  /// Sends an answer. `delay` is the device's own delay.
  void answer(const ReceivedFrame& request, std::span<const std::uint8_t> bytes, pty::Transmitter& out,
              pty::SimTime delay = pty::SimTime{0});

  // --- time ------------------------------------------------------------------------------------
  std::optional<pty::SimTime> due() const;
  /// Delivers the late messages that are due.
  void run(pty::SimTime now, pty::Transmitter& out);
  /// Drops all messages in transit.
  void reset();

 private:
  ReceivedFrame stamped(ReceivedFrame frame) const {
    frame.device = device_;
    frame.line = line_;
    return frame;
  }
  void keep(Late message);

  End& end_;
  std::vector<Late>& late_;
  FrameFaults* faults_ = nullptr;
  std::size_t device_ = 0;
  std::size_t line_ = 0;
  bool is_early_ = false;  // true only within the event that delivered the frame
};

}  // namespace understudy::emulator::world
