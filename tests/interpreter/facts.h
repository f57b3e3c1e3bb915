// Facts from a manufacturer's manual, stored as CSV files next to the tests: an oracle that is independent of
// our code.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace understudy {

/// One row of a fact file: its cells by column name.
using Fact = std::map<std::string, std::string>;

/// Splits a line of CSV into cells; a quoted cell may contain commas.
inline std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      const bool is_doubled = is_quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (is_doubled) cells.back() += line[++i];
      if (!is_doubled) is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

/// Reads the rows of a fact file. Lines that begin with '#' are comments; the first other line names the
/// columns.
inline std::vector<Fact> read_facts(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<std::string> columns;
  std::vector<Fact> facts;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    const std::vector<std::string> cells = csv_cells(line);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), columns.size()) << path << ": " << line;
    Fact& fact = facts.emplace_back();
    for (std::size_t i = 0; i < std::min(cells.size(), columns.size()); ++i) fact[columns[i]] = cells[i];
  }
  return facts;
}

}  // namespace understudy
