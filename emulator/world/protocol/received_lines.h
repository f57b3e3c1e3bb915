// Splits a device's text into lines as a host reads them: ended by CR, by LF, or by CR and LF.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::world {

struct ReceivedLines {
  std::vector<std::string> lines;  // without line ends; the last one may be incomplete
  std::size_t finished = 0;        // how many of them are complete
  std::vector<std::size_t> ends;   // for each complete line: where the next one begins
};

ReceivedLines lines_in(std::string_view text);

/// Returns lines as one text for messages: "a", "b"; "nothing" if there are none.
std::string lines_text(std::span<const std::string> lines);

/// The lines that a step waits for.
struct LinesWanted {
  std::vector<std::string> lines;  // the lines that are expected; none: any lines, until the time is over
  /// True if the lines answer a line that was just sent. The last of them may lack a line end, as a prompt
  /// does.
  bool is_answer = false;
};
/// Returns true if the wanted lines, or different ones in their place, have arrived.
bool has_come(const LinesWanted& wanted, const ReceivedLines& received);

}  // namespace understudy::emulator::world
