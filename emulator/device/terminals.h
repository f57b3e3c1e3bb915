// What a device does with its terminals, by their number in the model's table. A facet: Device::terminals()
// is null where a device has none. Levels from outside are with every device (Device::set_input()): they
// outlive its power.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/device/model.h"

namespace understudy::emulator {

class Terminals {
 public:
  /// How many of those that the model lists this device has: a chain may be shorter.
  virtual bool has_terminal(int /*terminal*/) const { return true; }
  /// Whether an output conducts.
  virtual bool output(int terminal) const = 0;
  /// Whether an output may change in ticks that only count on (Device::cross_to), because it goes by what
  /// moves with an axis. Where a wire leads from it those ticks are run, so that the wire has it at its tick.
  virtual bool output_moves(int terminal) const = 0;
  /// Of `count` digital outputs from `first` on, 32 at most; the first in bit 0. Where there are hundreds a
  /// device has them ready.
  virtual std::uint32_t output_word(int first, int count) const {
    std::uint32_t word = 0;
    for (int i = 0; i < count; ++i) word |= std::uint32_t{output(first + i)} << i;
    return word;
  }
  /// Of an analog output, in its terminal's unit.
  virtual std::int32_t analog_level(int /*terminal*/) const { return 0; }
  /// How many pulses an output of that kind has given, those that began and ended within a tick as well.
  virtual std::int64_t output_pulses(int /*terminal*/) const { return 0; }

 protected:
  ~Terminals() = default;
};

/// What onlookers see of terminals, in the order of the model's table: groups as words, and of outputs whose
/// pulses count that count as well.
struct TerminalSight {
  enum class What : std::uint8_t { level, word, pulses } what = What::level;
  std::string name;  // "DIN_3", "DI_8", "CMP.pulses"
  TerminalRow::Kind kind = TerminalRow::Kind::digital_in;
  int first = 0;
  int count = 1;
};
/// Of those that the device has.
std::vector<TerminalSight> terminal_sights(const Device& device);
std::int64_t value_of(const Device& device, const TerminalSight& sight);
std::int64_t value_of(const Device& device, const TerminalGroup& group);

}  // namespace understudy::emulator
