// One row of a list of registers: its cells by column, and the register that they describe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/device/register_map/row.h"
#include "emulator/model_file/csv.h"
#include "emulator/models/imported/description.h"

namespace understudy::emulator::model_file {

/// The columns of a list; `left_out` is only for people.
enum class Column : std::uint8_t {
  table,
  address,
  name,
  access,
  type,
  width,
  is_signed,
  least,
  most,
  range,
  unit,
  persistent,
  factory,
  real,
  bits,
  left_out,
};
inline constexpr std::size_t kColumns = 15;
inline constexpr std::array<std::pair<std::string_view, Column>, 22> kHeadings{{
    {"table", Column::table},          {"address", Column::address},  {"name", Column::name},
    {"access", Column::access},        {"type", Column::type},        {"width", Column::width},
    {"signed", Column::is_signed},     {"min", Column::least},        {"max", Column::most},
    {"range", Column::range},          {"unit", Column::unit},        {"persistent", Column::persistent},
    {"default", Column::factory},      {"real", Column::real},        {"bits", Column::bits},
    {"description", Column::left_out}, {"comment", Column::left_out}, {"note", Column::left_out},
    {"notes", Column::left_out},       {"meaning", Column::left_out}, {"remarks", Column::left_out},
    {"section", Column::left_out},
}};

/// Returns nothing if there is no such column. Case does not matter.
std::optional<Column> column_called(std::string_view heading);

class ListRow {
 public:
  /// All must outlive it. `lines_before` is the number of lines before the list in its file.
  ListRow(const CsvRow& row, const std::vector<Column>& columns, const std::string& file, int lines_before);

  std::string text(Column column) const;
  bool has(Column column) const { return !text(column).empty(); }
  int line() const { return row_.line + lines_before_; }
  /// Throws FileError at the column's cell.
  [[noreturn]] void fail(Column column, const std::string& what) const;
  bool yes_or_no(Column column) const;
  /// Returns a number as a value of that type.
  Value value(Column column, const std::string& word, Type type) const;

 private:
  const CsvRow& row_;
  const std::string& file_;
  int lines_before_;
  std::array<const CsvCell*, kColumns> cells_{};
};

/// Throws FileError for the first mistake.
models::imported::ListedRegister register_of(const ListRow& row);

}  // namespace understudy::emulator::model_file
