// Reading and writing a device's registers through its map: the same rules for the wire, the control
// socket and scenarios. A write is checked whole, then stored, then takes effect; one that is refused
// changes nothing.
#pragma once

#include <cstdint>
#include <span>

#include "emulator/register_map/register_map.h"

namespace understudy::emulator {

/// Why a request was not carried out. Each protocol translates it (Modbus: an exception code).
enum class Refusal : std::uint8_t {
  none,
  no_register,  // nothing at that address, a register cut in half where that is not allowed,
                // or a write to what can only be read
  bad_value,    // outside the register's range
};

/// Consecutive 16-bit words from `first` on, as the wire has them.
Refusal read_words(const Device& device, Table table, std::uint16_t first, std::span<std::uint16_t> words);
Refusal write_words(Device& device, Table table, std::uint16_t first, std::span<const std::uint16_t> words);

/// A register's present value (or a half's), as its type has it: signed or not.
Value read_value(const Device& device, const Place& place);
Value read_value(const Device& device, const NamedPlace& place);

/// As a write from the wire: same checks, same effects. A bit is written by reading its register first.
/// check_value() only judges.
Refusal check_value(const Device& device, const NamedPlace& place, Value value);
Refusal write_value(Device& device, const NamedPlace& place, Value value);

}  // namespace understudy::emulator
