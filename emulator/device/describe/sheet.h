// A sheet consists of columns and rows of text, and can be printed in the four formats of `describe`.
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

/// Returns the sheet as text with a final line ending. In JSON, it is an array with one object per row. If a
/// column contains decimal numbers, its values are numbers, or null for empty cells.
std::string format_sheet(const Sheet& sheet, SheetFormat format);

}  // namespace understudy::emulator
