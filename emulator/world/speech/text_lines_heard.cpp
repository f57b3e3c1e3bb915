#include "emulator/world/speech/text_lines_heard.h"
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "base/text/one_line.h"

namespace understudy::emulator::world {

LinesHeard lines_in(std::string_view text) {
  LinesHeard heard;
  std::size_t begin = text.starts_with('\n') ? 1 : 0;  // skips the rest of an earlier line end
  while (begin < text.size()) {
    const std::size_t end = text.find_first_of("\r\n", begin);
    heard.lines.emplace_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) break;
    begin = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
    heard.ends.push_back(begin);
    ++heard.finished;
  }
  return heard;
}

std::string lines_text(std::span<const std::string> lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "\"" : ", \"") + one_line(line) + "\"";
  return text.empty() ? "nothing" : text;
}

bool has_come(const LinesWanted& wanted, const LinesHeard& heard) {
  const std::size_t count = wanted.lines.size();
  if (count == 0) return false;
  if (heard.finished >= count) return true;
  return wanted.is_answer && heard.lines.size() == count && heard.lines.back() == wanted.lines.back();
}

}  // namespace understudy::emulator::world
