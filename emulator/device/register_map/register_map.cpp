#include "emulator/device/register_map/register_map.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/register_map/row_sense.h"
#include "emulator/device/register_map/wire_words.h"

namespace understudy::emulator {

std::string RegisterMap::name_of(const RegisterRow& row, int index, std::string_view pattern) {
  return RegisterNames::name_of(row, index, pattern);
}

std::string RegisterMap::name_of(const RegisterRow& row, int index) { return name_of(row, index, row.name); }

std::string RegisterMap::unique_name(const RegisterRow& row, int index) const {
  std::string name = name_of(row, index);
  if (places_called(std::nullopt, name, UINT16_MAX).size() < 2) return name;
  return std::string(to_string(row.table)) + "." + name;
}

namespace {

constexpr std::array<std::pair<std::string_view, Table>, 4> kTables{{{"holding", Table::holding},
                                                                     {"coil", Table::coil},
                                                                     {"input", Table::input},
                                                                     {"discrete", Table::discrete}}};

/// Returns true if reading the row returns its stored value, in every firmware.
bool reads_plainly(const RegisterRow& row) {
  return row.since == 0 && row.not_implemented.empty() && row.fields.empty() && row.access != Access::write &&
         row.message == nullptr;
}

}  // namespace

RegisterMap::RegisterMap(std::span<const RegisterRow> rows, MapPolicy policy)
    : rows_(rows), names_(rows_), policy_(policy) {
  place_all();
}

RegisterMap::RegisterMap(std::vector<RegisterRow> rows, MapPolicy policy)
    : kept_rows_(std::move(rows)), rows_(kept_rows_), names_(rows_), policy_(policy) {
  place_all();
}

void RegisterMap::Entries::make() {
  constexpr std::size_t kAddresses = 65'536;
  all.reset(static_cast<Entry*>(std::calloc(kAddresses, sizeof(Entry))));
  if (all == nullptr) throw std::bad_alloc();
}

void RegisterMap::place_all() {
  if (rows_.size() >= UINT16_MAX)
    throw std::logic_error("register map: too many rows; expected at most 65,534");
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const RegisterRow& row = rows_[i];
    validate_rows(row);
    const int first_slot = row.is_view ? Place::kNoSlot : slot_count_;
    first_slots_.push_back(first_slot);
    place_words(row, static_cast<int>(i) + 1);
    if (!row.is_view) slot_count_ += row.count;
  }
  for (const Table bits : {Table::coil, Table::discrete})
    find_bit_sources(tables_[static_cast<std::size_t>(bits)]);
  for (const Table words : {Table::holding, Table::input})
    find_stored_pairs(tables_[static_cast<std::size_t>(words)]);
  if (!policy_.word_order_in.empty() && !names_.find(Table::holding, policy_.word_order_in)) {
    throw std::logic_error("register map: " + std::string(policy_.word_order_in) +
                           " holds the word order, but is not a holding register");
  }
}

void RegisterMap::place_words(const RegisterRow& row, int row_number) {
  TableIndex& table = tables_[static_cast<std::size_t>(row.table)];
  if (table.entries.empty()) table.entries.make();
  const int words = is_32_bit(row.type) ? 2 : 1;
  for (int index = 0; index < row.count; ++index) {
    for (int word = 0; word < words; ++word) {
      const int address = row.address + index * row.stride + word;
      Entry& entry = table.entries[static_cast<std::size_t>(address)];
      if (entry.row_number != 0) {
        const RegisterRow& other = rows_[entry.row_number - 1U];
        throw std::logic_error("register map: " + name_of(row, index) + " shares its address with " +
                               name_of(other, entry.index_and_part / 2));
      }
      entry = {static_cast<std::uint16_t>(row_number), static_cast<std::uint16_t>(index * 2 + word)};
      table.end = std::max(table.end, address + 1);
    }
  }
}

/// Fills the table from the end, so that each entry can count how many equal entries follow.
void RegisterMap::find_bit_sources(TableIndex& table) const {
  using How = BitSource::How;
  table.bits.resize(static_cast<std::size_t>(table.end));
  for (std::size_t address = table.bits.size(); address-- > 0;) {
    const Entry entry = table.entries[address];
    if (entry.row_number == 0) continue;
    const RegisterRow& row = rows_[entry.row_number - 1U];
    if (!reads_plainly(row)) continue;
    BitSource& source = table.bits[address];
    if (row.reader != nullptr) {
      source = {.how = How::reader,
                .run = static_cast<std::uint16_t>(entry.index_and_part / 2),
                .slot = entry.row_number - 1};
    } else {
      const bool is_constant = row.is_view;
      source.how = is_constant ? How::constant : How::stored;
      source.slot = is_constant ? static_cast<std::int32_t>(row.factory & 1)
                                : first_slots_[entry.row_number - 1U] + entry.index_and_part / 2;
      if (address + 1 == table.bits.size()) continue;
      const BitSource& next = table.bits[address + 1];
      const bool continues =
          next.how == source.how && next.slot == source.slot + (is_constant ? 0 : 1) && next.run < UINT16_MAX;
      if (continues) source.run = static_cast<std::uint16_t>(next.run + 1);
    }
  }
}

void RegisterMap::find_stored_pairs(TableIndex& table) const {
  for (std::size_t address = 0; address < static_cast<std::size_t>(table.end); ++address) {
    const Entry entry = table.entries[address];
    if (entry.row_number == 0 || entry.index_and_part % 2 != 0) continue;
    const RegisterRow& row = rows_[entry.row_number - 1U];
    if (!is_32_bit(row.type) || row.swaps_words || row.swaps_bytes || row.is_view || row.reader != nullptr ||
        !reads_plainly(row))
      continue;
    table.pairs.resize(address + 1, Place::kNoSlot);
    table.pairs[address] = first_slots_[entry.row_number - 1U] + entry.index_and_part / 2;
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
  const int index_in_row = entry.index_and_part / 2;
  Place place{.row = &row,
              .index = index_in_row,
              .slot = row.is_view ? Place::kNoSlot : first_slots_[row_number] + index_in_row};
  if (is_32_bit(row.type)) {
    const bool second_word = entry.index_and_part % 2 != 0;
    place.part = second_word == has_low_first(row, low_word_first) ? Place::Part::high : Place::Part::low;
  }
  return place;
}

namespace {

/// Returns the address in a name such as "0x1000". After the name of a table, the address can also be
/// decimal: "coil.20".
std::optional<std::uint16_t> address_of(std::string_view name, std::optional<Table> table) {
  std::uint16_t address = 0;
  const bool is_hexadecimal = name.starts_with("0x");
  if (!is_hexadecimal && !table) return std::nullopt;
  const char* const first = name.data() + (is_hexadecimal ? 2 : 0);
  const auto [end, error] =
      std::from_chars(first, name.data() + name.size(), address, is_hexadecimal ? 16 : 10);
  if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  return address;
}

/// Returns the word at an address in the first table that has a word there, or an empty place. It uses the
/// model's own word order.
Place word_at(const RegisterMap& map, std::optional<Table> only, std::uint16_t address, Firmware firmware) {
  for (const auto& [name, table] : kTables) {
    if (only && *only != table) continue;
    if (const Place place = map.at(table, address, firmware, map.policy().low_word_first)) return place;
  }
  return {};
}

/// A name without its table, and that table: "input.NAME".
struct InTable {
  std::optional<Table> table;
  std::string_view name;
};
InTable without_table(std::string_view name) {
  if (const std::size_t dot = name.find('.'); dot != std::string_view::npos) {
    if (const auto table = table_called(name.substr(0, dot))) return {table, name.substr(dot + 1)};
  }
  return {std::nullopt, name};
}

/// Returns the width of a place in bits.
int bits_at(const Place& place) {
  const int width = width_of(place.row->type);
  return place.part == Place::Part::whole ? width : 16;
}

/// Returns the bits of a place to which a number or a field name refers, or nothing if there are no such
/// bits.
std::optional<NamedPlace> bits_called(const Place& place, std::string_view name) {
  if (place.row->type == Type::bit) return std::nullopt;
  int bit = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), bit);
  if (error == std::errc{} && end == name.data() + name.size()) {
    if (bit < 0 || bit >= bits_at(place)) return std::nullopt;
    return NamedPlace{.place = place, .bit = bit};
  }
  if (place.part != Place::Part::whole) return std::nullopt;
  for (const BitField& field : place.row->fields) {
    if (field.name == name) return NamedPlace{.place = place, .bit = field.bit, .width = field.width};
  }
  return std::nullopt;
}

std::string expected_bits(const Place& place) {
  if (place.row->type == Type::bit) return "expected none: it is a bit itself";
  std::string text = "expected 0 to " + std::to_string(bits_at(place) - 1);
  if (place.part != Place::Part::whole) return text;
  for (const BitField& field : place.row->fields) text += ", " + std::string(field.name);
  return text;
}

}  // namespace

std::vector<Place> RegisterMap::places_called(std::optional<Table> table, std::string_view name,
                                              Firmware firmware) const {
  std::vector<Place> places;
  for (const auto& [word, listed] : kTables) {
    if ((table && *table != listed) || !has(listed)) continue;
    const auto named = names_.find(listed, name);
    if (!named || firmware < rows_[named->row].since) continue;
    const RegisterRow& row = rows_[named->row];
    places.push_back({.row = &row,
                      .index = named->index,
                      .slot = row.is_view ? Place::kNoSlot : first_slots_[named->row] + named->index,
                      .part = named->part});
  }
  return places;
}

std::optional<NamedPlace> RegisterMap::find(std::string_view name, Firmware firmware) const {
  const auto [table, alone] = without_table(name);
  const std::size_t dot = alone.rfind('.');
  const std::string_view base = alone.substr(0, dot);
  Place place;
  if (const auto address = address_of(base, table)) {
    place = word_at(*this, table, *address, firmware);
  } else if (const auto places = places_called(table, base, firmware); places.size() == 1) {
    place = places.front();
  }
  if (!place) return std::nullopt;
  if (dot == std::string_view::npos) return NamedPlace{.place = place};
  return bits_called(place, alone.substr(dot + 1));
}

std::string version_text(Firmware firmware) {
  const std::string digits = std::to_string(1000 + firmware % 1000).substr(1);
  return digits.substr(0, 1) + "." + digits.substr(1);
}

std::string RegisterMap::why_not(std::string_view name, Firmware firmware) const {
  const auto [table, alone] = without_table(name);
  const std::string_view base = alone.substr(0, alone.rfind('.'));
  const std::string_view bit = alone.substr(std::min(base.size() + 1, alone.size()));
  const auto places = places_called(table, base, firmware);
  if (places.size() > 1) {
    std::string text = quoted(base) + " is in several tables; expected one of ";
    for (const Place& place : places) {
      text += (&place == &places.front() ? "" : ", ") + std::string(to_string(place.row->table)) + "." +
              std::string(alone);
    }
    return text;
  }
  if (places.size() == 1) {
    return "register " + quoted(base) + " has no bit " + quoted(bit) + "; " + expected_bits(places.front());
  }
  if (const auto newer = places_called(table, base, UINT16_MAX); !newer.empty()) {
    return "register " + quoted(base) + " exists from firmware " + version_text(newer.front().row->since) +
           " on";
  }
  if (const auto address = address_of(base, table)) {
    if (const Place place = word_at(*this, table, *address, firmware)) {
      return std::string(base) + " has no bit " + quoted(bit) + "; " + expected_bits(place);
    }
    const std::string in_table = table ? " of the table " + quoted(to_string(*table)) : "";
    return "no register is at " + std::string(base) + in_table;
  }
  if (table && !places_called(std::nullopt, base, firmware).empty()) {
    return quoted(base) + " is not in the table " + quoted(to_string(*table)) + "; expected " +
           std::string(to_string(places_called(std::nullopt, base, firmware).front().row->table)) + "." +
           std::string(alone);
  }
  std::vector<std::string> names;
  names_.for_each([&](const RegisterNames::Named&, const std::string& one) { names.push_back(one); });
  return "no register is called " + quoted(name) + suggestion(base, names);
}

std::string_view to_string(Table table) {
  for (const auto& [name, known] : kTables) {
    if (known == table) return name;
  }
  return "";
}

std::optional<Table> table_called(std::string_view name) {
  for (const auto& [known, table] : kTables) {
    if (known == name) return table;
  }
  return std::nullopt;
}

namespace {

/// Returns the shortest text that parses to this single-precision number.
std::string real_text(Value value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), real_of(value));
  return error == std::errc{} ? std::string(text.data(), end) : std::string();
}

}  // namespace

std::string value_text(Value value, Type type) {
  return type == Type::f32 ? real_text(value) : std::to_string(value);
}

bool is_in_range(const RegisterRow& row, Value value) {
  if (!row.ranged) return true;
  if (row.type != Type::f32) return value >= row.min && value <= row.max;
  return real_of(value) >= real_of(row.min) && real_of(value) <= real_of(row.max);
}

std::string range_text(const RegisterRow& row) {
  if (row.stored_bits < 0xFFFF && row.type != Type::bit) return "0 to " + std::to_string(row.stored_bits);
  if (row.type == Type::f32) {
    return row.ranged ? real_text(row.min) + " to " + real_text(row.max) : "a real number";
  }
  const TypeLimits limits = row.ranged ? TypeLimits{row.min, row.max} : limits_of(row.type);
  return std::to_string(limits.lowest) + (row.type == Type::bit ? " or " : " to ") +
         std::to_string(limits.highest);
}

std::string range_text(const NamedPlace& named, Value value) {
  const RegisterRow& row = *named.place.row;
  const bool is_half = named.place.part != Place::Part::whole;
  if (named.bit < 0 && !is_half) return range_text(row);
  const Value max = named.bit < 0 ? limits_of(Type::u16).highest : (Value{1} << named.width) - 1;
  if (value < 0 || value > max) return (max == 1 ? "0 or " : "0 to ") + std::to_string(max);
  return RegisterMap::name_of(row, named.place.index) + " within " + range_text(row);
}

}  // namespace understudy::emulator
