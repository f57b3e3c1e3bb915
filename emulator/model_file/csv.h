// Comma-separated values (RFC 4180), with the place of each cell for messages.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::model_file {

struct CsvCell {
  std::string text;  // without the blanks around it, nor the quotes
  int column = 1;    // where it begins in its line
};

struct CsvRow {
  int line = 1;
  std::vector<CsvCell> cells;
};

/// The rows of a text, without empty ones and those that begin with #. Cells are separated by what separates
/// the first row: commas, semicolons or tabs. A mark of byte order is left out. Throws FileError with `file`
/// where a quotation has no end.
std::vector<CsvRow> parse_csv(const std::string& text, const std::string& file);

}  // namespace understudy::emulator::model_file
