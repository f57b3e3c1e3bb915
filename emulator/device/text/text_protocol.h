// The interface of a device with a text protocol: it receives whole lines and returns its replies as text. It
// does not deal with bytes on the line, descriptors, or the time at which its text is sent.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "emulator/device/model.h"
#include "emulator/device/register_map/refusal.h"

namespace understudy::emulator {

/// The protocol of text lines.
inline constexpr Protocol kTextLines{"text"};

/// The present rules for receiving. The caller reads them for each character.
struct TextRules {
  bool echo = false;               // each received character is sent back, and BS and DEL edit the line
  std::size_t longest_line = 127;  // in characters; of longer lines, the device is only notified
  bool line_feed_ends = true;      // an LF alone ends a line; false: LFs are ignored
  bool has_flow_control = false;   // XOFF from the host holds back replies, XON releases them
  std::string_view echoed_end = "\r\n";
};

class TextProtocol {
 public:
  virtual TextRules text_rules() const { return {}; }

  // --- input, while it has power ---------------------------------------------------------------
  /// Receives a line without its line ending. The line may be empty, and may contain any byte except CR, LF
  /// and flow control characters. The reply is read immediately afterwards; text that the device produces
  /// later is unsolicited.
  virtual void receive_line(std::string_view line) = 0;
  /// Receives a line that was too long.
  virtual void receive_overlong() = 0;
  /// Receives ESC without a line ending. The unfinished line is discarded.
  virtual void receive_escape() {}

  /// Executes a command that bypasses the line, and returns its answer without sending anything. The answer
  /// is `busy` if the device would not accept a line as a command now.
  virtual DeviceAnswer take_command(std::string_view /*line*/) { return Refusal::failure; }

  /// If the text is a refusal from the device, returns its meaning: "a value or an index is out of range" for
  /// "ERR 2". Otherwise returns an empty text.
  virtual std::string_view meaning_of(std::string_view /*line*/) const { return {}; }

  // --- output ------------------------------------------------------------------------------------
  /// Returns true if there is text to send. Called after everything that may produce text: a line, a tick, an
  /// action from outside.
  virtual bool has_text() const = 0;
  /// Returns all text to send, including line endings, and clears it. Transmission starts when the text is
  /// read, and takes as long as the line requires.
  virtual std::string take_text() = 0;

 protected:
  ~TextProtocol() = default;
};

}  // namespace understudy::emulator
