// Reads and writes a device's registers through its map, with the same rules for the line, the control socket
// and scenarios. A write is first checked as a whole, then stored, and then takes effect. A refused write
// changes nothing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "emulator/device/register_map/register_bank.h"

namespace understudy::emulator {

/// Reads consecutive 16-bit words, starting at `first`, in the order of transmission. In tables of bits, each
/// word contains one bit.
Objection read_request(const RegisterBank& bank, Table table, std::uint16_t first,
                       std::span<std::uint16_t> words);
Objection write_request(RegisterBank& bank, Table table, std::uint16_t first,
                        std::span<const std::uint16_t> words, bool is_single = false);
/// Reads consecutive bits, packed for transmission: the first bit is the lowest bit of the first byte.
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

/// Returns the present value of a register or of one of its halves, signed or unsigned according to its type.
Value read_value(const RegisterBank& bank, const Place& place);
Value read_value(const RegisterBank& bank, const NamedPlace& place);
/// Returns the first tick after `done` in which the value may change merely because time passes, or kNever if
/// it does not depend on time.
Tick next_change(const RegisterBank& bank, const NamedPlace& named, Tick done);
/// Returns the number that a value of a place represents.
double number_of(const NamedPlace& place, Value value);
/// Returns the value for a number. If the place contains a real, it is the bits of that real. Returns nothing
/// if the number is a fraction and the place contains integers, or if it exceeds single precision.
std::optional<Value> value_of_number(const NamedPlace& place, double number);

/// Returns why a place cannot be written with any value: "cannot be written; it is read-only".
std::string why_not_writable(const NamedPlace& named);

/// The words that write a value to a named place.
struct PreparedWrite {
  Table table = Table::holding;
  std::uint16_t first = 0;
  std::array<std::uint16_t, 2> words{};
  std::size_t count = 0;
};

/// Checks a write as if it came from the line, and prepares its words. The words remain valid if other writes
/// come first (except a write that changes the word order), but the device may refuse them at that time,
/// because it is busy or fails (RegisterBank::admits). A bit is written as part of its register's present
/// value.
Refusal prepare_value(const RegisterBank& bank, const NamedPlace& place, Value value, PreparedWrite& write);
Refusal write_prepared(RegisterBank& bank, const PreparedWrite& write);
/// Writes a value as the device itself does, without asking the device whether it accepts the write.
Refusal write_value(RegisterBank& bank, const NamedPlace& named, Value value);

}  // namespace understudy::emulator
