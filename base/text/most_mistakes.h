// Limits how many mistakes are reported for a text. For a text that is full of mistakes, such as a log that
// is loaded as a program, only the first ones are reported.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace understudy {

/// A reader stops after this many mistakes.
inline constexpr std::size_t kMaxMistakes = 100;

/// Sorts mistakes by line and column, and keeps the first kMaxMistakes.
template <class Mistake>
void leave_first(std::vector<Mistake>& mistakes) {
  std::stable_sort(mistakes.begin(), mistakes.end(), [](const Mistake& a, const Mistake& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  if (mistakes.size() > kMaxMistakes) mistakes.resize(kMaxMistakes);
}

}  // namespace understudy
