// A model's rows, laid out for use: O(1) from an address, by name, and with a slot of the register
// image for every quantity. Made once a model and shared by all its devices.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

/// One register, or one half of a 32-bit one.
struct Place {
  const RegisterRow* row = nullptr;
  int index = 0;
  int slot = 0;  // in the register image
  enum class Part : std::uint8_t { whole, low, high } part = Part::whole;

  explicit operator bool() const { return row != nullptr; }
  std::uint16_t address() const {  // of the whole's first word
    return static_cast<std::uint16_t>(row->address + index * row->stride);
  }
};

/// A place, or a bit of it: "STATUS.4".
struct NamedPlace {
  Place place;
  int bit = -1;
};

class RegisterMap {
 public:
  /// Throws std::logic_error if two rows claim one address or one name.
  RegisterMap(std::span<const RegisterRow> rows, MapPolicy policy);
  RegisterMap(const RegisterMap&) = delete;  // places point into it
  RegisterMap& operator=(const RegisterMap&) = delete;

  std::span<const RegisterRow> rows() const { return rows_; }
  const MapPolicy& policy() const { return policy_; }
  /// How many slots a device's register image has.
  int slot_count() const { return slot_count_; }

  /// The register at an address; `part` says which word of it (the order of words may change while a
  /// device runs). Empty if nothing is there, for this firmware.
  Place at(Table table, std::uint16_t address, Firmware firmware, bool low_word_first) const;

  /// "Aaxis_Pulse", "Aaxis_Pulse_L" (a half), "STATUS.4" (a bit).
  std::optional<NamedPlace> find(std::string_view name, Firmware firmware) const;
  /// Why find() found nothing, as one line: no such name (and the nearest), no such bit, a newer firmware.
  std::string why_not(std::string_view name, Firmware firmware) const;

  /// "MAIN_LINE" + number + "_CMD": the name of a row's register.
  static std::string name_of(const RegisterRow& row, int index);
  static std::string name_of(const RegisterRow& row, int index, std::string_view pattern);

 private:
  void place_words(const RegisterRow& row, int row_number);
  void name_places(const RegisterRow& row, int first_slot);
  void add_name(const std::string& name, const Place& place);

  // Which row and index serve an address; row numbers count from 1, so 0 is "nothing here".
  struct Entry {
    std::uint16_t row_number = 0;
    std::uint16_t index_and_part = 0;  // index * 2 + (second word)
  };
  struct TableIndex {
    std::vector<Entry> entries;  // 65,536, or none if the model has no such table
  };

  std::vector<RegisterRow> rows_;
  std::vector<int> first_slots_;
  MapPolicy policy_;
  int slot_count_ = 0;
  std::array<TableIndex, 4> tables_;
  std::unordered_map<std::string, Place> names_;  // looked up, never iterated
  std::vector<std::string> names_in_order_;
};

/// "0 to 3000", or what the width allows where the manual gives no range.
std::string range_text(const RegisterRow& row);

/// 152 as "1.52".
std::string version_text(Firmware firmware);

}  // namespace understudy::emulator
