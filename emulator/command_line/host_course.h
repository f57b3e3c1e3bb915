// Runs a command beside a bench. The bench is served until both the command and the scenario have ended.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/command_line/commands.h"
#include "emulator/command_line/serving.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/parent_signals.h"

namespace understudy::emulator::command_line {

struct CourseSetup {
  Serving serving;
  HostArguments host;
  std::string folder;  // a private folder
  std::optional<serve::WallTime> timeout{};
  const play::Scenario* scenario = nullptr;  // null: no scenario
  play::RunOptions run{};                    // the scenario's options, except its executor, which is replaced
  /// A descriptor for the command's output. -1: the command uses our output. Otherwise the command has no
  /// terminal, and is ended when the scenario has failed or no longer needs it.
  int output = -1;
};

struct CourseEnd {
  int exit_code = 0;  // the command's exit code
  bool has_timed_out = false;
  bool was_reached = true;       // the command loaded the library for --host-time
  bool was_stopped = false;      // by the scenario's step `host: stop`; the exit code does not count
  bool was_interrupted = false;  // exec itself was told to end
  bool was_given_up = false;
  std::vector<play::ScenarioResult> results{};
};

/// Parses a duration in real time. Throws UsageError if the text is not a duration.
std::optional<serve::WallTime> parse_timeout(const std::string& text);
/// Throws UsageError if two lines would have the same environment variable.
void require_variables(const world::Bench& bench);

/// Runs a course. The command gets its ports in environment variables. Throws ChildError and the errors of
/// Daemon.
CourseEnd run_course(CourseSetup setup, const ServeArguments& flags, serve::ParentSignals& signals);

}  // namespace understudy::emulator::command_line
