#include "emulator/model_file/list_row.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/csv.h"
#include "emulator/model_file/register_list.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

using models::imported::ListedRegister;

namespace {

constexpr std::array<std::pair<std::string_view, Type>, 14> kTypeWords{{
    {"u16", Type::u16},
    {"s16", Type::s16},
    {"u32", Type::u32},
    {"s32", Type::s32},
    {"f32", Type::f32},
    {"bit", Type::bit},
    {"uint16", Type::u16},
    {"int16", Type::s16},
    {"uint32", Type::u32},
    {"int32", Type::s32},
    {"float", Type::f32},
    {"float32", Type::f32},
    {"real", Type::f32},
    {"bool", Type::bit},
}};

constexpr std::array<std::pair<std::string_view, Access>, 9> kAccessWords{{
    {"r", Access::read},
    {"ro", Access::read},
    {"read", Access::read},
    {"w", Access::write},
    {"wo", Access::write},
    {"write", Access::write},
    {"r/w", Access::read_write},
    {"rw", Access::read_write},
    {"read/write", Access::read_write},
}};

std::string lower(std::string_view text) {
  std::string made(text);
  for (char& c : made) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return made;
}

template <typename Table>
auto find_word(const Table& table, std::string_view word) {
  const std::string key = lower(word);
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.first == key; });
  return found == table.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

std::optional<Column> column_called(std::string_view heading) { return find_word(kHeadings, heading); }

ListRow::ListRow(const CsvRow& row, const std::vector<Column>& columns, const std::string& file,
                 int lines_before)
    : row_(row), file_(file), lines_before_(lines_before) {
  for (std::size_t i = 0; i < row.cells.size() && i < columns.size(); ++i) {
    if (columns[i] != Column::left_out) cells_[static_cast<std::size_t>(columns[i])] = &row.cells[i];
  }
}

std::string ListRow::text(Column column) const {
  const CsvCell* const cell = cells_[static_cast<std::size_t>(column)];
  return cell == nullptr ? std::string() : cell->text;
}

void ListRow::fail(Column column, const std::string& what) const {
  const CsvCell* const cell = cells_[static_cast<std::size_t>(column)];
  const auto heading = std::find_if(kHeadings.begin(), kHeadings.end(),
                                    [&](const auto& entry) { return entry.second == column; });
  throw FileError({file_, line(), cell == nullptr ? 1 : cell->column},
                  std::string(heading->first) + ": " + what);
}

bool ListRow::yes_or_no(Column column) const {
  const std::string word = lower(text(column));
  if (word.empty() || word == "0" || word == "no" || word == "n" || word == "false") return false;
  if (word == "1" || word == "yes" || word == "y" || word == "true" || word == "x") return true;
  fail(column, quoted(text(column)) + " is neither yes nor no; expected 1 or 0");
}

Value ListRow::value(Column column, const std::string& word, Type type) const {
  if (type == Type::f32) {
    const auto real = parse_real(word);
    const auto single = static_cast<float>(real.value_or(0));
    if (!real || single - single != 0) fail(column, quoted(word) + " is not a number; expected one");
    return value_of_real(single);
  }
  const auto number = parse_integer(word);
  const TypeLimits limits = limits_of(type);
  if (!number || *number < limits.lowest || *number > limits.highest) {
    fail(column, quoted(word) + " is not possible; expected a whole number from " +
                     std::to_string(limits.lowest) + " to " + std::to_string(limits.highest));
  }
  return *number;
}

namespace {

Table table_of(const ListRow& row) {
  if (!row.has(Column::table)) return Table::holding;
  if (const auto table = table_called(lower(row.text(Column::table)))) return *table;
  row.fail(Column::table,
           quoted(row.text(Column::table)) + " is not a table; expected holding, input, coil or discrete");
}

std::uint16_t address_of(const ListRow& row) {
  const auto address = parse_integer(row.text(Column::address));
  if (!row.has(Column::address)) row.fail(Column::address, "is missing; expected one in every row");
  if (address && *address >= 0 && *address <= 65535) return static_cast<std::uint16_t>(*address);
  row.fail(Column::address, quoted(row.text(Column::address)) +
                                " is not an address; expected 0 to 65535, or 0x0000 to 0xFFFF");
}

std::string name_of(const ListRow& row) {
  const std::string name = row.text(Column::name);
  if (name.empty()) row.fail(Column::name, "is missing; expected one in every row");
  const bool begins_well = !(name[0] >= '0' && name[0] <= '9');
  const bool is_plain = name.find_first_of(".{}\"") == std::string::npos && one_line(name) == name;
  if (!begins_well || !is_plain || table_called(name)) {
    row.fail(Column::name,
             quoted(name) +
                 " cannot be used as a name; expected one that does not begin with a digit, is not "
                 "a table, and has none of . { } \"");
  }
  return name;
}

/// Requires that columns agree. A list may say the same thing twice, but not two different things.
void require_agreement(const ListRow& row, Type type) {
  const auto require = [&](Column column, bool agrees) {
    if (!row.has(column) || agrees) return;
    row.fail(column, quoted(row.text(column)) + " contradicts the type " + quoted(row.text(Column::type)) +
                         "; expected the same, or one of the two");
  };
  require(Column::width, row.text(Column::width) == std::to_string(width_of(type)));
  require(Column::real, row.yes_or_no(Column::real) == (type == Type::f32));
  require(Column::is_signed, type == Type::f32 || row.yes_or_no(Column::is_signed) == is_signed(type));
}

Type type_of(const ListRow& row, Table table) {
  if (row.has(Column::type)) {
    const auto type = find_word(kTypeWords, row.text(Column::type));
    if (!type) {
      row.fail(Column::type,
               quoted(row.text(Column::type)) + " is not a type; expected u16, s16, u32, s32, f32 or bit");
    }
    if ((*type == Type::bit) != is_table_of_bits(table))
      row.fail(Column::type,
               "is not as wide as its table; expected bit in coil and discrete, and only there");
    require_agreement(row, *type);
    return *type;
  }
  const std::string width = row.text(Column::width);
  if (is_table_of_bits(table)) {
    if (!width.empty() && width != "1")
      row.fail(Column::width, quoted(width) + " is not possible there; expected 1");
    return Type::bit;
  }
  if (!width.empty() && width != "16" && width != "32")
    row.fail(Column::width,
             quoted(width) + " is not possible; expected 16 or 32, and 1 in coil and discrete");
  const bool is_wide = width == "32";
  if (row.yes_or_no(Column::real)) {
    if (!is_wide) row.fail(Column::real, "a real number has 32 bits; expected the width 32");
    return Type::f32;
  }
  const std::string least = row.has(Column::least) ? row.text(Column::least) : row.text(Column::range);
  const bool has_sign =
      row.has(Column::is_signed) ? row.yes_or_no(Column::is_signed) : least.starts_with('-');
  if (is_wide) return has_sign ? Type::s32 : Type::u32;
  return has_sign ? Type::s16 : Type::u16;
}

Access access_of(const ListRow& row, Table table) {
  const bool is_read_only = table == Table::input || table == Table::discrete;
  if (!row.has(Column::access)) return is_read_only ? Access::read : Access::read_write;
  const auto access = find_word(kAccessWords, row.text(Column::access));
  if (!access)
    row.fail(Column::access, quoted(row.text(Column::access)) + " is unknown; expected R, W or R/W");
  if (is_read_only && *access != Access::read)
    row.fail(Column::access,
             "hosts cannot write the table " + std::string(to_string(table)) + "; expected R");
  return *access;
}

/// Returns the two ends of "0..3000", "-5 to 5" or "0-100", as they are written.
std::optional<std::pair<std::string, std::string>> ends_of(const std::string& range) {
  const auto trim = [](std::string text) {
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    return text.substr(0, text.find_last_not_of(' ') + 1);
  };
  for (const std::string between : {"..", " to ", "~", "-"}) {
    const std::size_t at = range.find(between, 1);
    if (range.empty() || at == std::string::npos) continue;
    return std::pair(trim(range.substr(0, at)), trim(range.substr(at + between.size())));
  }
  return std::nullopt;
}

bool is_before(Value a, Value b, Type type) { return type == Type::f32 ? real_of(a) < real_of(b) : a < b; }

void read_range(const ListRow& row, ListedRegister& listed) {
  std::string least = row.text(Column::least);
  std::string most = row.text(Column::most);
  Column first = Column::least;
  Column last = Column::most;
  if (row.has(Column::range)) {
    if (!least.empty() || !most.empty())
      row.fail(Column::range, "cannot be combined with min and max; expected one of the two");
    first = last = Column::range;
    const auto ends = ends_of(row.text(Column::range));
    if (!ends) row.fail(Column::range, quoted(row.text(Column::range)) + " is not a range; expected 0..3000");
    std::tie(least, most) = *ends;
  }
  if (least.empty() && most.empty()) return;
  if (least.empty() || most.empty())
    row.fail(least.empty() ? last : first, "is given alone; expected both min and max, or neither");
  listed.least = row.value(first, least, listed.type);
  listed.most = row.value(last, most, listed.type);
  listed.ranged = true;
  if (is_before(listed.most, listed.least, listed.type))
    row.fail(last,
             quoted(most) + " is below " + least + "; expected a maximum that is not below the minimum");
}

void read_factory(const ListRow& row, ListedRegister& listed) {
  const auto is_out = [&](Value value) {
    return listed.ranged &&
           (is_before(value, listed.least, listed.type) || is_before(listed.most, value, listed.type));
  };
  if (!row.has(Column::factory)) {
    listed.factory = is_out(0) ? listed.least : 0;
    return;
  }
  listed.factory = row.value(Column::factory, row.text(Column::factory), listed.type);
}

}  // namespace

ListedRegister register_of(const ListRow& row) {
  ListedRegister listed;
  listed.table = table_of(row);
  listed.address = address_of(row);
  listed.name = name_of(row);
  listed.type = type_of(row, listed.table);
  listed.access = access_of(row, listed.table);
  read_range(row, listed);
  read_factory(row, listed);
  listed.unit = row.text(Column::unit);
  listed.persistent = row.yes_or_no(Column::persistent);
  if (row.has(Column::bits)) {
    try {
      listed.bits = parse_bits(row.text(Column::bits), listed.type);
    } catch (const std::invalid_argument& error) {
      row.fail(Column::bits, error.what());
    }
  }
  if (is_32_bit(listed.type) && listed.address == 65535)
    row.fail(Column::address, "has no room for 32 bits; expected 0xFFFE or below");
  return listed;
}

}  // namespace understudy::emulator::model_file
