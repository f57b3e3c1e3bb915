// Finds Modbus ASCII frames in the characters of a line: a value that a station feeds with characters, and
// that returns frames.
//
//  * ':' begins a frame, whatever came before it; CR and LF end it.
//  * Two characters of a frame may be `patience` apart (the standard says 1 s); after a longer time the
//  beginning is
//    dropped.
//  * Any other character between them, and a wrong LRC, drop the frame.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "pty/station.h"

namespace understudy::pty {

inline constexpr SimTime kAsciiPatience = std::chrono::seconds(1);

/// A frame with a right LRC.
struct AsciiFrame {
  std::vector<std::uint8_t> bytes{};  // as received, from ':' to LF
  std::vector<std::uint8_t> rtu{};    // the RTU frame of the same content
  SimTime end{0};                     // when its last character was over
  std::uint64_t last_character = 0;   // its number
};

class AsciiFramer {
 public:
  explicit AsciiFramer(SimTime patience = kAsciiPatience) : patience_(patience) {}

  /// Takes a character. Returns the frame that it completes. Characters must come in chronological order.
  std::optional<AsciiFrame> push(const TimedByte& byte);
  /// Forgets the beginning of a frame (another station used the line).
  void reset();
  /// Drops the beginning of a frame: no more characters will come.
  void give_up_waiting();

  /// Counts characters that were not in a frame with a right LRC, but not those that reset() forgot.
  std::uint64_t dropped_bytes() const { return state_.dropped; }

  // --- its state: the patience is not in it --------------------------------------------------
  struct State {
    std::vector<std::uint8_t> characters{};  // from ':' on; empty: outside of a frame
    SimTime last_end{0};                     // of the last of them
    std::uint64_t dropped = 0;
  };
  const State& save() const { return state_; }
  /// Throws std::invalid_argument if the state is impossible.
  static void check(const State& state);
  /// Checks the state, then puts it into effect. If it throws, nothing has changed.
  void restore(const State& state);

 private:
  SimTime patience_;
  State state_;
};

}  // namespace understudy::pty
