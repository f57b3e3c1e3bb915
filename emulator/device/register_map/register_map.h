// Indexes a model's rows: finds a register in O(1) by address or by name, and assigns each quantity a slot in
// the register image. A map is created once per model and shared by all its devices.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/register_map/register_names.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

/// A register, or one half of a 32-bit register.
struct Place {
  static constexpr int kNoSlot = -1;

  const RegisterRow* row = nullptr;
  int index = 0;
  int slot = 0;  // in the register image; kNoSlot: the register shows other state
  using Part = RegisterPart;
  Part part = Part::whole;

  explicit operator bool() const { return row != nullptr; }
  std::uint16_t address() const {  // the address of the first word of the whole register
    return static_cast<std::uint16_t>(row->address + index * row->stride);
  }
  bool is_second_word(bool low_word_first) const {
    return part != Part::whole && (part == Part::high) == low_word_first;
  }
  /// Returns true if both are words of the same register.
  bool is_same_register(const Place& other) const { return row == other.row && index == other.index; }
};

/// A place, or some of its bits: "STATUS.4", "STATUS.READY".
struct NamedPlace {
  Place place;
  int bit = -1;   // the lowest bit; -1: the whole place
  int width = 1;  // number of bits

  bool is_real() const { return bit < 0 && place.part == Place::Part::whole && place.row->type == Type::f32; }
};

/// How a bit is read. This is computed once, because hosts read hundreds of bits in a request.
struct BitSource {
  enum class How : std::uint8_t {
    asks,    // through its row, as found by at(), or nothing if there is no row at the address
    reader,  // by the reader of a row that exists in every firmware: `slot` is the row, `run` the index in it
    stored,  // from the image
    constant,  // always 0 or 1, the value of `slot`
  } how = How::asks;
  // How many equal sources begin here: bits stored in neighbouring slots, or equal constants.
  std::uint16_t run = 1;
  std::int32_t slot = 0;
};

class RegisterMap {
 public:
  /// Creates a map of rows, which must outlive it. Throws std::logic_error if two rows of a table have the
  /// same address, or if a row is inconsistent.
  RegisterMap(std::span<const RegisterRow> rows, MapPolicy policy);
  /// The same, but the map owns the rows.
  RegisterMap(std::vector<RegisterRow> rows, MapPolicy policy);
  RegisterMap(const RegisterMap&) = delete;  // places point into the map
  RegisterMap& operator=(const RegisterMap&) = delete;

  std::span<const RegisterRow> rows() const { return rows_; }
  const MapPolicy& policy() const { return policy_; }
  /// Returns the number of slots in a device's register image.
  int slot_count() const { return slot_count_; }

  /// Returns the register at an address. `part` is the word of the register at that address (the word order
  /// may change while a device runs). The place is empty if this firmware has no register there.
  Place at(Table table, std::uint16_t address, Firmware firmware, bool low_word_first) const;

  /// Returns the sources of bits by address, up to the last bit of the table. Returns none for tables of
  /// words.
  std::span<const BitSource> bit_sources(Table table) const {
    return tables_[static_cast<std::size_t>(table)].bits;
  }

  /// Returns slots by address: the slot of a 32-bit register that begins there, if it exists in every
  /// firmware and its value is exactly that in the image; otherwise Place::kNoSlot. The list is computed
  /// once, and may be shorter than the table.
  std::span<const std::int32_t> stored_pairs(Table table) const {
    return tables_[static_cast<std::size_t>(table)].pairs;
  }

  bool has(Table table) const { return !tables_[static_cast<std::size_t>(table)].entries.empty(); }
  /// Returns the first address after a table.
  int end_of(Table table) const { return tables_[static_cast<std::size_t>(table)].end; }

  /// Finds "Aaxis_Pulse", "Aaxis_Pulse_L" (a half), "STATUS.4" (a bit), "STATUS.READY" (a field), or
  /// "input.NAME" if several tables have that name. "0x1000" is an address in the first table that has a
  /// register there, in this order: holding registers, coils, input registers, discrete inputs. "coil.0x0010"
  /// and "coil.16" are addresses in that table.
  std::optional<NamedPlace> find(std::string_view name, Firmware firmware) const;
  /// Returns a one-line explanation of why find() found nothing: the name does not exist (with the nearest
  /// name), the bit does not exist, or a newer firmware is required.
  std::string why_not(std::string_view name, Firmware firmware) const;

  /// Returns the name of a register in a row: "MAIN_LINE" + number + "_CMD".
  static std::string name_of(const RegisterRow& row, int index);
  static std::string name_of(const RegisterRow& row, int index, std::string_view pattern);
  /// Returns the name, preceded by its table if another table has the same name. find() accepts it.
  std::string unique_name(const RegisterRow& row, int index) const;
  /// Throws std::logic_error if two registers of a table have the same name.
  void require_distinct_names() const { names_.require_distinct(); }

 private:
  void place_words(const RegisterRow& row, int row_number);
  void place_all();
  /// Returns the places that have this name in one table, or in all tables, for this firmware.
  std::vector<Place> places_called(std::optional<Table> table, std::string_view name,
                                   Firmware firmware) const;

  // The row and the index of the register at an address. Rows count from 1; 0 means an unmapped address.
  struct Entry {
    std::uint16_t row_number = 0;
    std::uint16_t index_and_part = 0;  // index * 2 + (second word)
  };
  /// One entry for each possible address. The kernel allocates only the pages that are used.
  struct Entries {
    Entry& operator[](std::size_t address) { return all.get()[address]; }
    Entry operator[](std::size_t address) const { return all.get()[address]; }
    bool empty() const { return all == nullptr; }
    void make();
    struct Free {
      void operator()(Entry* entries) const { std::free(entries); }
    };
    std::unique_ptr<Entry, Free> all;
  };
  struct TableIndex {
    Entries entries;  // empty if the model has no such table
    int end = 0;
    std::vector<BitSource> bits{};      // the sources of bits, by address
    std::vector<std::int32_t> pairs{};  // the slots of pairs, by address
  };
  void find_bit_sources(TableIndex& table) const;
  void find_stored_pairs(TableIndex& table) const;

  std::vector<RegisterRow> kept_rows_;
  std::span<const RegisterRow> rows_;
  RegisterNames names_;
  std::vector<int> first_slots_;
  MapPolicy policy_;
  int slot_count_ = 0;
  std::array<TableIndex, 4> tables_;
};

/// Returns "holding", "input", "coil" or "discrete".
std::string_view to_string(Table table);
std::optional<Table> table_called(std::string_view name);

/// Checks a value against the row's type and range. NaN is outside every range of reals.
bool is_in_range(const RegisterRow& row, Value value);

/// Returns "0 to 3000", or the limits of the width if the manual does not specify a range.
std::string range_text(const RegisterRow& row);
/// The same, for writing `value` to a bit, a field or a half. Returns "NAME within ..." if the value fits in
/// its part but the whole register would be out of range.
std::string range_text(const NamedPlace& named, Value value);

/// Returns a value of that type as text: "-5", or "321.65" for a real.
std::string value_text(Value value, Type type);

/// Returns "1.52" for 152.
std::string version_text(Firmware firmware);

}  // namespace understudy::emulator
