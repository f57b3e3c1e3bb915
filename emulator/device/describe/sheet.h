// A sheet has columns and rows of text, and prints in the four formats of `describe`.
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

/// Returns the sheet as text with a final line end. JSON is an array of objects, one for each row; a column
/// of decimal numbers holds numbers there, and null for an empty cell.
std::string format_sheet(const Sheet& sheet, SheetFormat format);

}  // namespace understudy::emulator
