// What is wrong with the text of a user's program, and where.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace understudy::emulator {

struct ProgramMistake {
  int line = 0;      // of the text, from 1; 0: the whole
  int column = 0;    // in bytes, from 1; 0: the whole line
  std::string what;  // "operand 2: 'maybe' is not a level; expected ON or OFF"

  bool operator==(const ProgramMistake&) const = default;
};

/// "pick.lst:4:9: operand 2: ...", where editors look for it.
inline std::string in_file(const ProgramMistake& mistake, const std::string& file) {
  const std::string line = mistake.line == 0 ? "" : ":" + std::to_string(mistake.line);
  const std::string column =
      mistake.line == 0 || mistake.column == 0 ? "" : ":" + std::to_string(mistake.column);
  return file + line + column + ": " + mistake.what;
}

/// "line 4, column 9: operand 2: ...", of a text that is not in a file.
inline std::string in_text(const ProgramMistake& mistake) {
  if (mistake.line == 0) return mistake.what;
  const std::string column = mistake.column == 0 ? "" : ", column " + std::to_string(mistake.column);
  return "line " + std::to_string(mistake.line) + column + ": " + mistake.what;
}

/// A program that a device cannot take: everything that is wrong with it, in the order of the text; one at
/// least. As an exception it says the first.
struct ProgramError : std::runtime_error {
  explicit ProgramError(std::vector<ProgramMistake> all)
      : std::runtime_error(all.front().what), mistakes(std::move(all)) {}
  ProgramError(int line, int column, const std::string& what)
      : ProgramError(std::vector<ProgramMistake>{{line, column, what}}) {}

  const ProgramMistake& first() const { return mistakes.front(); }

  std::vector<ProgramMistake> mistakes;
};

}  // namespace understudy::emulator
