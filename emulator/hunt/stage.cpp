#include "emulator/hunt/stage.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/hunt/course.h"
#include "emulator/hunt/reach.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/results/failure_kinds.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/world.h"

namespace understudy::emulator::hunt {

namespace {

using play::ScenarioResult;

/// Returns true if a condition of `never` or `always` was broken.
bool is_of_span(const play::Failure& failure) {
  return failure.what.starts_with("never '") || failure.what.starts_with("always '");
}

/// Counts the requests of a run.
class RequestCount final : public play::Observer {
 public:
  RequestCount(world::World& world, std::int64_t& count) : world_(world), count_(count) {}
  void world_restored(std::size_t) override {}
  void finish(ScenarioResult& result) override {
    if (!result.branch.empty()) return;
    for (std::size_t i = 0; i < world_.line_count(); ++i) {
      for (const auto& station : world_.line(i).stations)
        count_ += static_cast<std::int64_t>(station->counters().requests);
    }
  }

 private:
  world::World& world_;
  std::int64_t& count_;
};

}  // namespace

Stage::Stage(std::shared_ptr<const play::Scenario> scenario, ModelList models, Player player)
    : scenario_(std::move(scenario)),
      player_(std::move(player)),
      shared_{.models = models, .benches = {}, .included = {}},
      reading_{.shared = shared_},
      trial_(scenario_->bench),
      reader_(trial_, reading_, scenario_->file),
      played_(*scenario_) {
  for (const world::YamlFields& span : plan().spans()) {
    for (play::Step& step : reader_.read_apart(span)) spans_.push_back(std::move(step));
  }
}

/// Makes the steps of a course.
void Stage::put_on(const Course& course) {
  reading_.steps = 0;
  reading_.bytes = 0;
  played_.steps = spans_;
  sources_.assign(spans_.size(), SIZE_MAX);
  auto next = course.disturbances.begin();
  for (std::size_t i = 0; i < scenario_->steps.size() && i < course.end; ++i) {
    for (; next != course.disturbances.end() && next->step <= i; ++next) {
      for (play::Step& step : reader_.read_apart(plan().step_of(*next))) {
        played_.steps.push_back(std::move(step));
        sources_.push_back(SIZE_MAX);
      }
    }
    if (course.left_out.contains(i)) continue;
    played_.steps.push_back(scenario_->steps[i]);
    sources_.push_back(i);
  }
}

Outcome Stage::play(const Course& course, Reached* reached) {
  std::vector<play::ObserverMaker> observers;
  if (reached != nullptr) observers.push_back(reach_observer(*reached));
  return play(course, observers);
}

Outcome Stage::play(const Course& course, const std::vector<play::ObserverMaker>& observers) {
  put_on(course);
  play::RunOptions options;
  options.observers = observers;
  return outcome_of(player_(played_, options));
}

const Outcome& Stage::undisturbed_outcome() {
  if (undisturbed_outcome_) return *undisturbed_outcome_;
  put_on({});
  play::RunOptions options;
  options.observers.push_back(
      [this](world::World& world) { return std::make_unique<RequestCount>(world, undisturbed_.requests); });
  std::vector<ScenarioResult> results = player_(played_, options);
  note_undisturbed(results);
  undisturbed_outcome_ = outcome_of(std::move(results));
  return *undisturbed_outcome_;
}

const Undisturbed& Stage::undisturbed() {
  undisturbed_outcome();
  return undisturbed_;
}

void Stage::note_undisturbed(const std::vector<ScenarioResult>& results) {
  const std::vector<play::StepResult>& steps = results.front().steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (sources_[i] == SIZE_MAX) continue;
    undisturbed_.begins.push_back(steps[i].begin);
    undisturbed_.ends.push_back(steps[i].end);
  }
}

Outcome Stage::outcome_of(std::vector<ScenarioResult> results) const {
  Outcome outcome;
  for (ScenarioResult& result : results) {
    outcome.simulated += result.simulated;
    if (!result.failure || outcome.failed || outcome.is_cut_short) continue;
    const bool is_span = is_of_span(*result.failure);
    const bool is_branch = !result.branch.empty() || result.steps.empty();
    if (!is_branch) outcome.failed_step = sources_[result.steps.size() - 1];
    if (!is_branch && !is_span && outcome.failed_step == SIZE_MAX) {
      outcome.is_cut_short = true;
      continue;
    }
    if (is_span) {
      // The step in which a condition was broken does not matter.
      ScenarioResult bare = result;
      bare.steps.clear();
      outcome.kind = play::kind_of_failure(bare);
    } else {
      outcome.kind = play::kind_of_failure(result);
    }
    outcome.failed = std::move(result);
  }
  return outcome;
}

}  // namespace understudy::emulator::hunt
