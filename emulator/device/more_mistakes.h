// Formats the end of a list of program mistakes, which is limited to kMaxMistakes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/text/most_mistakes.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator {

/// If the list is full, adds a note to the last mistake that there may be more.
inline std::vector<ProgramMistake> with_word_of_more(std::vector<ProgramMistake> mistakes) {
  if (mistakes.size() >= kMaxMistakes) {
    mistakes.back().what += " (mistake " + std::to_string(kMaxMistakes) + "; reading stopped here)";
  }
  return mistakes;
}

/// Returns " (and 3 more)" for a message that quotes only one mistake. If the list is full, there may be even
/// more.
inline std::string and_more(const std::vector<ProgramMistake>& mistakes) {
  if (mistakes.size() < 2) return "";
  const std::string at_least = mistakes.size() >= kMaxMistakes ? "at least " : "";
  return " (and " + at_least + std::to_string(mistakes.size() - 1) + " more)";
}

}  // namespace understudy::emulator
