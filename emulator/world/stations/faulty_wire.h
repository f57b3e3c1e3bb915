// What stands between a line and a station when something is broken there: messages that come late, garbled,
// twice or not at all. A station tells it what it has heard and hands it what it says; the wire gives back to
// the station what is left of either (End), at its time.
//
//   heard ──passes()──> whole: the station serves it          said ──answer()──> End::say()
//              └──> pieces ──> End::serve_piece(), late ones in run()    └──> pieces, late ones in run()
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
  /// Messages that are late; what is more is lost.
  static constexpr std::size_t kMostLate = 256;

  /// Where it ends: the station.
  class End {
   public:
    /// Judges what has become of a request as if it had come that way.
    virtual void serve_piece(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                             pty::SimTime now, pty::Transmitter& out) = 0;
    /// Sends what is left of an answer to the request with that last character.
    virtual void say(std::span<const std::uint8_t> bytes, std::uint64_t last_character,
                     pty::Transmitter& out) = 0;

   protected:
    ~End() = default;
  };

  /// A message that is on its way.
  struct Late {
    pty::SimTime at{0};
    bool is_reply = false;  // else a request
    std::uint64_t last_character = 0;
    std::vector<std::uint8_t> bytes{};
  };
  /// Throws std::invalid_argument for what cannot be late.
  static void check(const std::vector<Late>& late);

  /// `late` is its state, in the order of time: a part of its station's.
  FaultyWire(End& end, std::vector<Late>& late) : end_(end), late_(late) {}

  /// Null: nothing is broken. The numbers of the device and of the line are told with each frame.
  void set_faults(FrameFaults* faults, std::size_t device, std::size_t line) {
    faults_ = faults;
    device_ = device;
    line_ = line;
  }

  // --- what the station hears ------------------------------------------------------------------
  /// Nothing can be early where nothing is broken.
  bool is_broken() const { return faults_ != nullptr; }
  /// A character has just completed that frame, which may be taken for over at once.
  void look_at_completed(const HeardFrame& frame);
  /// The frame that was completed is not there any more.
  void forget_early_frame() { is_early_ = false; }
  /// True once for a frame that is to be served before the silence behind it is over.
  bool take_early_frame();
  /// A request is over: whether it has come whole. If it has not, what is left of it comes as pieces.
  bool passes(const HeardFrame& request, pty::Transmitter& out);

  // --- what it does and says -------------------------------------------------------------------
  /// What the device is made to do with a request that is for it.
  FrameFaults::Treatment treatment_of(const HeardFrame& request);
  /// `delay`: of the device itself.
  void answer(const HeardFrame& request, std::span<const std::uint8_t> bytes, pty::Transmitter& out,
              pty::SimTime delay = pty::SimTime{0});

  // --- time ------------------------------------------------------------------------------------
  std::optional<pty::SimTime> due() const;
  /// What was late and has come by now.
  void run(pty::SimTime now, pty::Transmitter& out);
  /// What is on its way is lost.
  void reset();

 private:
  HeardFrame told(HeardFrame frame) const {
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
  bool is_early_ = false;  // within the event that brought the frame
};

}  // namespace understudy::emulator::world
