// Plays the courses of a hunt beside a command. Each thread of the hunt uses a separate process, because a
// command needs signals, and a process has only one set of signal handlers.
#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/worker_processes.h"
#include "emulator/device/model.h"
#include "emulator/hunt/course_player.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

/// Throws FileError at a step of the scenario, or of its possible disturbances, that cannot be played: with a
/// command, a step that uses a line; without a command, a `host` step.
void require_hunted_steps(const play::Scenario& scenario, ModelList models, bool has_command);

/// Runs a scenario beside its command, in simulated time. If `recording` is empty, there is no recording.
std::vector<play::ScenarioResult> run_beside(const play::Scenario& scenario, play::RunOptions options,
                                             const HuntArguments& arguments, const std::string& recording);

class HuntHosts {
 public:
  /// Starts the processes. Call this while this process has only one thread. All arguments must outlive this
  /// object.
  HuntHosts(const play::CaseList& cases, ModelList models, const HuntArguments& arguments, int jobs);

  /// Returns a player for another thread. There is one for each job, plus one.
  hunt::Player player();
  /// Plays the scenario of a finding, with its recording and its page.
  std::vector<play::ScenarioResult> show(const std::string& path, const std::vector<std::string>& command);

 private:
  Work make_work() const;
  std::vector<play::ScenarioResult> play_here(const play::Scenario& scenario,
                                              const play::RunOptions& options) const;

  const play::CaseList& cases_;
  ModelList models_;
  const HuntArguments& arguments_;
  std::atomic<std::size_t> taken_ = 1;  // process 0 shows findings
  WorkerProcesses workers_;
};

}  // namespace understudy::emulator::command_line
