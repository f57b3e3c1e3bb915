#include "emulator/box/asking/text_asker.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "emulator/box/asking/asked.h"
#include "emulator/box/wire/wire.h"
#include "emulator/serve/loop/event_loop.h"

namespace understudy::emulator::box {

namespace {

bool is_line_end(char c) { return c == '\r' || c == '\n'; }

std::vector<std::string> lines_of(const Bytes& bytes) {
  std::vector<std::string> lines;
  std::string line;
  for (const std::uint8_t byte : bytes) {
    const char c = static_cast<char>(byte);
    if (!is_line_end(c)) {
      line += c;
    } else if (!line.empty()) {
      lines.push_back(std::move(line));
      line.clear();
    }
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

/// Removes the echo, and a prompt such as ">". Returns true if there was an echo.
bool drop_dialogue(std::vector<std::string>& lines, const std::string& sent) {
  for (std::string& line : lines) {
    const std::size_t begin = line.find_first_not_of("> ");
    line = begin == std::string::npos ? "" : line.substr(begin);
  }
  const bool was_echoed = !lines.empty() && lines.front() == sent;
  if (was_echoed) lines.erase(lines.begin());
  std::erase(lines, "");
  return was_echoed;
}

}  // namespace

TextReply TextAsker::ask(const std::string& line, WallTime pause) {
  wire_.discard();
  TextReply result;
  Asked& asked = result.asked;
  asked.request.assign(line.begin(), line.end());
  asked.request.push_back('\r');
  const WallTime begin = serve::wall_now();
  wire_.send(asked.request);
  const WallTime deadline = begin + timeout_;
  WallTime until = deadline;
  while (serve::wall_now() < until) {
    if (!wire_.receive(asked.reply, until)) continue;
    asked.latency = serve::wall_now() - begin;
    result.lines = lines_of(asked.reply);
    asked.was_echoed = drop_dialogue(result.lines, line);
    const bool is_whole = !result.lines.empty() && is_line_end(static_cast<char>(asked.reply.back()));
    until = is_whole ? serve::wall_now() + pause : std::max(deadline, serve::wall_now() + pause);
  }
  return result;
}

}  // namespace understudy::emulator::box
