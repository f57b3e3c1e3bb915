// Runs one case of a campaign over a host program: `exec SCENARIO -- COMMAND`.
#pragma once

#include <string>
#include <vector>

#include "emulator/command_line/commands.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

/// Throws FileError at the first step that this run cannot take: with a command, one that uses a line;
/// without one, a `host` step.
void require_steps_for(const play::Scenario& scenario, bool has_command);

/// Runs the scenario with its command on ports of its own. The command must exit with code 0, unless the
/// scenario has a `host` step. `recording` is the path of the recording.
std::vector<play::ScenarioResult> run_host_case(const play::Scenario& scenario, play::RunOptions options,
                                                const RunArguments& arguments, const std::string& recording);

}  // namespace understudy::emulator::command_line
