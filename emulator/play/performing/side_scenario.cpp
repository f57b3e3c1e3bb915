#include "emulator/play/performing/side_scenario.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/file_error.h"
#include "base/simulated_time.h"
#include "emulator/device/model.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/host_time_executor.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/host_time/host_time.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::play {

namespace {

/// Returns why a step cannot run alongside another host, or null if it can.
struct Objection {
  const char* operator()(const WriteStep&) const { return kUsesLine; }
  const char* operator()(const CommandStep&) const { return kUsesLine; }
  const char* operator()(const ExpectStep&) const { return kUsesLine; }
  const char* operator()(const SendStep&) const { return kUsesLine; }
  const char* operator()(const TextStep&) const { return kUsesLine; }
  const char* operator()(const WaitStep& step) const { return step.poll ? kUsesLine : nullptr; }
  const char* operator()(const RestoreStep&) const { return kGoesBack; }
  const char* operator()(const ForkStep&) const { return kGoesBack; }
  const char* operator()(const auto&) const { return nullptr; }

  static constexpr const char* kUsesLine =
      "uses a line, which belongs to the host program; expected steps that do not use a line, such as `wait` "
      "without `poll`, `assert`, `input`";
  static constexpr const char* kGoesBack =
      "goes back in time, but the host program cannot; expected steps that go forward";
};

bool is_same_bench(const world::Bench& one, const world::Bench& other) {
  const auto same_device = [](const world::DeviceSetup& a, const world::DeviceSetup& b) {
    return a.model == b.model && a.settings.name == b.settings.name &&
           a.settings.firmware == b.settings.firmware;
  };
  const auto same_line = [](const world::LineSetup& a, const world::LineSetup& b) {
    return a.name == b.name && a.stations == b.stations;
  };
  return std::equal(one.devices.begin(), one.devices.end(), other.devices.begin(), other.devices.end(),
                    same_device) &&
         std::equal(one.lines.begin(), one.lines.end(), other.lines.begin(), other.lines.end(), same_line);
}

}  // namespace

Scenario load_side_scenario(ModelList models, const std::string& path, const world::Bench& bench,
                            const std::string& save_below) {
  SharedReading shared{.models = models, .benches = {}, .included = {}};
  ScenarioFile file(path, {.save_below = save_below, .seed = {}}, shared);
  if (file.size() != 1) {
    throw FileError(path + ": cases: there are " + std::to_string(file.size()) +
                    "; expected only one, because a single host program runs with the scenario");
  }
  Scenario scenario = file.read(0);
  if (!is_same_bench(scenario.bench, bench)) {
    throw FileError(
        path + ": bench: its devices or lines differ from those of the running bench; expected the same");
  }
  require_steps_beside_host(scenario);
  return scenario;
}

void require_steps_beside_host(const Scenario& scenario) {
  for (const Step& step : scenario.steps) {
    if (const char* const why = std::visit(Objection{}, step.what)) {
      throw FileError(step.file + ":" + std::to_string(step.line) + ": " + step.text + ": " + why);
    }
  }
}

SideScenario::SideScenario(const Scenario& scenario, serve::Daemon& daemon, std::function<void()> over,
                           serve::HostTime* host_time, RunOptions options)
    : host_time_(host_time),
      options_(std::move(options)),
      thread_([this, &scenario, &daemon, over = std::move(over)] {
        play_on(scenario, daemon);
        turns_.finish();
        daemon.post(over);
      }) {
  if (host_time_ != nullptr) host_time_->run_beside(&turns_);
}

SideScenario::~SideScenario() {
  if (host_time_ != nullptr) host_time_->run_beside(nullptr);
  turns_.leave();
  thread_.join();
}

void SideScenario::give_up() {
  given_up_ = true;
  if (host_time_ == nullptr) return;
  turns_.give_up();
  turns_.act(SimTime{0});
}

std::unique_ptr<Executor> SideScenario::make_executor(serve::Daemon& daemon) {
  if (host_time_ != nullptr) return std::make_unique<HostTimeExecutor>(daemon.world(), turns_);
  return std::make_unique<RealExecutor>(daemon,
                                        RealExecutorOptions{.has_hosts = false, .given_up = &given_up_});
}

void SideScenario::play_on(const Scenario& scenario, serve::Daemon& daemon) {
  try {
    options_.make_executor = [&](const Scenario&) { return make_executor(daemon); };
    results_ = run_scenario(scenario, options_);
  } catch (const ExecutionAborted&) {
    was_given_up_ = true;
  } catch (...) {
    error_ = std::current_exception();
  }
}

const std::vector<ScenarioResult>& SideScenario::results() const {
  if (error_) std::rethrow_exception(error_);
  return results_;
}

}  // namespace understudy::emulator::play
