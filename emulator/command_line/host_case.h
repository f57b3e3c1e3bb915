// Runs one case of a campaign over a host program: `exec SCENARIO -- COMMAND`.
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
inline constexpr int kExitNoHostTime = 125;  // cannot run in simulated time
inline constexpr int kExitNotStarted = 127;  // as in shells

/// Throws FileError at the first step that this run cannot execute: with a command, a step that uses a line;
/// without one, a `host` step. `verb` names the command of ours that runs scenarios with a host.
void require_steps_for(const play::Scenario& scenario, bool has_command, const std::string& verb = "exec");
/// Returns a command as typed in a shell.
std::string shell_text(const std::vector<std::string>& words);
/// If the command cannot run in the cases, reports why (for `verb`) and returns an exit code. A program whose
/// name depends on the case is looked for only when it is started.
std::optional<int> code_of_unusable(const HostArguments& host, const std::string& verb);

/// Runs the scenario with its command on ports of its own. The command must exit with code 0, unless the
/// scenario has a `host` step. `recording` is the path of the recording; empty: no recording.
std::vector<play::ScenarioResult> run_host_case(const play::Scenario& scenario, play::RunOptions options,
                                                const RunArguments& arguments, const std::string& recording);

}  // namespace understudy::emulator::command_line
