#include "emulator/model_file/row_registers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_addresses.h"
#include "emulator/model_file/list_row.h"
#include "emulator/model_file/list_words.h"
#include "emulator/model_file/register_list.h"
#include "emulator/model_file/row_numbers.h"
#include "emulator/model_file/row_shape.h"
#include "emulator/model_file/row_values.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/diagnostics.h"

namespace understudy::emulator::model_file {

using models::imported::BitName;
using models::imported::ListedRegister;

namespace {

/// Returns the table of the row. `by_address` is the table that follows from the form of its address.
Table table_of(const ListRow& row, std::optional<Table> by_address) {
  if (row.has(Column::table) && !listed_table_called(row.text(Column::table))) {
    row.fail(Column::table,
             quoted(row.text(Column::table)) + " is not a table; expected holding, input, coil or discrete");
  }
  const auto in_cells = table_in_cells(row);
  if (in_cells && by_address && *in_cells != *by_address) {
    row.fail(Column::address, quoted(row.text(Column::address)) + " is a number of the table " +
                                  std::string(to_string(*by_address)) + "; expected a number of the table " +
                                  std::string(to_string(*in_cells)));
  }
  if (in_cells) return *in_cells;
  return by_address.value_or(row.context().reading.table);
}

WireAddress address_of(const ListRow& row, const std::optional<PrintedAddress>& printed) {
  if (!row.has(Column::address)) row.fail(Column::address, "is missing; expected an address in every row");
  const AddressReading reading = row.context().addresses;
  if (printed) {
    if (const auto address = wire_address(*printed, reading)) return *address;
  }
  const char* const expected = reading == AddressReading::modicon    ? "one such as 40001, 300001 or 4x0001"
                               : reading == AddressReading::from_one ? "1 to 65536, or 0x0000 to 0xFFFF"
                                                                     : "0 to 65535, or 0x0000 to 0xFFFF";
  row.fail(Column::address, quoted(row.text(Column::address)) + " is not an address; expected " + expected);
}

/// Returns true for a name that commands would take for "NAME=VALUE". Names such as "P>=C-" exist.
bool has_lone_equals_sign(const std::string& name) {
  for (std::size_t at = name.find('='); at != std::string::npos; at = name.find('=', at + 1)) {
    if (at == 0 || (name[at - 1] != '<' && name[at - 1] != '>')) return true;
  }
  return false;
}

/// Returns true for words that have another meaning in expressions.
bool is_taken_word(const std::string& name) {
  constexpr std::array<std::string_view, 7> kWords{"and", "or", "not", "true", "false", "on", "off"};
  return std::find(kWords.begin(), kWords.end(), name) != kWords.end() || table_called(name).has_value();
}

/// Sets the name as printed in the manual. If expressions or commands cannot contain this name, they use a
/// name with other letters. (With a sign at the beginning, it would look like a flag or a comment.)
void read_name(const ListRow& row, ListedRegister& listed) {
  const std::string& name = row.text(Column::name);
  if (name.empty()) row.fail(Column::name, "is missing; expected a name in every row");
  const auto first = static_cast<unsigned char>(name[0]);
  const bool begins_well = std::isalpha(first) != 0 || first == '_' || first >= 0x80;
  const bool is_plain = name.find_first_of(".{}\"") == std::string::npos && one_line(name) == name &&
                        !has_lone_equals_sign(name);
  listed.name = name;
  if (!begins_well || !is_plain || is_taken_word(name)) {
    listed.name = as_word(name);
    if (is_taken_word(listed.name)) listed.name.insert(0, "_");
    if (listed.name.empty()) listed.name = "Register_" + std::to_string(listed.address);
    listed.printed = one_line(name);
    row.remark("name", Column::name, quoted(name) + " is called " + quoted(listed.name) + " here");
  }
}

Access access_of(const ListRow& row, Table table) {
  const bool is_read_only = table == Table::input || table == Table::discrete;
  if (row.has(Column::writable) && !row.has(Column::access)) {
    const auto word = access_called(row.text(Column::writable));
    const auto answer = yes_or_no_called(row.text(Column::writable));
    if (!word && !answer)
      row.remark("writable", Column::writable,
                 quoted(row.text(Column::writable)) + " is unknown; treated as read-only");
    const bool is_written = word ? *word != Access::read : answer.value_or(false);
    return is_written && !is_read_only ? Access::read_write : Access::read;
  }
  if (!row.has(Column::access)) return is_read_only ? Access::read : Access::read_write;
  const auto access = access_called(row.text(Column::access));
  if (!access)
    row.fail(Column::access, quoted(row.text(Column::access)) + " is unknown; expected R, W or R/W");
  if (is_read_only && *access != Access::read)
    row.fail(Column::access,
             "hosts cannot write the table " + std::string(to_string(table)) + "; expected R");
  return *access;
}

/// Returns the first firmware version that has the register.
Firmware since_of(const ListRow& row) {
  if (!row.has(Column::since)) return 0;
  const std::vector<Firmware>& known = row.context().reading.firmwares;
  const Firmware version = parse_firmware(row.text(Column::since));
  const bool is_known = known.empty() || std::find(known.begin(), known.end(), version) != known.end();
  if (version != 0 && is_known) return version == (known.empty() ? 0 : known.front()) ? 0 : version;
  row.fail(Column::since,
           quoted(row.text(Column::since)) +
               " is not a firmware of the model; expected a version listed under `firmware`, such as 1.52");
}

/// Returns one register for each quantity, or for each word of a type that is only stored as words.
std::vector<ListedRegister> spread(const ListRow& row, const RowShape& shape, const ListedRegister& first) {
  if (!shape.holds_only_words() && shape.count == 1) return {first};
  const std::vector<std::uint16_t> words =
      shape.holds_only_words() ? factory_words(row, shape) : std::vector<std::uint16_t>();
  const int count = shape.holds_only_words() ? shape.words * shape.count : shape.count;
  const int stride = shape.holds_only_words() ? 1 : shape.words;
  if (shape.holds_only_words() && count == 1) {
    ListedRegister only = first;
    only.factory = words.front();
    return {only};
  }
  std::vector<ListedRegister> all;
  for (int i = 0; i < count; ++i) {
    ListedRegister one = first;
    one.name = first.name + "_" + std::to_string(i + 1);
    if (!first.printed.empty()) one.printed = first.printed + " " + std::to_string(i + 1);
    one.address = static_cast<std::uint16_t>(first.address + i * stride);
    if (shape.holds_only_words()) one.factory = words[static_cast<std::size_t>(i) % words.size()];
    all.push_back(std::move(one));
  }
  return all;
}

class RowReader {
 public:
  RowReader(const ListRow& row, world::Diagnostics& diagnostics) : row_(row), diagnostics_(diagnostics) {}

  RowRegisters read(const std::optional<PrintedAddress>& printed) {
    ListedRegister listed;
    WireAddress address;
    RowShape shape;
    const bool has_address = attempt([&] { address = address_of(row_, printed); });
    const bool has_table = attempt([&] { listed.table = table_of(row_, address.table); });
    listed.address = address.address;
    attempt([&] { read_name(row_, listed); });
    const bool has_shape =
        has_table && attempt([&] { shape = shape_of(row_, listed.table, printed ? printed->words() : 1); });
    if (has_table) attempt([&] { listed.access = access_of(row_, listed.table); });
    if (has_shape) {
      read_values(shape, listed);
    } else {
      check_numbers(row_, diagnostics_);
    }
    attempt([&] { listed.persistent = row_.yes_or_no(Column::persistent); });
    attempt([&] { listed.since = since_of(row_); });
    if (has_address && has_shape) {
      attempt([&] {
        if (listed.address + shape.words * shape.count <= 65536) return;
        row_.fail(Column::address, shape.words * shape.count == 2
                                       ? std::string("has no room for 32 bits; expected 0xFFFE or below")
                                       : "has no room for " + std::to_string(shape.words * shape.count) +
                                             " registers after it");
      });
    }
    if (is_wrong_) return {};
    RowRegisters made{.registers = spread(row_, shape, listed)};
    const bool is_part = shape.kind == TypeMeaning::Kind::part || (printed && printed->bit >= 0);
    if (is_part && !is_table_of_bits(listed.table) && made.registers.size() == 1)
      made.part = part_of(shape, *printed, listed);
    return made;
  }

 private:
  template <typename Read>
  bool attempt(const Read& read) {
    const bool is_right = diagnostics_.attempt(read);
    is_wrong_ |= !is_right;
    return is_right;
  }

  void read_values(const RowShape& shape, ListedRegister& listed) {
    listed.type = shape.type;
    if (shape.holds_only_words()) listed.type = Type::u16;
    if (!shape.holds_only_words()) listed.order = shape.order;
    listed.is_bcd = shape.kind == TypeMeaning::Kind::decimal;
    if (listed.is_bcd) {
      row_.remark("bcd", Column::type,
                  quoted(row_.text(Column::type)) +
                      " is binary-coded: tools write and show its code, so 25 is 0x25, or 37");
    }
    check_step(row_);
    listed.unit = unit_of(row_);
    attempt([&] {
      if (!row_.has(Column::bits)) return;
      try {
        listed.bits = parse_bits(row_.text(Column::bits), listed.type);
      } catch (const std::invalid_argument& error) {
        row_.fail(Column::bits, error.what());
      }
    });
    is_wrong_ |= !read_numbers(row_, shape, listed, diagnostics_);
  }

  /// Returns the bits of a row with an address such as 10.3, or with the type `4bit`.
  static BitName part_of(const RowShape& shape, const PrintedAddress& printed, const ListedRegister& listed) {
    const int first = std::max(printed.bit, 0);
    const int width = std::clamp(shape.bits == 0 ? 1 : shape.bits, 1, 16 - first);
    const std::string name = as_word(listed.name);
    return {.name = name.empty() ? "bit_" + std::to_string(first) : name, .bit = first, .width = width};
  }

  const ListRow& row_;
  world::Diagnostics& diagnostics_;
  bool is_wrong_ = false;
};

}  // namespace

std::optional<Table> table_in_cells(const ListRow& row) {
  if (row.has(Column::table)) return listed_table_called(row.text(Column::table));
  if (row.has(Column::function)) return table_of_function(row.text(Column::function));
  return std::nullopt;
}

RowRegisters registers_of(const ListRow& row, const std::optional<PrintedAddress>& printed,
                          world::Diagnostics& diagnostics) {
  return RowReader(row, diagnostics).read(printed);
}

}  // namespace understudy::emulator::model_file
