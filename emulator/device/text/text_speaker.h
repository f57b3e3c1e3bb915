// What a device that is spoken to in lines of text offers: it hears whole lines, and what it says is taken
// from it as text. It does not know the bytes on the wire, a descriptor, or when its text is sent.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "emulator/device/model.h"
#include "emulator/device/register_map/refusal.h"

namespace understudy::emulator {

/// Lines of text.
inline constexpr Protocol kTextLines{"text"};

/// How it listens at this moment; asked for each character.
struct TextRules {
  bool echo = false;               // each character is sent back as it is heard, and BS and DEL edit
  std::size_t longest_line = 127;  // characters; of a longer line it learns only that there was one
  bool line_feed_ends = true;      // an LF alone ends a line; false: LFs are ignored
  bool has_flow_control = false;   // XOFF from the host holds what is said back, XON lets it go on
  std::string_view echoed_end = "\r\n";
};

class TextSpeaker {
 public:
  virtual TextRules text_rules() const { return {}; }

  // --- what it hears, while it has power -------------------------------------------------------
  /// A line, without its end; it may be empty, and hold any byte but CR, LF and what steers the flow. What it
  /// has to say to that is taken right afterwards, as the answer; what comes later is unasked.
  virtual void hear_line(std::string_view line) = 0;
  /// A line that was too long.
  virtual void hear_overlong() = 0;
  /// ESC, without any line's end. The unfinished line is forgotten.
  virtual void hear_escape() {}

  /// A line that comes past the line, by hand: its answer is what this returns, and nothing is said. Refused
  /// as busy where the device would not take a line for a command just now.
  virtual DeviceAnswer take_command(std::string_view /*line*/) { return Refusal::failure; }

  // --- what it says ------------------------------------------------------------------------------
  /// Asked after anything that may have made it speak: a line, a tick, an act from outside.
  virtual bool has_speech() const = 0;
  /// All that it has to say, line ends included; afterwards it has nothing to say. Every text is sent from
  /// the moment at which it is taken, in the wire's time.
  virtual std::string take_speech() = 0;

 protected:
  ~TextSpeaker() = default;
};

}  // namespace understudy::emulator
