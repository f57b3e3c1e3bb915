#include "emulator/hunt/course_player.h"

#include <algorithm>
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
#include "emulator/world/bench_file/yaml_fields.h"
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

CoursePlayer::CoursePlayer(std::shared_ptr<const play::Scenario> scenario, ModelList models, Player player)
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
  common_ = scenario_->steps.size();
  for (const play::HuntPlan::Entry& entry : plan().entries()) common_ = std::min(common_, entry.first);
}

/// Returns true if the course has all steps that the courses have in common, so that it can begin after them.
bool CoursePlayer::begins_later(const Course& course) const {
  const bool has_all =
      course.end >= common_ && (course.left_out.empty() || *course.left_out.begin() >= common_);
  return common_ > 0 && player_.can_begin_later && has_all;
}

/// Makes the steps of a course.
void CoursePlayer::put_on(const Course& course) {
  reading_.steps = 0;
  reading_.bytes = 0;
  played_.steps = spans_;
  sources_.assign(spans_.size(), SIZE_MAX);
  auto next = course.disturbances.begin();
  for (std::size_t i = 0; i < scenario_->steps.size() && i < course.end; ++i) {
    for (; next != course.disturbances.end() && next->step <= i; ++next) {
      for (const world::YamlFields& written : plan().steps_of(*next)) {
        for (play::Step& step : reader_.read_apart(written)) {
          played_.steps.push_back(std::move(step));
          sources_.push_back(SIZE_MAX);
        }
      }
    }
    if (course.left_out.contains(i)) continue;
    played_.steps.push_back(scenario_->steps[i]);
    sources_.push_back(i);
  }
}

Playing CoursePlayer::play_here(const Course& course, bool has_reached) {
  put_on(course);
  Playing playing{.results = {}};
  play::RunOptions options;
  if (has_reached) options.observers.push_back(reach_observer(playing.reached));
  options.observers.push_back(
      [&](world::World& world) { return std::make_unique<RequestCount>(world, playing.requests); });
  if (begins_later(course)) {
    options.begin = beginning_;
    if (beginning_ != nullptr) {
      if (has_reached) playing.reached = reached_before_;
    } else if (has_reached) {
      options.keep_after = spans_.size() + common_;
      options.keep = [&](play::Beginning kept) {
        beginning_ = std::make_shared<const play::Beginning>(std::move(kept));
        reached_before_ = playing.reached;
        reached_before_.goes_on = true;
      };
    }
  }
  playing.results = player_.here(played_, options);
  return playing;
}

Playing CoursePlayer::playing_of(const Course& course, bool has_reached) {
  if (!player_.elsewhere) return play_here(course, has_reached);
  put_on(course);  // the outcome refers to the steps
  return player_.elsewhere(course, has_reached);
}

Outcome CoursePlayer::play(const Course& course, Reached* reached) {
  Playing playing = playing_of(course, reached != nullptr);
  if (reached != nullptr) *reached = std::move(playing.reached);
  return outcome_of(std::move(playing.results));
}

Outcome CoursePlayer::play(const Course& course, std::vector<play::ObserverMaker> observers) {
  put_on(course);
  play::RunOptions options;
  options.observers = std::move(observers);
  return outcome_of(player_.here(played_, options));
}

play::Steps CoursePlayer::disturbing_steps() {
  play::Steps all;
  for (std::size_t i = 0; i < plan().entries().size(); ++i) {
    const play::HuntPlan::Entry& entry = plan().entries()[i];
    play::Disturbance any{.entry = i, .step = entry.at_step, .when = entry.ways.front(), .values = {}};
    any.moment = 1;
    any.values.assign(entry.values.size(), 0);
    for (play::Step& step : reader_.read_apart(plan().step_of(any))) all.push_back(std::move(step));
  }
  return all;
}

const Outcome& CoursePlayer::undisturbed_outcome() {
  if (undisturbed_outcome_) return *undisturbed_outcome_;
  beginning_.reset();  // all steps are played, so that all requests are counted
  Playing playing = playing_of({}, true);
  note_undisturbed(playing);
  undisturbed_outcome_ = outcome_of(std::move(playing.results));
  return *undisturbed_outcome_;
}

const Undisturbed& CoursePlayer::undisturbed() {
  undisturbed_outcome();
  return undisturbed_;
}

void CoursePlayer::note_undisturbed(const Playing& playing) {
  undisturbed_.requests = playing.requests;
  const std::vector<play::StepResult>& steps = playing.results.front().steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (sources_[i] == SIZE_MAX) continue;
    undisturbed_.begins.push_back(steps[i].begin);
    undisturbed_.ends.push_back(steps[i].end);
  }
}

Outcome CoursePlayer::outcome_of(std::vector<ScenarioResult> results) const {
  Outcome outcome;
  for (ScenarioResult& result : results) {
    outcome.simulated += result.simulated;
    if (!result.failure || outcome.failed || outcome.is_cut_short) continue;
    const bool is_span = is_of_span(*result.failure);
    // The command itself failed, not a step.
    const bool is_of_command = !result.steps.empty() && !result.steps.back().has_failed;
    const bool is_branch = !result.branch.empty() || result.steps.empty() || is_of_command;
    if (!is_branch) outcome.failed_step = sources_[result.steps.size() - 1];
    if (!is_branch && !is_span && outcome.failed_step == SIZE_MAX) {
      outcome.is_cut_short = true;
      continue;
    }
    if (is_span || is_of_command) {
      // It does not matter in which step a condition was broken.
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
