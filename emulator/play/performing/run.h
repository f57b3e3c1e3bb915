// Runs scenarios (docs/scenarios.md defines each step). Time is simulated on any stage.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "emulator/play/performing/onlooker.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/play/stages/stage.h"

namespace understudy::emulator::play {

/// Makes a stage with the scenario's bench at its power-up. It may be called more than once, because each
/// branch of a fork gets its own stage.
using StageMaker = std::function<std::unique_ptr<Stage>(const Scenario&)>;

/// Returns a stage in virtual time with the scenario's bench and gap.
std::unique_ptr<Stage> make_free_stage(const Scenario& scenario);

struct RunOptions {
  StageMaker make_stage = make_free_stage;
  bool with_hash = false;  // ScenarioResult::outcome_hash
  std::vector<OnlookerMaker> onlookers{};
};

/// Returns the scenario's own result, then those of its branches in the order of the file. A step that fails
/// is the last one of its result. Errors that are not the scenario's (such as a port that cannot be opened)
/// are thrown.
std::vector<ScenarioResult> run_scenario(const Scenario& scenario, const RunOptions& options = {});

}  // namespace understudy::emulator::play
