// Scrolls a text that may be longer than the window: which part is visible, and the keys that move it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::serve {

class ScrolledView {
 public:
  /// Returns the visible lines. Lines wider than the window are folded. If there are more than `rows`, the
  /// last row says which lines are shown.
  std::vector<std::string> fit(const std::vector<std::string>& lines, std::size_t rows, std::size_t columns);
  /// Handles keys as a terminal sends them: arrows, j, k, Enter, Page Up, Page Down, space, b, Home, End, g,
  /// G. Returns true for q.
  bool press(std::string_view keys);

 private:
  std::size_t top_ = 0;    // the first line that is shown
  std::size_t page_ = 0;   // the number of lines shown at once
  std::size_t total_ = 0;  // the number of all lines in the last fit()
};

}  // namespace understudy::emulator::serve
