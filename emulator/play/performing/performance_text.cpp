// Performs steps that use lines of text.
#include <string>
#include <vector>

#include "emulator/play/performing/performance.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/protocol/received_lines.h"

namespace understudy::emulator::play {

void Performance::perform(const TextStep& step) {
  moment_in(step.within);  // throws if that is beyond the end of simulated time
  const world::LinesWanted wanted{.lines = step.lines.value_or(std::vector<std::string>()),
                                  .is_answer = step.text.has_value()};
  // Without an expected answer, the step ends when the device has received the line.
  if (!step.lines) return executor_->send_text(step.line, *step.text);
  std::vector<std::string> lines = executor_->exchange_text(step.line, step.text, wanted, step.within);
  if (lines == wanted.lines) return;
  // Showing one unexpected line is enough. On a busy machine, more lines may have arrived by now.
  if (lines.size() > wanted.lines.size() + 1) lines.resize(wanted.lines.size() + 1);
  const std::string expected = world::lines_text(wanted.lines);
  const std::string came = world::lines_text(lines);
  throw StepError((step.text ? "the reply is " : "received ") + came + "; expected " + expected, expected,
                  came);
}

}  // namespace understudy::emulator::play
