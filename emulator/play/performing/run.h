// Plays scenarios (docs/scenarios.md says what each step means). Time is simulated, on whatever stage.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "emulator/play/performing/onlooker.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/play/stages/stage.h"

namespace understudy::emulator::play {

/// A stage with the scenario's bench at its power-up. May be called more than once: each branch of a fork
/// gets its own stage.
using StageMaker = std::function<std::unique_ptr<Stage>(const Scenario&)>;

/// A stage in free time, with the scenario's bench and gap.
std::unique_ptr<Stage> make_free_stage(const Scenario& scenario);

struct RunOptions {
  StageMaker make_stage = make_free_stage;
  bool with_hash = false;  // ScenarioResult::outcome_hash
  std::vector<OnlookerMaker> onlookers{};
};

/// The scenario's own result, then those of its branches in the order in which they are written. A step that
/// fails is the last one of its result. What is not the scenario's fault (a port that cannot be opened) is
/// thrown.
std::vector<ScenarioResult> run_scenario(const Scenario& scenario, const RunOptions& options = {});

}  // namespace understudy::emulator::play
