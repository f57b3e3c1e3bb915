// A model's rows, laid out for use: O(1) from an address, by name, and with a slot of the register
// image for every quantity. Made once a model and shared by all its devices.
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

/// One register, or one half of a 32-bit one.
struct Place {
  static constexpr int kNoSlot = -1;

  const RegisterRow* row = nullptr;
  int index = 0;
  int slot = 0;  // in the register image; kNoSlot: a view of other state
  using Part = RegisterPart;
  Part part = Part::whole;

  explicit operator bool() const { return row != nullptr; }
  std::uint16_t address() const {  // of the whole's first word
    return static_cast<std::uint16_t>(row->address + index * row->stride);
  }
  bool is_second_word(bool low_word_first) const {
    return part != Part::whole && (part == Part::high) == low_word_first;
  }
  /// Whether both are words of one register.
  bool is_same_register(const Place& other) const { return row == other.row && index == other.index; }
};

/// A place, or bits of it: "STATUS.4", "STATUS.READY".
struct NamedPlace {
  Place place;
  int bit = -1;   // the lowest of them; -1: the whole
  int width = 1;  // how many

  bool is_real() const { return bit < 0 && place.part == Place::Part::whole && place.row->type == Type::f32; }
};

/// How a bit is read, worked out once: hosts read hundreds in a request.
struct BitSource {
  enum class How : std::uint8_t {
    asks,      // by its row, as at() finds it; also where nothing is
    reader,    // of a row that every firmware has: `slot` is its number, `run` the index in it
    stored,    // in the image
    constant,  // 0 or 1, in `slot`
  } how = How::asks;
  // So many begin here: of stored bits in neighbouring slots, of equal constants.
  std::uint16_t run = 1;
  std::int32_t slot = 0;
};

class RegisterMap {
 public:
  /// Of rows that outlive it. Throws std::logic_error if two rows of a table claim one address, or a row does
  /// not make sense.
  RegisterMap(std::span<const RegisterRow> rows, MapPolicy policy);
  /// The same of rows that it keeps.
  RegisterMap(std::vector<RegisterRow> rows, MapPolicy policy);
  RegisterMap(const RegisterMap&) = delete;  // places point into it
  RegisterMap& operator=(const RegisterMap&) = delete;

  std::span<const RegisterRow> rows() const { return rows_; }
  const MapPolicy& policy() const { return policy_; }
  /// How many slots a device's register image has.
  int slot_count() const { return slot_count_; }

  /// The register at an address; `part` says which word of it (the order of words may change while a
  /// device runs). Empty if nothing is there, for this firmware.
  Place at(Table table, std::uint16_t address, Firmware firmware, bool low_word_first) const;

  /// By address, up to the last bit of a table of bits; empty for the others.
  std::span<const BitSource> bit_sources(Table table) const {
    return tables_[static_cast<std::size_t>(table)].bits;
  }

  /// By address: the slot of a 32-bit register that begins there and is simply what the image holds, for
  /// every firmware; else Place::kNoSlot. Worked out once, too. May end before the table does.
  std::span<const std::int32_t> stored_pairs(Table table) const {
    return tables_[static_cast<std::size_t>(table)].pairs;
  }

  bool has(Table table) const { return !tables_[static_cast<std::size_t>(table)].entries.empty(); }
  /// Behind the last address of a table.
  int end_of(Table table) const { return tables_[static_cast<std::size_t>(table)].end; }

  /// "Aaxis_Pulse", "Aaxis_Pulse_L" (a half), "STATUS.4" (a bit), "STATUS.READY" (a field), "input.NAME"
  /// where several tables have that name. "0x1000" is an address of the first table that has it: holding
  /// registers, coils, input registers, discrete inputs. "coil.0x0010" and "coil.16" are of that table.
  std::optional<NamedPlace> find(std::string_view name, Firmware firmware) const;
  /// Why find() found nothing, as one line: no such name (and the nearest), no such bit, a newer firmware.
  std::string why_not(std::string_view name, Firmware firmware) const;

  /// "MAIN_LINE" + number + "_CMD": the name of a row's register.
  static std::string name_of(const RegisterRow& row, int index);
  static std::string name_of(const RegisterRow& row, int index, std::string_view pattern);
  /// The same with its table in front where another table has that name as well: find() finds it by that.
  std::string unique_name(const RegisterRow& row, int index) const;
  /// Throws std::logic_error if two registers of a table have one name.
  void demand_distinct_names() const { names_.demand_distinct(); }

 private:
  void place_words(const RegisterRow& row, int row_number);
  void place_all();
  /// Those of a name, in one table or all of them, by this firmware.
  std::vector<Place> places_called(std::optional<Table> table, std::string_view name,
                                   Firmware firmware) const;

  // Which row and index serve an address; row numbers count from 1, so 0 is "nothing here".
  struct Entry {
    std::uint16_t row_number = 0;
    std::uint16_t index_and_part = 0;  // index * 2 + (second word)
  };
  /// One for each address that there can be. The kernel gives the pages that something is in, and no others.
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
    std::vector<BitSource> bits{};      // by address
    std::vector<std::int32_t> pairs{};  // by address
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

/// "holding", "input", "coil", "discrete".
std::string_view to_string(Table table);
std::optional<Table> table_called(std::string_view name);

/// Of a value as the row's type has it. What is not a number is in no range of reals.
bool is_in_range(const RegisterRow& row, Value value);

/// "0 to 3000", or what the width allows where the manual gives no range.
std::string range_text(const RegisterRow& row);
/// The same of a bit, a field or a half that was to become `value`; "NAME within ..." where that would fit,
/// and it is the whole register that would be out of its range.
std::string range_text(const NamedPlace& named, Value value);

/// A value as its type has it: "-5", of a real "321.65".
std::string value_text(Value value, Type type);

/// 152 as "1.52".
std::string version_text(Firmware firmware);

}  // namespace understudy::emulator
