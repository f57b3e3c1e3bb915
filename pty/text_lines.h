// Finds where lines of text end: a value that a station feeds with characters and that returns lines.
//
//  * CR ends a line, even an empty one; an LF right after it is ignored. An LF alone ends a line that is not
//    empty, so hosts that send CR, LF or both are understood.
//  * A line that is too long is reported at its end, without its text.
//  * If the device echoes, a person is typing: BS and DEL remove the last character.
//  * ESC is reported at once, and the unfinished line before it is forgotten.
//  * If the device has flow control, XOFF and XON are reported at once and are not part of a line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "pty/station.h"

namespace understudy::pty {

struct TextLineRules {
  std::size_t longest = 127;             // characters of a line, its end not counted
  bool echoes = false;                   // each character is sent back, and BS and DEL edit
  bool line_feed_ends = true;            // an LF alone ends a line; false: an LF is always ignored
  bool has_flow_control = false;         // XOFF and XON
  std::string_view echoed_end = "\r\n";  // sent back at the end of a line
};

/// The effect of one character.
struct ReceivedText {
  enum class What : std::uint8_t { line, overlong, escape, hold, release } what = What::line;
  std::string text{};                // the text of a line, without its end
  SimTime end{0};                    // when its last character ended
  std::uint64_t last_character = 0;  // its number
};

class TextLines {
 public:
  struct Outcome {
    std::optional<ReceivedText> received{};
    std::string echo{};  // the text that an echoing device sends back for this character
  };
  /// Takes a character. The rules may change from one character to the next.
  Outcome push(const TimedByte& byte, const TextLineRules& rules);
  /// Forgets the unfinished line.
  void reset();

  /// Counts characters that were not part of any line: those of overlong lines, and those forgotten because
  /// of an ESC.
  std::uint64_t dropped_bytes() const { return state_.dropped; }

  // --- its state -----------------------------------------------------------------------------
  /// The limit for the length of a line, whatever the rules allow.
  static constexpr std::size_t kLongest = 4096;
  struct State {
    std::string text;          // the text of the line that has begun
    bool is_overlong = false;  // it is longer than allowed; its text is dropped
    bool was_return = false;   // the last character was a CR
    std::uint64_t dropped = 0;
    bool operator==(const State&) const = default;
  };
  const State& save() const { return state_; }
  /// Throws std::invalid_argument if the state is impossible.
  static void check(const State& state);
  /// Checks the state, then puts it into effect. If it throws, nothing has changed.
  void restore(const State& state);

 private:
  State state_;
};

}  // namespace understudy::pty
