// The stage of `run --on` and `probe`: real controllers at the given ports, with the user's permissions.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "emulator/box/stage/box_executor.h"
#include "emulator/box/stage/box_lines.h"
#include "emulator/command_line/commands.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

bool is_on_box(const RunArguments& arguments);
/// Throws UsageError for flags that require the internal state of a simulated controller, which a real
/// controller does not show.
void require_flags_of_boxes(const RunArguments& arguments);
/// `lines` contains the lines of all benches. Throws UsageError if a port is for another line.
void require_lines_of_benches(const OnArguments& arguments, const std::set<std::string>& lines);

class OnBox {
 public:
  /// From now on, Ctrl-C and SIGTERM stop the machine first. Throws UsageError and FileError.
  explicit OnBox(const OnArguments& arguments, bool puts_back = false);

  /// Opens the ports for the scenario's lines. Throws UsageError if nothing answers, and WireError.
  std::unique_ptr<play::Executor> make(const play::Scenario& scenario);
  /// Returns an executor in which the bench's own devices answer in place of controllers. Nothing is
  /// transmitted.
  std::unique_ptr<play::Executor> rehearse(const play::Scenario& scenario);

 private:
  box::StageSettings settings_;
  box::StageSettings of_rehearsals_;
  box::BoxLines lines_;
};

}  // namespace understudy::emulator::command_line
