// The terminals of a device, by their number in the model's table. This is a facet: Device::terminals() is
// null if a device has no terminals. Levels from outside are set on the device itself (Device::set_input()),
// because they exist even while the device is off.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/device/model.h"

namespace understudy::emulator {

class Terminals {
 public:
  /// Returns true if this device has the terminal. A chain may have fewer terminals than its model lists.
  virtual bool has_terminal(int /*terminal*/) const { return true; }
  /// Returns true if the output conducts.
  virtual bool output(int terminal) const = 0;
  /// Returns true if an output may change in ticks that Device::fast_forward_to() skips, because it depends
  /// on the position of an axis. If a wire begins at the output, those ticks are run in full, so that the
  /// wire changes in the right tick.
  virtual bool output_moves(int terminal) const = 0;
  /// Returns `count` digital outputs from `first` on, at most 32, with the first one in bit 0. A device with
  /// hundreds of outputs stores these words.
  virtual std::uint32_t output_word(int first, int count) const {
    std::uint32_t word = 0;
    for (int i = 0; i < count; ++i) word |= std::uint32_t{output(first + i)} << i;
    return word;
  }
  /// Returns the level of an analog output, in the unit of the terminal.
  virtual std::int32_t analog_level(int /*terminal*/) const { return 0; }
  /// Returns the number of pulses of a pulse output, including those that began and ended within a tick.
  virtual std::int64_t output_pulses(int /*terminal*/) const { return 0; }

 protected:
  ~Terminals() = default;
};

/// The terminals as observers see them, in the order of the model's table: groups are words, and pulse
/// outputs have counts.
struct TerminalView {
  enum class What : std::uint8_t { level, word, pulses } what = What::level;
  std::string name;  // "DIN_3", "DI_8", "CMP.pulses"
  TerminalRow::Kind kind = TerminalRow::Kind::digital_in;
  int first = 0;
  int count = 1;
};
/// Returns the terminals that the device has.
std::vector<TerminalView> terminal_views(const Device& device);
std::int64_t value_of(const Device& device, const TerminalView& view);
std::int64_t value_of(const Device& device, const TerminalGroup& group);

}  // namespace understudy::emulator
