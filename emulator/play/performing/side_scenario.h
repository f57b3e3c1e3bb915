// Runs a scenario on a bench whose lines belong to another host program. The scenario acts on the world from
// outside, and checks it at the same time.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/turns.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/host_time/host_time.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::play {

/// Loads a scenario file with a single case for that bench. Throws FileError, including for a step that uses
/// a line (which belongs to the host), or that goes back in time (which would disturb the other program's
/// world).
Scenario load_side_scenario(ModelList models, const std::string& path, const world::Bench& bench,
                            const std::string& save_below = "");

/// Throws FileError at the first step that uses a line, or goes back in time.
void require_steps_beside_host(const Scenario& scenario);

class SideScenario {
 public:
  /// The scenario starts when the daemon runs. `over` is called at its end, on the daemon's thread; if the
  /// daemon ends first, the scenario is given up. The scenario must outlive this object, and the world must
  /// not be used elsewhere while this object exists. With `host_time`, the scenario acts while the host
  /// sleeps. The executor in `options` is replaced.
  SideScenario(const Scenario& scenario, serve::Daemon& daemon, std::function<void()> over,
               serve::HostTime* host_time = nullptr, RunOptions options = {});
  ~SideScenario();
  SideScenario(const SideScenario&) = delete;
  SideScenario& operator=(const SideScenario&) = delete;

  /// Asks the scenario to end soon. Call this on the daemon's thread.
  void give_up();

  // --- after the scenario is over ------------------------------------------------------------------
  bool was_given_up() const { return was_given_up_; }
  /// Throws the exception that ended the scenario, if any.
  const std::vector<ScenarioResult>& results() const;

 private:
  void play_on(const Scenario& scenario, serve::Daemon& daemon);
  std::unique_ptr<Executor> make_executor(serve::Daemon& daemon);

  serve::HostTime* host_time_;
  RunOptions options_;
  Turns turns_;  // used in host time
  std::atomic<bool> given_up_ = false;
  bool was_given_up_ = false;
  std::vector<ScenarioResult> results_;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace understudy::emulator::play
