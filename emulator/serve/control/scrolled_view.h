// Scrolls a text that may be longer than the window: determines which part is visible, and handles the keys
// for moving.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::serve {

class ScrolledView {
 public:
  /// Returns the visible lines. Lines that are wider than the window are folded. If there are more than
  /// `rows` lines, the last row shows which lines are visible.
  std::vector<std::string> fit(const std::vector<std::string>& lines, std::size_t rows, std::size_t columns);
  /// Handles keys in the form in which a terminal sends them: arrows, j, k, Enter, Page Up, Page Down, space,
  /// b, Home, End, g, G. Returns true for q.
  bool press(std::string_view keys);

 private:
  std::size_t top_ = 0;    // the first visible line
  std::size_t page_ = 0;   // the number of visible lines
  std::size_t total_ = 0;  // the number of all lines in the last fit()
};

}  // namespace understudy::emulator::serve
