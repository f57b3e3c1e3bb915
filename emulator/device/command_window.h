// Converts between text and the commands that a host writes to a window of registers. Hosts send numbers;
// people read and write names. Each window has one object, to which the `window` member of its model points.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/program_error.h"
#include "emulator/device/register_map/register_map.h"

namespace understudy::emulator {

class Device;
struct Model;

/// The settings of a device that decide how a message is encoded.
struct WindowForm {
  Firmware firmware = 0;
  bool low_word_first = false;                 // from the device's present state
  std::span<const std::uint8_t> choices = {};  // selected options, by row; empty: the defaults
};

class CommandWindow {
 public:
  /// Returns the name of the window's first register, which is a holding register, as in its row.
  virtual std::string_view register_name() const = 0;
  /// Returns the word that marks the instructions that hosts may send (InstructionRow::areas).
  virtual std::string_view area() const = 0;
  /// Returns an example for messages: "MOVE X 1000".
  virtual std::string_view example() const = 0;
  /// Returns the message for a line of text. Throws ProgramError. The device may still refuse the message.
  virtual std::vector<std::uint16_t> words_of(std::string_view text, const WindowForm& form) const = 0;
  /// Returns the text that words_of() accepts for these words, or nothing if they are not a command.
  virtual std::optional<std::string> text_of(std::span<const std::uint16_t> words,
                                             const WindowForm& form) const = 0;

 protected:
  ~CommandWindow() = default;
};

/// The words that a host writes in one request.
struct WindowMessage {
  std::uint16_t first = 0;  // address of the first holding register
  std::vector<std::uint16_t> words;
};
/// Encodes a command as words. Both functions throw ProgramError, including for a model without a window.
WindowMessage window_message(const Model& model, std::string_view text, const WindowForm& form);
WindowMessage window_message(const Device& device, std::string_view text);
WindowForm window_form(const Device& device);
/// Returns the command that these words represent when written to these registers, or nothing if they are not
/// a command.
std::optional<std::string> window_text(const Device& device, Table table, int first,
                                       std::span<const std::uint16_t> words);

}  // namespace understudy::emulator
