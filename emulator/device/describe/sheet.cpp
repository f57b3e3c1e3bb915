#include "emulator/device/describe/sheet.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace understudy::emulator {

namespace {

/// Returns the width in terminal columns: a code point counts as one column, a wide code point (Chinese) as
/// two.
std::size_t display_width(std::string_view text) {
  std::size_t width = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0) == 0x80) continue;
    width += byte >= 0xE3 && byte < 0xF0 ? 2 : 1;
  }
  return width;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string markdown_field(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

template <typename Field>
std::string joined(const std::vector<std::string>& fields, std::string_view separator, Field field) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += separator;
    line += field(fields[i]);
  }
  return line;
}

std::string as_csv(const Sheet& sheet) {
  std::string text = joined(sheet.columns, ",", csv_field) + "\n";
  for (const auto& row : sheet.rows) text += joined(row, ",", csv_field) + "\n";
  return text;
}

std::string as_markdown(const Sheet& sheet) {
  std::string text = "| " + joined(sheet.columns, " | ", markdown_field) + " |\n|";
  for (std::size_t i = 0; i < sheet.columns.size(); ++i) text += "---|";
  text += "\n";
  for (const auto& row : sheet.rows) text += "| " + joined(row, " | ", markdown_field) + " |\n";
  return text;
}

std::string as_table(const Sheet& sheet) {
  std::vector<std::size_t> widths(sheet.columns.size(), 0);
  const auto measure = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], display_width(row[i]));
  };
  measure(sheet.columns);
  for (const auto& row : sheet.rows) measure(row);
  std::string text;
  const auto print = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i];
      if (i + 1 < row.size()) line += std::string(widths[i] - display_width(row[i]) + 2, ' ');
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    text += line + "\n";
  };
  print(sheet.columns);
  for (const auto& row : sheet.rows) print(row);
  return text;
}

std::optional<std::int64_t> as_number(const std::string& text) {
  std::int64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, number);
  if (text.empty() || error != std::errc{} || parsed != end) return std::nullopt;
  return number;
}

std::string as_json(const Sheet& sheet) {
  // A column is numeric if all its values are numbers; a missing value is null.
  std::vector<bool> is_numeric(sheet.columns.size(), true);
  for (const auto& row : sheet.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!row[i].empty() && !as_number(row[i])) is_numeric[i] = false;
    }
  }
  auto array = nlohmann::ordered_json::array();
  for (const auto& row : sheet.rows) {
    auto object = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!is_numeric[i]) {
        object[sheet.columns[i]] = row[i];
      } else if (const auto number = as_number(row[i])) {
        object[sheet.columns[i]] = *number;
      } else {
        object[sheet.columns[i]] = nullptr;
      }
    }
    array.push_back(object);
  }
  return array.dump(2) + "\n";
}

}  // namespace

std::optional<SheetFormat> parse_sheet_format(std::string_view name) {
  if (name == "table") return SheetFormat::table;
  if (name == "csv") return SheetFormat::csv;
  if (name == "json") return SheetFormat::json;
  if (name == "markdown") return SheetFormat::markdown;
  return std::nullopt;
}

std::string format_sheet(const Sheet& sheet, SheetFormat format) {
  switch (format) {
    case SheetFormat::table: return as_table(sheet);
    case SheetFormat::csv: return as_csv(sheet);
    case SheetFormat::json: return as_json(sheet);
    case SheetFormat::markdown: return as_markdown(sheet);
  }
  return "";
}

}  // namespace understudy::emulator
