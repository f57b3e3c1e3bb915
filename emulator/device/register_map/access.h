// Reads and writes a device's registers through its map, by the same rules for the wire, the control socket
// and scenarios. A write is first checked as a whole, then stored, then takes effect; a refused write
// changes nothing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "emulator/device/register_map/register_bank.h"

namespace understudy::emulator {

/// Reads consecutive 16-bit words from `first` on in the order of the wire, or bits, one per word.
Objection read_request(const RegisterBank& bank, Table table, std::uint16_t first,
                       std::span<std::uint16_t> words);
Objection write_request(RegisterBank& bank, Table table, std::uint16_t first,
                        std::span<const std::uint16_t> words, bool is_single = false);
/// Reads consecutive bits, packed as on the wire: the first is the lowest bit of the first byte.
Objection read_bits_request(const RegisterBank& bank, Table table, std::uint16_t first, std::size_t count,
                            std::span<std::uint8_t> packed);

/// Like read_request(), without the cause.
inline Refusal read_words(const RegisterBank& bank, Table table, std::uint16_t first,
                          std::span<std::uint16_t> words) {
  return read_request(bank, table, first, words).refusal;
}
inline Refusal write_words(RegisterBank& bank, Table table, std::uint16_t first,
                           std::span<const std::uint16_t> words) {
  return write_request(bank, table, first, words).refusal;
}

/// Returns the present value of a register (or of half of one), signed or unsigned according to its type.
Value read_value(const RegisterBank& bank, const Place& place);
Value read_value(const RegisterBank& bank, const NamedPlace& place);
/// Returns the first tick after `done` at which the value may change with time alone, or kNever if it does
/// not depend on time.
Tick next_change(const RegisterBank& bank, const NamedPlace& named, Tick done);
/// Returns the number that the value of a place represents.
double number_of(const NamedPlace& place, Value value);
/// Returns the value for a number: its bits if the place holds a real. Returns nothing if the number is a
/// fraction and the place holds whole numbers, or if it exceeds single precision.
std::optional<Value> value_of_number(const NamedPlace& place, double number);

/// Returns why a place cannot be written, whatever the value: "cannot be written; it is read-only".
std::string why_not_writable(const NamedPlace& named);

/// The words to write for a value of a named place.
struct PreparedWrite {
  Table table = Table::holding;
  std::uint16_t first = 0;
  std::array<std::uint16_t, 2> words{};
  std::size_t count = 0;
};

/// Checks a write as if it came from the wire, and makes its words. The words stay valid if other writes come
/// first (except one that changes the order of words), but the device may refuse them then, because it is
/// busy or fails (RegisterBank::admits). A bit is written through its present register.
Refusal prepare_value(const RegisterBank& bank, const NamedPlace& place, Value value, PreparedWrite& write);
Refusal write_prepared(RegisterBank& bank, const PreparedWrite& write);
/// Writes a value as the device itself does, without asking the device whether it admits the write.
Refusal write_value(RegisterBank& bank, const NamedPlace& named, Value value);

}  // namespace understudy::emulator
