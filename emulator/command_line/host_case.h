// Runs one case of a campaign against a host program: `exec SCENARIO -- COMMAND`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulator/command_line/commands.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

// Exit codes for a command that cannot run.
inline constexpr int kExitNoHostTime = 125;  // the command cannot run in simulated time
inline constexpr int kExitNotStarted = 127;  // the command could not be started; the same code as in shells

/// Throws FileError at the first step that this run cannot execute: with a command, a step that uses a line;
/// without a command, a `host` step. `verb` is our command that runs scenarios with a host.
void require_steps_for(const play::Scenario& scenario, bool has_command, const std::string& verb = "exec");
/// Returns a command in shell syntax.
std::string shell_text(const std::vector<std::string>& words);
/// If the command cannot run in the cases, reports the reason (for `verb`) and returns an exit code. A
/// program whose name depends on the case is searched for only when it is started.
std::optional<int> code_of_unusable(const HostArguments& host, const std::string& verb);

/// Runs the scenario with its command on separate ports. The command must exit with code 0, unless the
/// scenario has a `host` step. `recording` is the path of the recording; empty: no recording.
std::vector<play::ScenarioResult> run_host_case(const play::Scenario& scenario, play::RunOptions options,
                                                const RunArguments& arguments, const std::string& recording);

}  // namespace understudy::emulator::command_line
