#include "emulator/world/protocol/received_lines.h"
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "base/text/one_line.h"

namespace understudy::emulator::world {

ReceivedLines lines_in(std::string_view text) {
  ReceivedLines received;
  std::size_t begin = text.starts_with('\n') ? 1 : 0;  // skip the rest of an earlier line ending
  while (begin < text.size()) {
    const std::size_t end = text.find_first_of("\r\n", begin);
    received.lines.emplace_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) break;
    begin = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
    received.ends.push_back(begin);
    ++received.finished;
  }
  return received;
}

std::string lines_text(std::span<const std::string> lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "\"" : ", \"") + one_line(line) + "\"";
  return text.empty() ? "nothing" : text;
}

bool has_come(const LinesWanted& wanted, const ReceivedLines& received) {
  const std::size_t count = wanted.lines.size();
  if (count == 0) return false;
  if (received.finished >= count) return true;
  return wanted.is_answer && received.lines.size() == count && received.lines.back() == wanted.lines.back();
}

}  // namespace understudy::emulator::world
