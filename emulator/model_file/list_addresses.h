// Addresses in the forms that manuals use: 0x2000, 2000H, 40001, 4x0001, pairs such as 10-11, and bits such
// as 10.3.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_reading.h"

namespace understudy::emulator::model_file {

/// A printed address. What it counts is not known yet.
struct PrintedAddress {
  std::int64_t number = 0;
  std::int64_t last = 0;         // the last address of a pair or a range; otherwise equal to `number`
  bool is_hexadecimal = false;   // true if this is evident from the form of the address
  std::optional<Table> table{};  // "4x0001", "HR100"
  bool counts_from_one = false;  // always true for "4x0001"
  int bit = -1;                  // "10.3"

  int words() const { return static_cast<int>(last - number) + 1; }
};

/// Returns nothing for a text that is not an address. If `is_hexadecimal`, plain digits are also hexadecimal.
std::optional<PrintedAddress> parse_address(std::string_view text, bool is_hexadecimal);
/// Returns true for a number that is recognizable as hexadecimal only by its letters: "10A0".
bool has_hexadecimal_letters(std::string_view text);

/// An address on the line, and the table that follows from its form.
struct WireAddress {
  std::uint16_t address = 0;
  std::optional<Table> table{};
};
/// Returns nothing if the number is not possible with this reading.
std::optional<WireAddress> wire_address(const PrintedAddress& printed, AddressReading reading);

/// Collects evidence about the unit in which a list counts addresses.
struct AddressEvidence {
  /// `table` is the table in the row's own cell, if it has one. `holds_words` is true if the row's type is
  /// not a bit.
  /// Returns false if the address cannot be a Modicon number.
  bool add(const PrintedAddress& printed, std::optional<Table> table, bool holds_words);

  /// Returns the reading if only one is possible.
  std::optional<AddressReading> certain() const;
  /// Returns the likely reading, or nothing if two readings are likely.
  std::optional<AddressReading> likely() const;

  bool all_are_modicon = true;   // all are within the blocks of their tables: 40001 to 49999, and so on
  bool any_has_a_block = false;  // apart from the block of coils, whose numbers look like plain numbers
  bool beyond_the_wire = false;  // 400001
  bool begins_a_block = false;   // one of the first ten addresses of a block, such as 40001 to 40010
  std::int64_t lowest = INT64_MAX;
};

}  // namespace understudy::emulator::model_file
