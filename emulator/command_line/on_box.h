// The stage of `run --on` and `probe`: real controllers at the given ports, with the user's permissions.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>

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
  explicit OnBox(const OnArguments& arguments);
  OnBox(const OnBox&) = delete;
  OnBox& operator=(const OnBox&) = delete;
  /// From now on, everything that a scenario changes is put back at its end, and the rig calls the only
  /// controller by this name.
  void have_bare_controller(const std::string& name);

  /// Opens the ports for the scenario's lines. Throws UsageError if nothing answers, and WireError.
  std::unique_ptr<play::Executor> make(const play::Scenario& scenario);
  /// Returns an executor in which the bench's own devices answer in place of controllers. Nothing is
  /// transmitted.
  std::unique_ptr<play::Executor> rehearse(const play::Scenario& scenario);
  bool has_rig() const { return !settings_.rig.empty(); }
  bool has_helper() const { return has_rig() || settings_.asks; }
  /// Returns true if the rig has failed since the last call.
  bool take_rig_failure() { return std::exchange(has_rig_failed_, false); }
  /// Returns true if the controllers still answer on all lines that were used.
  bool are_answering() { return lines_.are_answering(); }
  /// Has a rig reset the controller's memory and switch it off and on. Returns true if it answers then.
  bool revive(const std::string& device);

 private:
  box::StageSettings settings_;
  box::StageSettings of_rehearsals_;
  box::BoxLines lines_;
  bool has_rig_failed_ = false;
};

}  // namespace understudy::emulator::command_line
