// Parses comma-separated values (RFC 4180), with the position of each cell for messages.
#pragma once

#include <string>
#include <vector>

namespace understudy::emulator::model_file {

struct CsvCell {
  std::string text;  // without surrounding blanks and quotes
  int column = 1;    // where it begins in the line
};

struct CsvRow {
  int line = 1;
  std::vector<CsvCell> cells;
};

/// Returns the rows of a text, without empty rows and rows that begin with #. The separator (comma, semicolon
/// or tab) is the most frequent one in the first line that contains a separator. A byte order mark is
/// ignored. Throws FileError with `file` if a quoted field is not closed.
std::vector<CsvRow> parse_csv(const std::string& text, const std::string& file);

}  // namespace understudy::emulator::model_file
