// Sends queries to a real controller that speaks lines of text. It refuses lines that are not queries.
#pragma once

#include <string>
#include <vector>

#include "emulator/box/asking/asked.h"
#include "emulator/box/wire/wire.h"

namespace understudy::emulator::box {

struct TextReply {
  Asked asked;
  std::vector<std::string> lines;  // without echo, prompt and line ends; none: nothing came in time
};

class TextAsker {
 public:
  TextAsker(Wire& wire, WallTime timeout) : wire_(wire), timeout_(timeout) {}
  /// Sends the line. The answer ends when nothing more comes for `pause` after a line end.
  TextReply ask(const std::string& line, WallTime pause);

 private:
  Wire& wire_;
  WallTime timeout_;
};

}  // namespace understudy::emulator::box
