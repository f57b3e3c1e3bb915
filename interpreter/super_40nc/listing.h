// Programs as text and back, without loss: check(list(program)) returns the same program.
//
//   AREA X BASE 500          ; C, X, Y, Z, U or PLC; BASE: the first step, if different
//   500 LD X0                ; one instruction per line, in any case; the optional step number is checked
//   501 CJ K10               ; K: constants and labels
//       END
//       LAB K10
//       DRV K1000, *, K-50   ; *: an unset field, optional at the end; commas are optional
//       OUT T0 K1000
//       END
//   FILE 3                   ; the C program of path file 3
//       END
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/super_40nc/areas.h"
#include "interpreter/super_40nc/error.h"
#include "interpreter/super_40nc/options.h"
#include "interpreter/super_40nc/program.h"

namespace understudy::interpreter::super_40nc {

struct Diagnostic {
  int line = 0;    // of the text, from 1
  int column = 0;  // in bytes, from 1
  std::string what;
  std::string expected;
  Code code = Code::none;
  int step = 0;        // for D8095
  int other_step = 0;  // for D8096

  std::string message() const { return expected.empty() ? what : what + "; expected " + expected; }
  bool operator==(const Diagnostic&) const = default;
};

/// Returns "4:9: X50 does not exist; expected X0 to X47".
std::string to_string(const Diagnostic& diagnostic);

struct Checked {
  std::optional<Program> program;  // empty if there is an error
  /// Where the lines of areas and files are in the text, counted from 1.
  std::array<std::vector<int>, kAreaCount> area_lines;
  std::map<int, std::vector<int>> file_lines;
  std::vector<Diagnostic> errors;    // the first kMaxMistakes, in the order of the text
  std::vector<Diagnostic> warnings;  // the program loads, but this is reported: a duplicate label
  std::vector<Diagnostic> notes;     // the program loads, and this is not reported: a jump without its label
};

inline constexpr int kGreatestFile = 29999;

Checked check(std::string_view text, const Options& options = {});

/// Writes a program as text, with numbered steps.
std::string list(const Program& program);
/// Returns the text of an instruction: "DRV K1000 * K-50".
std::string text_of(const Instruction& instruction);
std::string text_of(Operand operand);

}  // namespace understudy::interpreter::super_40nc
