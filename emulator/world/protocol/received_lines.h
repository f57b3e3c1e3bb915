// Splits a device's text into lines in the same way as a host: lines end with CR, with LF, or with CR and LF.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::world {

struct ReceivedLines {
  std::vector<std::string> lines;  // without line endings; the last one may be incomplete
  std::size_t finished = 0;        // how many lines are complete
  std::vector<std::size_t> ends;   // for each complete line: where the next line begins
};

ReceivedLines lines_in(std::string_view text);

/// Returns lines as one text for messages: "a", "b", or "nothing" if there are none.
std::string lines_text(std::span<const std::string> lines);

/// The lines for which a step waits.
struct LinesWanted {
  std::vector<std::string> lines;  // the expected lines; empty: any lines, until the time is over
  /// True if the lines answer a line that was just sent. The last line may lack a line ending, such as a
  /// prompt.
  bool is_answer = false;
};
/// Returns true if the expected lines, or different lines in their place, have arrived.
bool has_come(const LinesWanted& wanted, const ReceivedLines& received);

}  // namespace understudy::emulator::world
