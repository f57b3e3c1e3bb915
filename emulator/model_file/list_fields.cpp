#include "emulator/model_file/list_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/line_fields.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_words.h"
#include "emulator/model_file/model_schema.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

namespace {

std::vector<std::string> column_names() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kColumns; ++i) names.emplace_back(name_of(static_cast<Column>(i)));
  return names;
}

/// Adds the heading of a column. Throws std::invalid_argument for an unknown column.
void add_column(ListReading& reading, const std::string& name, const std::string& heading) {
  const auto column = column_called(lower(name));
  if (!column) {
    const std::vector<std::string> known = column_names();
    std::string all;
    for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
    const auto near = near_word(name, known);
    throw std::invalid_argument(
        understudy::quoted(name) + " is not a column; " +
        (near ? "the nearest is " + understudy::quoted(*near) : "expected one of " + all));
  }
  const bool is_present = std::any_of(reading.columns.begin(), reading.columns.end(),
                                      [&](const auto& entry) { return entry.first == *column; });
  if (is_present)
    throw std::invalid_argument(understudy::quoted(name) + " appears twice; expected it only once");
  reading.columns.emplace_back(*column, heading);
}

}  // namespace

void read_list_fields(const world::YamlFields& fields, ListReading& reading,
                      world::Diagnostics& diagnostics) {
  diagnostics.attempt([&] { fields.require_keys(kListKeys); });
  const auto read = [&](std::string_view key, const auto& how) {
    diagnostics.attempt([&] {
      if (const auto field = fields.find(key)) how(*field);
    });
  };
  read("columns", [&](const world::YamlFields& field) {
    field.require_map();
    for (const auto& [name, heading] : field.entries()) {
      try {
        add_column(reading, name, heading.text());
      } catch (const std::invalid_argument& error) {
        heading.fail(error.what());
      }
    }
  });
  read("addresses", [&](const world::YamlFields& field) {
    reading.addresses = static_cast<AddressReading>(read_word(field, kAddressesSchema));
  });
  read("table", [&](const world::YamlFields& field) {
    reading.table = *table_called(kTables.at(read_word(field, kTableSchema)));
  });
  read("encoding", [&](const world::YamlFields& field) {
    reading.encoding = kEncodings.at(read_word(field, kEncodingSchema));
  });
}

void parse_columns(const std::string& text, ListReading& reading) {
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t sign = part.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == part.size())
      throw std::invalid_argument(understudy::quoted(part) +
                                  " is not a column and its heading; expected address=HEADING");
    add_column(reading, part.substr(0, sign), part.substr(sign + 1));
  }
}

std::string list_section(const ListReading& reading, AddressReading addresses) {
  std::string text;
  if (!reading.columns.empty()) {
    text += "  columns: {";
    for (const auto& [column, heading] : reading.columns) {
      text += (text.ends_with('{') ? " " : ", ") + std::string(name_of(column)) + ": " + quoted_yaml(heading);
    }
    text += " }\n";
  }
  if (addresses != AddressReading::wire || reading.addresses) {
    text += "  addresses: " + std::string(kAddressReadings[static_cast<std::size_t>(addresses)]) +
            "  # or wire, from_one, modicon\n";
  }
  if (reading.table != Table::holding) text += "  table: " + std::string(to_string(reading.table)) + "\n";
  if (!reading.encoding.empty()) text += "  encoding: " + reading.encoding + "\n";
  return text.empty() ? "" : "list:\n" + text;
}

std::string quoted_yaml(const std::string& text) {
  const bool is_plain = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
  }) && text.front() != '-';
  if (is_plain) return text;
  std::string made = "'";
  for (const char c : text) made += c == '\'' ? "''" : std::string(1, c);
  return made + "'";
}

}  // namespace understudy::emulator::model_file
