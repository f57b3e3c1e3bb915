// A sheet: columns and rows of text, and the four formats that `describe` prints.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator {

struct Sheet {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

enum class SheetFormat { table, csv, json, markdown };
std::optional<SheetFormat> parse_sheet_format(std::string_view name);

/// The sheet as text, its last line ended. JSON is an array of objects, one a row; a column of decimal
/// numbers holds numbers there, and null where it is empty.
std::string format_sheet(const Sheet& sheet, SheetFormat format);

}  // namespace understudy::emulator
