// How a list of what is wrong with a program is told: it ends at kMostMistakes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/text/most_mistakes.h"
#include "emulator/device/program_error.h"

namespace understudy::emulator {

/// The last of a full list says that there may be more.
inline std::vector<ProgramMistake> with_word_of_more(std::vector<ProgramMistake> mistakes) {
  if (mistakes.size() >= kMostMistakes) {
    mistakes.back().what += " (mistake " + std::to_string(kMostMistakes) + "; reading stopped here)";
  }
  return mistakes;
}

/// " (and 3 more)", of mistakes of which one is told; of a full list more may not have been read.
inline std::string and_more(const std::vector<ProgramMistake>& mistakes) {
  if (mistakes.size() < 2) return "";
  const std::string at_least = mistakes.size() >= kMostMistakes ? "at least " : "";
  return " (and " + at_least + std::to_string(mistakes.size() - 1) + " more)";
}

}  // namespace understudy::emulator
