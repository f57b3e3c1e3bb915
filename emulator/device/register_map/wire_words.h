// The words of a register as they appear on the line: in the model's order, or in an order of the register's
// own.
#pragma once

#include <array>
#include <cstdint>

#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

/// Returns true if the row's low word comes first. `low_word_first` is the model's present order.
constexpr bool has_low_first(const RegisterRow& row, bool low_word_first) {
  return low_word_first != row.swaps_words;
}
/// Converts a word between the register and the line.
constexpr std::uint16_t wire_word(const RegisterRow& row, std::uint16_t word) {
  return row.swaps_bytes ? static_cast<std::uint16_t>(word >> 8 | word << 8) : word;
}
/// Returns the two words of a 32-bit register in the order of the line.
constexpr std::array<std::uint16_t, 2> wire_words(const RegisterRow& row, std::uint32_t bits,
                                                  bool low_word_first) {
  const std::uint16_t low = wire_word(row, static_cast<std::uint16_t>(bits));
  const std::uint16_t high = wire_word(row, static_cast<std::uint16_t>(bits >> 16));
  if (has_low_first(row, low_word_first)) return {low, high};
  return {high, low};
}
/// Returns the bits of a 32-bit register.
constexpr std::uint32_t bits_of_wire(const RegisterRow& row, std::uint16_t first, std::uint16_t second,
                                     bool low_word_first) {
  const std::uint32_t one = wire_word(row, first);
  const std::uint32_t other = wire_word(row, second);
  return has_low_first(row, low_word_first) ? one | other << 16 : other | one << 16;
}
/// Returns true if the place is the second word of its register on the line.
constexpr bool is_second_word(const Place& place, bool low_word_first) {
  return place.part != Place::Part::whole &&
         (place.part == Place::Part::high) == has_low_first(*place.row, low_word_first);
}

}  // namespace understudy::emulator
