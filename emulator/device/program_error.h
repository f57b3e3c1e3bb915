// Reports what is wrong in the text of a user's program, and where.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace understudy::emulator {

struct ProgramMistake {
  int line = 0;      // the line in the text, from 1; 0: the whole text
  int column = 0;    // the column in bytes, from 1; 0: the whole line
  std::string what;  // "operand 2: 'maybe' is not a level; expected ON or OFF"

  bool operator==(const ProgramMistake&) const = default;
};

/// Returns "pick.lst:4:9: operand 2: ...", the form that editors recognise.
inline std::string in_file(const ProgramMistake& mistake, const std::string& file) {
  const std::string line = mistake.line == 0 ? "" : ":" + std::to_string(mistake.line);
  const std::string column =
      mistake.line == 0 || mistake.column == 0 ? "" : ":" + std::to_string(mistake.column);
  return file + line + column + ": " + mistake.what;
}

/// Returns "line 4, column 9: operand 2: ...", for a text that is not in a file.
inline std::string in_text(const ProgramMistake& mistake) {
  if (mistake.line == 0) return mistake.what;
  const std::string column = mistake.column == 0 ? "" : ", column " + std::to_string(mistake.column);
  return "line " + std::to_string(mistake.line) + column + ": " + mistake.what;
}

/// Returns "column 6: axis: 'W' is not one; ...", for a text that consists of one line.
inline std::string in_line(const ProgramMistake& mistake) {
  return (mistake.column == 0 ? "" : "column " + std::to_string(mistake.column) + ": ") + mistake.what;
}

/// Thrown for a program that a device cannot load. It contains all mistakes (at least one) in the order of
/// the text; what() quotes the first one.
struct ProgramError : std::runtime_error {
  explicit ProgramError(std::vector<ProgramMistake> all)
      : std::runtime_error(all.front().what), mistakes(std::move(all)) {}
  ProgramError(int line, int column, const std::string& what)
      : ProgramError(std::vector<ProgramMistake>{{line, column, what}}) {}

  const ProgramMistake& first() const { return mistakes.front(); }

  std::vector<ProgramMistake> mistakes;
};

}  // namespace understudy::emulator
