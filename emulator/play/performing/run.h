// Runs scenarios (docs/scenarios.md defines each step). Times are in simulated time on every executor.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "emulator/play/executors/executor.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/performing/performance.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::play {

class Performance;

/// Creates an executor with the scenario's bench at power-up. It may be called several times, because each
/// branch of a fork gets its own executor.
using ExecutorMaker = std::function<std::unique_ptr<Executor>(const Scenario&)>;

/// Returns an executor in virtual time with the scenario's bench and gap.
std::unique_ptr<Executor> make_free_executor(const Scenario& scenario);

/// The state of a run after its first steps. Other runs that begin with the same steps can start from it.
struct Beginning {
  std::shared_ptr<const Performance::Checkpoint> state;
  ScenarioResult played{};  // the result of these steps
};

struct RunOptions {
  ExecutorMaker make_executor = make_free_executor;
  bool with_hash = false;  // ScenarioResult::outcome_hash
  std::vector<ObserverMaker> observers{};
  HostCommand* command = nullptr;            // the command that runs with the scenario; null: none
  std::shared_ptr<const Beginning> begin{};  // null: at power-up
  /// Called after `keep_after` steps, unless one of them failed, took a snapshot or was a fork.
  std::size_t keep_after = 0;  // 0: never
  std::function<void(Beginning)> keep{};
  /// Performs further steps with real controllers, after those of the scenario.
  std::function<void(Performance& performance)> more{};
};

/// Runs a scenario. Returns its own result, followed by those of its branches in the order of the file. If a
/// step fails, it is the last step of its result. Errors that are not the scenario's (such as a port that
/// cannot be opened) are thrown.
std::vector<ScenarioResult> run_scenario(const Scenario& scenario, const RunOptions& options = {});

}  // namespace understudy::emulator::play
