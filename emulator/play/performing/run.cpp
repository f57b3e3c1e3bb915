#include "emulator/play/performing/run.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/free_executor.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/performing/performance.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

namespace {

using Checkpoint = std::shared_ptr<const Performance::Checkpoint>;
using Checkpoints = std::map<std::string, Checkpoint>;

constexpr std::string_view kBranch = " / ";  // separates the names of a scenario and a branch

/// Returns true if a step compares something with an expected value.
struct Judges {
  bool operator()(const WriteStep& step) const { return !step.answer.is_good(); }
  bool operator()(const CommandStep& step) const { return !step.answer.is_good(); }
  bool operator()(const ExpectStep&) const { return true; }
  bool operator()(const SendStep& step) const { return step.reply.has_value(); }
  bool operator()(const TextStep& step) const { return step.lines.has_value(); }
  bool operator()(const WaitStep&) const { return true; }
  bool operator()(const AssertStep&) const { return true; }
  bool operator()(const SpanStep&) const { return true; }
  bool operator()(const auto&) const { return false; }
};

/// The observers of a performance.
class Observers {
 public:
  Observers(Performance& performance, const std::vector<ObserverMaker>& makers) : performance_(performance) {
    if (makers.empty()) return;
    performance_.with_world([&](world::World& world) {
      for (const ObserverMaker& make : makers) observers_.push_back(make(world));
    });
  }
  ~Observers() {
    if (observers_.empty()) return;
    performance_.with_world([&](world::World&) { observers_.clear(); });
  }
  Observers(const Observers&) = delete;
  Observers& operator=(const Observers&) = delete;

  void world_restored(std::size_t steps) {
    notify([&](Observer& observer) { observer.world_restored(steps); });
  }
  void step_over() {
    notify([](Observer& observer) { observer.step_over(); });
  }
  void finish(ScenarioResult& result) {
    notify([&](Observer& observer) { observer.finish(result); });
  }

 private:
  void notify(const std::function<void(Observer&)>& what) {
    if (observers_.empty()) return;
    performance_.with_world([&](world::World&) {
      for (const auto& observer : observers_) what(*observer);
    });
  }

  Performance& performance_;
  std::vector<std::unique_ptr<Observer>> observers_;
};

class Run {
 public:
  Run(const Scenario& scenario, const RunOptions& options) : scenario_(scenario), options_(options) {}

  std::unique_ptr<Executor> make_executor() const { return options_.make_executor(scenario_); }

  /// Performs the steps, beginning at power-up or at a checkpoint.
  void perform(const std::string& name, const Steps& steps, const Checkpoint& begin, Checkpoints known) {
    const std::size_t number = results_.size();
    results_.push_back(result_called(name));
    Performance performance(scenario_, make_executor(), options_.with_hash, options_.command);
    Observers observers(performance, options_.observers);
    if (begin) {
      performance.restore(*begin);
      observers.world_restored(0);
    }

    std::vector<Fork> forks;
    ScenarioResult result = std::move(results_[number]);
    if (performance.is_on_box()) result.failure = performance.begin_on_box();
    const std::size_t first = begin ? 0 : go_on(performance, observers, result);
    for (std::size_t i = first; i < steps.size(); ++i) {
      const Step& step = steps[i];
      const auto* const fork = std::get_if<ForkStep>(&step.what);
      if (result.failure) {
        if (fork != nullptr) forks.push_back({.step = fork, .begin = {}, .known = {}});
        continue;
      }
      result.steps.push_back({.file = step.file, .line = step.line, .text = step.text});
      StepResult& played = result.steps.back();
      played.begin = performance.now();
      if (performance.is_on_box()) {
        result.failure = performance.play(std::span(steps).subspan(i));
        played.skipped = performance.skipped();
        if (fork != nullptr) forks.push_back({.step = fork, .begin = {}, .known = {}});
        end_step(performance, played, result);
        continue;
      }
      const auto save = [&] { return std::make_shared<const Performance::Checkpoint>(performance.save()); };
      if (const auto* const snapshot = std::get_if<SnapshotStep>(&step.what)) {
        known[snapshot->name] = save();
      } else if (const auto* const restored = std::get_if<RestoreStep>(&step.what)) {
        restore(performance, known, *restored, result);
        observers.world_restored(result.steps.size());
      } else if (fork != nullptr) {
        forks.push_back({.step = fork, .begin = save(), .known = known});
      } else {
        result.failure = performance.play(std::span(steps).subspan(i));
      }
      end_step(performance, played, result);
      if (std::holds_alternative<RestoreStep>(step.what)) result.simulated -= played.end - played.begin;
      observers.step_over();
      const bool is_kept = !begin && i + 1 == options_.keep_after && known.empty() && forks.empty();
      if (is_kept && !result.failure) options_.keep({.state = save(), .played = result});
    }
    finish_with_command(performance, steps, result);
    const bool has_more = options_.more && performance.is_on_box() && !begin && !result.failure;
    if (has_more) options_.more(performance);
    if (performance.is_on_box() && !has_judged(steps, result))
      result.verdict = ScenarioResult::Verdict::not_tellable;
    if (result.failure) result.verdict = ScenarioResult::Verdict::failed;
    if (options_.with_hash) result.outcome_hash = performance.outcome_hash();
    observers.finish(result);
    results_[number] = std::move(result);

    perform_branches(name, forks, performance.is_on_box());
  }

  std::vector<ScenarioResult> take() { return std::move(results_); }

 private:
  struct Fork {
    const ForkStep* step = nullptr;
    Checkpoint begin;  // null if the state was not reached
    Checkpoints known;
  };

  void perform_branches(const std::string& name, const std::vector<Fork>& forks, bool is_on_box) {
    for (const Fork& fork : forks) {
      for (const ForkStep::Branch& branch : fork.step->branches) {
        const std::string its_name = name + std::string(kBranch) + branch.name;
        if (fork.begin) {
          perform(its_name, branch.steps, fork.begin, fork.known);
        } else {
          leave_out(its_name, branch.steps, is_on_box);
        }
      }
    }
  }

  /// If there is an options_.begin, continues from its state. Returns how many steps have been executed.
  std::size_t go_on(Performance& performance, Observers& observers, ScenarioResult& result) const {
    if (!options_.begin) return 0;
    result = options_.begin->played;
    performance.restore(*options_.begin->state);
    observers.world_restored(result.steps.size());
    return result.steps.size();
  }

  /// The scenario lasts until the command has ended, unless a step waits for its end.
  void finish_with_command(Performance& performance, const Steps& steps, ScenarioResult& result) const {
    const bool has_end = std::ranges::any_of(
        steps, [](const Step& step) { return std::holds_alternative<CommandEndStep>(step.what); });
    if (options_.command == nullptr || has_end || result.failure) return;
    const SimTime begin = performance.now();
    result.failure = performance.finish_with_command();
    result.simulated += performance.now() - begin;
  }

  static void end_step(Performance& performance, StepResult& played, ScenarioResult& result) {
    played.end = performance.now();
    played.has_failed = result.failure.has_value();
    result.simulated += played.end - played.begin;
  }

  /// Returns true if a step that checks something was executed.
  static bool has_judged(const Steps& steps, const ScenarioResult& result) {
    for (std::size_t i = 0; i < result.steps.size(); ++i)
      if (result.steps[i].skipped.empty() && std::visit(Judges{}, steps[i].what)) return true;
    return false;
  }

  static void restore(Performance& performance, const Checkpoints& known, const RestoreStep& step,
                      ScenarioResult& result) {
    if (const auto found = known.find(step.name); found != known.end()) {
      performance.restore(*found->second);
    } else {
      result.failure = Failure{
          .at = performance.now(),
          .what = "no snapshot is called '" + step.name + "'; expected a snapshot that was saved earlier"};
    }
  }

  ScenarioResult result_called(const std::string& name) const {
    ScenarioResult result{.name = name, .file = scenario_.file};
    result.which = scenario_.which;
    result.seed = scenario_.seed;
    if (name.size() > scenario_.name.size())
      result.branch = name.substr(scenario_.name.size() + kBranch.size());
    return result;
  }

  /// A real controller cannot return to an earlier state, so the results of its branches cannot be
  /// determined.
  void leave_out(const std::string& name, const Steps& steps, bool is_on_box) {
    results_.push_back(result_called(name));
    results_.back().verdict =
        is_on_box ? ScenarioResult::Verdict::not_tellable : ScenarioResult::Verdict::not_reached;
    for (const Step& step : steps) {
      const auto* const fork = std::get_if<ForkStep>(&step.what);
      if (fork == nullptr) continue;
      for (const ForkStep::Branch& branch : fork->branches) {
        leave_out(name + std::string(kBranch) + branch.name, branch.steps, is_on_box);
      }
    }
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  std::vector<ScenarioResult> results_;
};

}  // namespace

std::unique_ptr<Executor> make_free_executor(const Scenario& scenario) {
  return std::make_unique<FreeExecutor>(scenario.bench, FreeExecutorOptions{.gap = scenario.gap});
}

std::vector<ScenarioResult> run_scenario(const Scenario& scenario, const RunOptions& options) {
  Run run(scenario, options);
  run.perform(scenario.name, scenario.steps, {}, {});
  return run.take();
}

}  // namespace understudy::emulator::play
