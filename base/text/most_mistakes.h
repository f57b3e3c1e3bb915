// Of a text that is full of mistakes, such as a log that was taken for a program, the first are told.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace understudy {

/// Whoever reads a text stops when it has found so many.
inline constexpr std::size_t kMostMistakes = 100;

/// Puts mistakes with a line and a column into the order of the text, and leaves the first kMostMistakes.
template <class Mistake>
void leave_first(std::vector<Mistake>& mistakes) {
  std::stable_sort(mistakes.begin(), mistakes.end(), [](const Mistake& a, const Mistake& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  if (mistakes.size() > kMostMistakes) mistakes.resize(kMostMistakes);
}

}  // namespace understudy
