// Reading and writing a device's registers through its map: the same rules for the wire, the control socket
// and scenarios. A write is checked as a whole, then stored, then takes effect; a refused write changes
// nothing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "emulator/device/register_map/register_bank.h"

namespace understudy::emulator {

/// Consecutive 16-bit words from `first` on, as the wire has them; or bits, a word each.
Objection read_request(const RegisterBank& bank, Table table, std::uint16_t first,
                       std::span<std::uint16_t> words);
Objection write_request(RegisterBank& bank, Table table, std::uint16_t first,
                        std::span<const std::uint16_t> words, bool is_single = false);
/// Consecutive bits, packed as the wire has them: the first is the lowest of the first byte.
Objection read_bits_request(const RegisterBank& bank, Table table, std::uint16_t first, std::size_t count,
                            std::span<std::uint8_t> packed);

/// The same without the cause.
inline Refusal read_words(const RegisterBank& bank, Table table, std::uint16_t first,
                          std::span<std::uint16_t> words) {
  return read_request(bank, table, first, words).refusal;
}
inline Refusal write_words(RegisterBank& bank, Table table, std::uint16_t first,
                           std::span<const std::uint16_t> words) {
  return write_request(bank, table, first, words).refusal;
}

/// A register's present value (or a half's), as its type has it: signed or not.
Value read_value(const RegisterBank& bank, const Place& place);
Value read_value(const RegisterBank& bank, const NamedPlace& place);
/// The first tick after `done` at which it may change although nothing happens; kNever if it does not tell
/// time.
Tick next_change(const RegisterBank& bank, const NamedPlace& named, Tick done);
/// The number that a place's value stands for.
double number_of(const NamedPlace& place, Value value);
/// The value of a number for a place: a real's bits where it holds a real. None: a fraction for a whole
/// number, or more than a single can hold.
std::optional<Value> value_of_number(const NamedPlace& place, double number);

/// Why nothing can be written to a place, whatever the value: "cannot be written; it is read-only".
std::string why_not_writable(const NamedPlace& named);

/// A value for a named place, as the words that bring it.
struct PreparedWrite {
  Table table = Table::holding;
  std::uint16_t first = 0;
  std::array<std::uint16_t, 2> words{};
  std::size_t count = 0;
};

/// Judges a write as if from the wire, and makes the words for it. Whatever is written before them, they stay
/// good (except after a register that changes the order of words); what may have changed by then is whether
/// the device takes them: it may be busy, or fail (RegisterBank::admits). A bit is written by way of its
/// register, as it is at this moment.
Refusal prepare_value(const RegisterBank& bank, const NamedPlace& place, Value value, PreparedWrite& write);
Refusal write_prepared(RegisterBank& bank, const PreparedWrite& write);
/// The same as the device's own act: nobody asks whether it takes it.
Refusal write_value(RegisterBank& bank, const NamedPlace& named, Value value);

}  // namespace understudy::emulator
