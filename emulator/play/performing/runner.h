// Plays scenarios (docs/scenarios.md says what each step means). Time is simulated, on whatever stage.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "emulator/play/performing/onlooker.h"
#include "emulator/play/results/result.h"
#include "emulator/play/script/scenario.h"
#include "emulator/play/stages/stage.h"

namespace understudy::emulator::play {

/// A stage with the scenario's bench at its power-up. May be called more than once: each branch of a fork has
/// a stage of its own.
using StageMaker = std::function<std::unique_ptr<Stage>(const Scenario&)>;

/// One in free time, by the scenario's bench and gap.
std::unique_ptr<Stage> make_free_stage(const Scenario& scenario);

struct PlayOptions {
  StageMaker make_stage = make_free_stage;
  bool with_hash = false;  // ScenarioResult::outcome_hash
  std::vector<OnlookerMaker> onlookers{};
};

/// The scenario's own result, then those of its branches in the order in which they are written. A step that
/// fails is the last one of its result. What a scenario cannot be blamed for (a port that cannot be had) is
/// thrown.
std::vector<ScenarioResult> play(const Scenario& scenario, const PlayOptions& options = {});

}  // namespace understudy::emulator::play
