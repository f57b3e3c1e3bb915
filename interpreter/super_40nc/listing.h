// Programs as text and back, without loss: list() and check() again give the same program.
//
//   AREA X BASE 500          ; C, X, Y, Z, U or PLC; BASE: its first step, if not the area's
//   500 LD X0                ; one instruction per line, in any case; its step is checked if given
//   501 CJ K10               ; K: constants and labels
//       END
//       LAB K10
//       DRV K1000, *, K-50   ; *: an unset field, optional at the end; commas may separate
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

/// "4:9: X50 does not exist; expected X0 to X47".
std::string to_string(const Diagnostic& diagnostic);

struct Checked {
  std::optional<Program> program;  // only if nothing is wrong
  /// Where the lines of areas and of files are in the text, from 1.
  std::array<std::vector<int>, kAreaCount> area_lines;
  std::map<int, std::vector<int>> file_lines;
  std::vector<Diagnostic> errors;    // the first kMaxMistakes, in the order of the text
  std::vector<Diagnostic> warnings;  // it loads, but this is reported: a duplicate label
  std::vector<Diagnostic> notes;     // it loads, and this is not reported: a jump without its label
};

inline constexpr int kGreatestFile = 29999;

Checked check(std::string_view text, const Options& options = {});

/// Writes a program as text, with numbered steps.
std::string list(const Program& program);
/// Returns the text of an instruction: "DRV K1000 * K-50".
std::string text_of(const Instruction& instruction);
std::string text_of(Operand operand);

}  // namespace understudy::interpreter::super_40nc
