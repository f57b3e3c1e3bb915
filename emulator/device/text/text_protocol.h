// The interface of a device with a text protocol: it receives whole lines, and gives its replies as text. It
// does not deal with bytes on the wire, descriptors, or the time at which its text is sent.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "emulator/device/model.h"
#include "emulator/device/register_map/refusal.h"

namespace understudy::emulator {

/// The protocol of text lines.
inline constexpr Protocol kTextLines{"text"};

/// The rules for receiving at this moment. The caller reads them at each character.
struct TextRules {
  bool echo = false;               // each received character is sent back, and BS and DEL edit the line
  std::size_t longest_line = 127;  // in characters; the device is only notified of a longer line
  bool line_feed_ends = true;      // an LF alone ends a line; false: LFs are ignored
  bool has_flow_control = false;   // XOFF from the host holds replies back, XON releases them
  std::string_view echoed_end = "\r\n";
};

class TextProtocol {
 public:
  virtual TextRules text_rules() const { return {}; }

  // --- input, while it has power ---------------------------------------------------------------
  /// Receives a line without its line end. It may be empty, and may contain any byte except CR, LF and flow
  /// control. The reply is taken right afterwards; text that the device produces later is unsolicited.
  virtual void receive_line(std::string_view line) = 0;
  /// Receives a line that was too long.
  virtual void receive_overlong() = 0;
  /// Receives ESC without a line end. The unfinished line is discarded.
  virtual void receive_escape() {}

  /// Executes a command that bypasses the line, and returns its answer without sending anything. The answer
  /// is busy if the device would not accept a line as a command at this moment.
  virtual DeviceAnswer take_command(std::string_view /*line*/) { return Refusal::failure; }

  /// Returns what the device's reply means if it refuses something: "a value or an index is out of range" for
  /// "ERR 2". Otherwise returns an empty text.
  virtual std::string_view meaning_of(std::string_view /*line*/) const { return {}; }

  // --- output ------------------------------------------------------------------------------------
  /// Returns true if there is text to send. Called after anything that may produce text: a line, a tick, an
  /// action from outside.
  virtual bool has_text() const = 0;
  /// Returns all text to send, line ends included, and clears it. Sending starts when the text is taken, and
  /// lasts as long as the line requires.
  virtual std::string take_text() = 0;

 protected:
  ~TextProtocol() = default;
};

}  // namespace understudy::emulator
