// Reading and writing a device's registers through its map: the same rules for the wire, the control socket
// and scenarios. A write is checked as a whole, then stored, then takes effect; a refused write changes
// nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "emulator/device/register_map/register_bank.h"

namespace understudy::emulator {

/// Why a request was not carried out. Each protocol translates it (Modbus: an exception code).
enum class Refusal : std::uint8_t {
  none,
  no_register,  // nothing at that address, a register cut in half where that is not allowed,
                // or a write to what can only be read
  bad_value,    // outside the register's range
};

/// Consecutive 16-bit words from `first` on, as the wire has them.
Refusal read_words(const RegisterBank& bank, Table table, std::uint16_t first,
                   std::span<std::uint16_t> words);
Refusal write_words(RegisterBank& bank, Table table, std::uint16_t first,
                    std::span<const std::uint16_t> words);

/// A register's present value (or a half's), as its type has it: signed or not.
Value read_value(const RegisterBank& bank, const Place& place);
Value read_value(const RegisterBank& bank, const NamedPlace& place);

/// A value for a named place, as the words that bring it.
struct PreparedWrite {
  Table table = Table::holding;
  std::uint16_t first = 0;
  std::array<std::uint16_t, 2> words{};
  std::size_t count = 0;
};

/// Judges a write as if from the wire, and makes the words for it; they will not be refused, whatever is
/// written before them (except for a register that changes the order of words). A bit is written by way of
/// its register, as it is at this moment.
Refusal prepare_value(const RegisterBank& bank, const NamedPlace& place, Value value, PreparedWrite& write);
Refusal write_prepared(RegisterBank& bank, const PreparedWrite& write);
/// Both at once.
Refusal write_value(RegisterBank& bank, const NamedPlace& named, Value value);

}  // namespace understudy::emulator
