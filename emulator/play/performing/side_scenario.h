// Runs a scenario on a bench whose lines belong to another host program: it acts on the world from outside,
// and checks it meanwhile.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/play/stages/real_executor.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::play {

/// Loads the only scenario of a file for that bench. Throws FileError, also if a step belongs to the host
/// because it uses a line, or would disturb the world of another program because it goes back in time.
Scenario load_side_scenario(ModelList models, const std::string& path, const world::Bench& bench,
                            const std::string& save_below = "");

class SideScenario {
 public:
  /// Starts when the daemon runs. `over` is called at the end, on the daemon's thread; if the daemon ends
  /// first, the scenario is abandoned. The scenario must outlive this object, and the world must not be used
  /// elsewhere while it exists.
  SideScenario(const Scenario& scenario, serve::Daemon& daemon, std::function<void()> over);
  ~SideScenario() { thread_.join(); }
  SideScenario(const SideScenario&) = delete;
  SideScenario& operator=(const SideScenario&) = delete;

  /// Asks the scenario to end soon.
  void give_up() { given_up_ = true; }

  // --- after it is over
  bool was_given_up() const { return was_given_up_; }
  /// Throws the exception that ended the scenario, if there was one.
  const std::vector<ScenarioResult>& results() const;

 private:
  void play_on(const Scenario& scenario, serve::Daemon& daemon);

  std::atomic<bool> given_up_ = false;
  bool was_given_up_ = false;
  std::vector<ScenarioResult> results_;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace understudy::emulator::play
