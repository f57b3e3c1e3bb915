#include "emulator/device/register_map/row_sense.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"

namespace understudy::emulator {

namespace {

constexpr int kMaxOfARow = 32768;  // RegisterMap has 15 bits for the index

struct Require {
  const RegisterRow& row;
  void operator()(bool holds, const char* what) const {
    if (!holds) throw std::logic_error("register map: " + std::string(row.name) + " " + what);
  }
};

/// Returns true if find() can find the name. It would interpret "0x10" as an address, "A.B" as a bit, and
/// "input.A" as a register in a table.
bool is_name(std::string_view name) {
  return !name.empty() && name.find('.') == std::string_view::npos && (name[0] < '0' || name[0] > '9') &&
         !table_called(name);
}

bool is_number(std::string_view name) {
  return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

void validate_names(const RegisterRow& row, const Require& require) {
  require(is_name(row.name), "is not a valid register name");
  require(row.alias.empty() || is_name(row.alias), "has an alias that is not a valid register name");
  require(row.count == 1 || row.name.find("{}") != std::string_view::npos,
          "has several registers, but no {} in its name");
  require(row.labels.empty() || row.labels.size() == static_cast<std::size_t>(row.count),
          "has a different number of labels");
  require(row.first_axis >= 0 && (row.first_axis == 0 || !row.labels.empty()),
          "begins with a different axis, but is not a row for several axes");
}

void validate_place(const RegisterRow& row, const Require& require) {
  const bool is_bit = row.type == Type::bit;
  require(is_bit == is_table_of_bits(row.table), "is not as wide as its table");
  require(row.count >= 1, "has no registers");
  require(row.count <= kMaxOfARow, "has more than 32,768 registers");
  const int words = is_32_bit(row.type) ? 2 : 1;
  require(row.count == 1 || row.stride >= words, "has registers that overlap");
  require(row.address + (row.count - 1) * std::int64_t{row.stride} + words <= 65536,
          "goes beyond address 0xFFFF");
  const bool is_read_only_table = row.table == Table::input || row.table == Table::discrete;
  require(!is_read_only_table || row.access == Access::read, "is in a table that hosts cannot write");
}

/// Returns true if the lower limit does not exceed the upper limit. Reals are compared as reals, because
/// their bits have a different order.
bool is_in_order(const RegisterRow& row) {
  if (row.type == Type::f32) return real_of(row.min) <= real_of(row.max);
  return row.min <= row.max;
}

void validate_values(const RegisterRow& row, const Require& require) {
  const TypeLimits limits = limits_of(row.type);
  const auto fits = [&](Value value) { return value >= limits.lowest && value <= limits.highest; };
  require(fits(row.factory), "has a factory value that it cannot hold");
  require(!row.ranged || (fits(row.min) && fits(row.max)), "has a range that it cannot hold");
  require(!row.ranged || is_in_order(row), "has a range that ends before it begins");
  require(row.stored_bits == 0xFFFF'FFFF || row.type != Type::f32, "is a real, which must be stored whole");
  require(row.stored_bits != 0, "stores no bit of what is written");
}

void validate_acts(const RegisterRow& row, const Require& require) {
  const bool can_be_written = row.access != Access::read;
  require(!row.is_view || !row.persistent, "is a view, which stores nothing");
  require(can_be_written || (row.effect == nullptr && row.acts_on_zero), "is read-only, but has an effect");
  require(row.access != Access::write || row.reader == nullptr, "is write-only, but has a reader");
  require((row.varies == Varies::with_time) == (row.next_change != nullptr),
          "must say at which ticks its value changes if it changes with time, and only then");
  require(!row.is_view || !can_be_written || row.effect != nullptr || row.message != nullptr,
          "is a view that can be written, but nothing handles the write");
  if (row.message == nullptr) return;
  require(row.table == Table::holding && row.type == Type::u16 && row.stride == 1 && row.min_words >= 1 &&
              row.min_words <= row.count,
          "is not a window of words");
  require(row.access == Access::write && row.is_view && row.effect == nullptr && row.fields.empty(),
          "is a window, which accepts only messages");
  require(!row.ranged, "is a window, whose words are checked by its message");
}

void validate_fields(const RegisterRow& row, const Require& require) {
  require(row.fields.empty() || (row.type != Type::bit && row.type != Type::f32),
          "has fields, but no bits for them");
  std::uint32_t taken = 0;
  for (const BitField& field : row.fields) {
    require(field.bit >= 0 && field.width >= 1 && field.bit + field.width <= width_of(row.type),
            "has a field outside its bits");
    require((taken & field.mask()) == 0, "has two fields that share a bit");
    taken |= field.mask();
    require(!field.name.empty() && field.name.find('.') == std::string_view::npos && !is_number(field.name),
            "has a field with an invalid name");
    const auto same = std::count_if(row.fields.begin(), row.fields.end(),
                                    [&](const BitField& other) { return other.name == field.name; });
    require(same == 1, "has two fields with the same name");
    require(field.reader == nullptr || row.reader == nullptr,
            "has a reader, and a field with a different reader");
  }
}

}  // namespace

void validate_rows(const RegisterRow& row) {
  const Require require{row};
  validate_place(row, require);
  validate_names(row, require);
  validate_values(row, require);
  validate_acts(row, require);
  validate_fields(row, require);
}

}  // namespace understudy::emulator
