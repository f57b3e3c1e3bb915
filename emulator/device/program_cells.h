// Programs as numbers: what goes over the wire for a text, a row of numbers for each line of the program.
// What `asm` prints and `disasm` reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator {

struct DeviceSettings;

/// What a row of numbers looks like.
struct CellForm {
  std::string_view row;  // for people: "CMD DATA1 DATA2 JMP"
  std::size_t fewest = 1;
  std::size_t most = 1;  // cells of a row
  std::int64_t lowest = 0;
  std::int64_t highest = 255;
  std::size_t most_rows = 256;
};

struct CellRow {
  std::vector<std::int64_t> cells;
  int line = 0;  // of the text that it was read from; 0: from none
};

/// A facet of a language: null where its programs are not such numbers.
class ProgramCells {
 public:
  virtual CellForm cell_form() const = 0;
  /// Throws ProgramError. `settings`: as for ProgramLanguage::check().
  virtual std::vector<CellRow> assemble(std::string_view text, const DeviceSettings& settings) const = 0;
  /// The rows are of that form. Throws ProgramError, with lines of the text that they are from.
  virtual std::string disassemble(const std::vector<CellRow>& rows, const DeviceSettings& settings) const = 0;

 protected:
  ~ProgramCells() = default;
};

/// "5 0 1 1": a line each.
std::string to_text(const std::vector<CellRow>& rows);
/// Empty lines are left out. Throws ProgramError.
std::vector<CellRow> read_cells(std::string_view text, const CellForm& form);

}  // namespace understudy::emulator
