// Programs as numbers: the form in which a program is sent over the line, with one row of numbers per line.
// `asm` prints this form and `disasm` reads it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator {

struct DeviceSettings;

/// The format of a row of numbers.
struct CellForm {
  std::string_view row;  // for people: "CMD DATA1 DATA2 JMP"
  std::size_t fewest = 1;
  std::size_t max = 1;  // cells per row
  std::int64_t lowest = 0;
  std::int64_t highest = 255;
  std::size_t max_rows = 256;
};

struct CellRow {
  std::vector<std::int64_t> cells;
  int line = 0;  // the text line from which the row was read; 0: none
};

/// A facet of a language. It is null if programs in the language do not have this form.
class ProgramCells {
 public:
  virtual CellForm cell_form() const = 0;
  /// Throws ProgramError. `settings` are as for ProgramLanguage::check().
  virtual std::vector<CellRow> assemble(std::string_view text, const DeviceSettings& settings) const = 0;
  /// The rows must have the format of cell_form(). Throws ProgramError, with line numbers of the text from
  /// which the rows were read.
  virtual std::string disassemble(const std::vector<CellRow>& rows, const DeviceSettings& settings) const = 0;

 protected:
  ~ProgramCells() = default;
};

/// Returns one line for each row: "5 0 1 1".
std::string to_text(const std::vector<CellRow>& rows);
/// Reads rows and skips empty lines. Throws ProgramError.
std::vector<CellRow> read_cells(std::string_view text, const CellForm& form);

}  // namespace understudy::emulator
