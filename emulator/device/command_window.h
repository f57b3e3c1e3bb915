// Commands that go through a window of a model's registers, as text: an object for each such window, which
// the model's `window` names. What hosts write in hexadecimal, people read and write by name.
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

/// What decides how a message of a device is read.
struct WindowForm {
  Firmware firmware = 0;
  bool low_word_first = false;                 // as the device has it at this moment
  std::span<const std::uint8_t> choices = {};  // options by the model's rows; none: the first of each
};

class CommandWindow {
 public:
  /// The first word's, as a row names it; of holding registers.
  virtual std::string_view register_name() const = 0;
  /// "MOVE X 1000": for messages.
  virtual std::string_view example() const = 0;
  /// The message that a text means, which is one line. Throws ProgramError. Whether the device takes it is
  /// its own affair.
  virtual std::vector<std::uint16_t> words_of(std::string_view text, const WindowForm& form) const = 0;
  /// As words_of() takes it; none where that is not one of its commands.
  virtual std::optional<std::string> text_of(std::span<const std::uint16_t> words,
                                             const WindowForm& form) const = 0;

 protected:
  ~CommandWindow() = default;
};

/// What a host writes in one request.
struct WindowMessage {
  std::uint16_t first = 0;  // of the holding registers
  std::vector<std::uint16_t> words;
};
/// Throw ProgramError, also for a model without such a window.
WindowMessage window_message(const Model& model, std::string_view text, const WindowForm& form);
WindowMessage window_message(const Device& device, std::string_view text);
WindowForm window_form(const Device& device);
/// What was written there, where it is a command.
std::optional<std::string> window_text(const Device& device, Table table, int first,
                                       std::span<const std::uint16_t> words);

}  // namespace understudy::emulator
