#include "emulator/device/register_map/register_map.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"

namespace understudy::emulator {

std::string RegisterMap::name_of(const RegisterRow& row, int index, std::string_view pattern) {
  const std::size_t hole = pattern.find("{}");
  if (hole == std::string_view::npos) return std::string(pattern);
  return std::string(pattern.substr(0, hole)) + std::to_string(row.first_number + index) +
         std::string(pattern.substr(hole + 2));
}

std::string RegisterMap::name_of(const RegisterRow& row, int index) { return name_of(row, index, row.name); }

RegisterMap::RegisterMap(std::span<const RegisterRow> rows, MapPolicy policy)
    : rows_(rows.begin(), rows.end()), policy_(policy) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    first_slots_.push_back(slot_count_);
    place_words(rows_[i], static_cast<int>(i) + 1);
    name_places(rows_[i], slot_count_);
    slot_count_ += rows_[i].count;
  }
}

void RegisterMap::place_words(const RegisterRow& row, int row_number) {
  TableIndex& table = tables_[static_cast<std::size_t>(row.table)];
  if (table.entries.empty()) table.entries.resize(65536);
  const int words = is_32_bit(row.type) ? 2 : 1;
  for (int index = 0; index < row.count; ++index) {
    for (int word = 0; word < words; ++word) {
      const int address = row.address + index * row.stride + word;
      Entry& entry = table.entries.at(static_cast<std::size_t>(address));
      if (entry.row_number != 0) {
        throw std::logic_error("register map: " + name_of(row, index) +
                               " shares its address with another register");
      }
      entry = {static_cast<std::uint16_t>(row_number), static_cast<std::uint16_t>(index * 2 + word)};
    }
  }
}

void RegisterMap::add_name(const std::string& name, const Place& place) {
  if (!names_.emplace(name, place).second) {
    throw std::logic_error("register map: two registers are named " + name);
  }
  names_in_order_.push_back(name);
}

void RegisterMap::name_places(const RegisterRow& row, int first_slot) {
  for (int index = 0; index < row.count; ++index) {
    Place place{.row = &row, .index = index, .slot = first_slot + index};
    for (const std::string_view pattern : {row.name, row.alias}) {
      if (pattern.empty()) continue;
      const std::string name = name_of(row, index, pattern);
      place.part = Place::Part::whole;
      add_name(name, place);
      if (!is_32_bit(row.type)) continue;
      place.part = Place::Part::low;
      add_name(name + std::string(row.low_half), place);
      place.part = Place::Part::high;
      add_name(name + std::string(row.high_half), place);
    }
  }
}

Place RegisterMap::at(Table table, std::uint16_t address, Firmware firmware, bool low_word_first) const {
  const TableIndex& index = tables_[static_cast<std::size_t>(table)];
  if (index.entries.empty()) return {};
  const Entry entry = index.entries[address];
  if (entry.row_number == 0) return {};
  const std::size_t row_number = entry.row_number - 1U;
  const RegisterRow& row = rows_[row_number];
  if (firmware < row.since) return {};
  Place place{.row = &row,
              .index = entry.index_and_part / 2,
              .slot = first_slots_[row_number] + entry.index_and_part / 2};
  if (is_32_bit(row.type)) {
    const bool second_word = entry.index_and_part % 2 != 0;
    place.part = second_word == low_word_first ? Place::Part::high : Place::Part::low;
  }
  return place;
}

namespace {

/// "0x1000": the address that a name is.
std::optional<std::uint16_t> address_of(std::string_view name) {
  std::uint16_t address = 0;
  if (!name.starts_with("0x") || name.size() < 3) return std::nullopt;
  const auto [end, error] = std::from_chars(name.data() + 2, name.data() + name.size(), address, 16);
  if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  return address;
}

/// The word there, in the first table that has one; empty if none has. The model's own order of words counts.
Place word_at(const RegisterMap& map, std::uint16_t address, Firmware firmware) {
  for (const Table table : {Table::holding, Table::coil, Table::input, Table::discrete}) {
    if (const Place place = map.at(table, address, firmware, map.policy().low_word_first)) return place;
  }
  return {};
}

}  // namespace

std::optional<NamedPlace> RegisterMap::find(std::string_view name, Firmware firmware) const {
  NamedPlace found;
  if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) {
    const std::string_view digits = name.substr(dot + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), found.bit);
    if (error != std::errc{} || end != digits.data() + digits.size() || found.bit < 0) return std::nullopt;
    name = name.substr(0, dot);
  }
  if (const auto address = address_of(name)) {
    found.place = word_at(*this, *address, firmware);
    if (!found.place) return std::nullopt;
  } else {
    const auto it = names_.find(std::string(name));
    if (it == names_.end() || firmware < it->second.row->since) return std::nullopt;
    found.place = it->second;
  }
  const bool whole_32 = is_32_bit(found.place.row->type) && found.place.part == Place::Part::whole;
  if (found.bit >= (whole_32 ? 32 : 16)) return std::nullopt;
  return found;
}

std::string version_text(Firmware firmware) {
  const std::string digits = std::to_string(1000 + firmware % 1000).substr(1);
  return digits.substr(0, 1) + "." + digits.substr(1);
}

std::string RegisterMap::why_not(std::string_view name, Firmware firmware) const {
  const std::string_view base = name.substr(0, name.rfind('.'));
  if (const auto it = names_.find(std::string(base)); it != names_.end()) {
    if (firmware < it->second.row->since) {
      return "register " + quoted(base) + " exists from firmware " + version_text(it->second.row->since) +
             " on";
    }
    const bool whole_32 = is_32_bit(it->second.row->type) && it->second.part == Place::Part::whole;
    return "register " + quoted(base) + " has no bit " +
           quoted(name.substr(std::min(base.size() + 1, name.size()))) + "; expected 0 to " +
           (whole_32 ? "31" : "15");
  }
  if (const auto address = address_of(base)) {
    if (find(base, firmware)) {
      return std::string(base) + " has no bit " + quoted(name.substr(base.size() + 1)) + "; expected 0 to 15";
    }
    return "no register is at " + std::string(base);
  }
  return "no register is called " + quoted(name) + suggestion(base, names_in_order_);
}

std::string range_text(const RegisterRow& row) {
  if (row.stored_bits < 0xFFFF) return "0 to " + std::to_string(row.stored_bits);
  if (row.ranged) return std::to_string(row.min) + " to " + std::to_string(row.max);
  switch (row.type) {
    case Type::u16: return "0 to 65535";
    case Type::s16: return "-32768 to 32767";
    case Type::u32: return "0 to 4294967295";
    case Type::s32: return "-2147483648 to 2147483647";
  }
  return "";
}

}  // namespace understudy::emulator
