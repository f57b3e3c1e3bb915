#include "emulator/serve/control/scrolled_view.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace understudy::emulator::serve {

namespace {

enum class Move { line_up, line_down, page_up, page_down, first, last, quit };

struct Key {
  std::string_view bytes;
  Move move;
};
constexpr std::array kKeys{
    Key{"\x1b[A", Move::line_up},
    Key{"\x1bOA", Move::line_up},
    Key{"k", Move::line_up},
    Key{"\x1b[B", Move::line_down},
    Key{"\x1bOB", Move::line_down},
    Key{"j", Move::line_down},
    Key{"\n", Move::line_down},
    Key{"\r", Move::line_down},
    Key{"\x1b[5~", Move::page_up},
    Key{"b", Move::page_up},
    Key{"\x1b[6~", Move::page_down},
    Key{" ", Move::page_down},
    Key{"\x1b[H", Move::first},
    Key{"\x1bOH", Move::first},
    Key{"\x1b[1~", Move::first},
    Key{"g", Move::first},
    Key{"\x1b[F", Move::last},
    Key{"\x1bOF", Move::last},
    Key{"\x1b[4~", Move::last},
    Key{"G", Move::last},
    Key{"q", Move::quit},
};

constexpr std::size_t kIndentation = 4;  // for the continuation of a folded line

bool is_inside_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

/// Returns where to break a line so that the first part fits, if possible at a space, but not within the
/// indentation.
std::size_t break_of(const std::string& line, std::size_t columns) {
  const std::size_t text = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t space = line.rfind(' ', columns);
  if (space != std::string::npos && space > text) return space;
  std::size_t at = columns;
  while (at > 1 && is_inside_character(line[at])) --at;
  return at;
}

void fold(std::string line, std::size_t columns, std::vector<std::string>& onto) {
  columns = std::max<std::size_t>(columns, 1);
  const std::size_t indentation = columns > 4 * kIndentation ? kIndentation : 0;
  while (line.size() > columns) {
    const std::size_t at = break_of(line, columns);
    std::string first = line.substr(0, at);
    first.erase(first.find_last_not_of(' ') + 1);
    onto.push_back(std::move(first));
    const std::size_t rest = line.find_first_not_of(' ', at);
    if (rest == std::string::npos) return;
    line = std::string(indentation, ' ') + line.substr(rest);
  }
  onto.push_back(std::move(line));
}

}  // namespace

std::vector<std::string> ScrolledView::fit(const std::vector<std::string>& lines, std::size_t rows,
                                           std::size_t columns) {
  std::vector<std::string> folded;
  for (const std::string& line : lines) fold(line, columns, folded);
  total_ = folded.size();
  if (rows == 0 || total_ <= rows) {
    top_ = 0;
    page_ = total_;
    return folded;
  }
  page_ = rows - 1;
  top_ = std::min(top_, total_ - page_);
  const auto first = folded.begin() + static_cast<std::ptrdiff_t>(top_);
  std::vector<std::string> shown(first, first + static_cast<std::ptrdiff_t>(page_));
  std::vector<std::string> last;
  fold("lines " + std::to_string(top_ + 1) + " to " + std::to_string(top_ + page_) + " of " +
           std::to_string(total_) + " (arrows, Page Up, Page Down; q ends)",
       columns, last);
  shown.push_back(last.front());
  return shown;
}

bool ScrolledView::press(std::string_view keys) {
  while (!keys.empty()) {
    const auto* const key =
        std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& row) { return keys.starts_with(row.bytes); });
    if (key == kKeys.end()) {
      keys.remove_prefix(1);
      continue;
    }
    keys.remove_prefix(key->bytes.size());
    const std::size_t lowest = total_ - std::min(page_, total_);
    const std::size_t page = std::max<std::size_t>(page_, 1);
    switch (key->move) {
      case Move::line_up: top_ -= std::min<std::size_t>(top_, 1); break;
      case Move::line_down: top_ = std::min(top_ + 1, lowest); break;
      case Move::page_up: top_ -= std::min(top_, page); break;
      case Move::page_down: top_ = std::min(top_ + page, lowest); break;
      case Move::first: top_ = 0; break;
      case Move::last: top_ = lowest; break;
      case Move::quit: return true;
    }
  }
  return false;
}

}  // namespace understudy::emulator::serve
