// Removes the columns from diagnostics about files, for tests of their wording.
#pragma once

#include <regex>
#include <string>

namespace understudy::emulator::world {

/// Turns "a.yaml:3:12: lines: ..." into "a.yaml:3: lines: ...", in every line.
inline std::string without_columns(const std::string& diagnostic) {
  static const std::regex with_column("(^|\n)([^:\n]*:[0-9]+):[0-9]+: ");
  return std::regex_replace(diagnostic, with_column, "$1$2: ");
}

}  // namespace understudy::emulator::world
