// What a device says, as the lines that a host reads: ended by CR, by LF, or by CR and LF.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::world {

struct LinesHeard {
  std::vector<std::string> lines;  // without their ends; the last one may have none yet
  std::size_t finished = 0;        // how many of them have
  std::vector<std::size_t> ends;   // of the finished ones: where the next begins
};

LinesHeard lines_in(std::string_view text);

/// Lines one above the other are one text for messages: "a", "b"; nothing if there is none.
std::string lines_text(std::span<const std::string> lines);

/// What is waited for.
struct LinesWanted {
  std::vector<std::string> lines;  // none: whatever comes, until time is over
  bool is_answer = false;  // to what was just said; the last line may have no end then, as a prompt has
};
/// Whether that has come, or something else instead.
bool has_come(const LinesWanted& wanted, const LinesHeard& heard);

}  // namespace understudy::emulator::world
