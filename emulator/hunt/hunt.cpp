#include "emulator/hunt/hunt.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "emulator/hunt/corpus.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/reach.h"
#include "emulator/hunt/shrinker.h"
#include "emulator/hunt/stage.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/performing/suite.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/results/failure_kinds.h"
#include "emulator/play/results/result.h"

namespace understudy::emulator::hunt {

namespace {

constexpr std::size_t kMaxStages = 64;  // for each thread

}  // namespace

Hunt::Hunt(const play::CaseList& cases, ModelList models, HuntOptions options, Player player)
    : cases_(cases), models_(models), options_(std::move(options)), player_(std::move(player)) {}

std::unique_ptr<Hunt::Actor> Hunt::take_actor() {
  const std::lock_guard lock(actors_mutex_);
  if (actors_.empty()) {
    auto actor = std::make_unique<Actor>();
    actor->reader = std::make_unique<play::CaseReader>(cases_);
    return actor;
  }
  auto actor = std::move(actors_.back());
  actors_.pop_back();
  return actor;
}

void Hunt::give_back(std::unique_ptr<Actor> actor) {
  const std::lock_guard lock(actors_mutex_);
  actors_.push_back(std::move(actor));
}

std::shared_ptr<Stage> Hunt::stage_of(Actor& actor, std::uint64_t case_number) const {
  const auto it = actor.stages.find(case_number);
  if (it != actor.stages.end()) return it->second;
  if (actor.stages.size() >= kMaxStages) actor.stages.clear();
  auto scenario = actor.reader->read({.file = 0, .number = case_number});
  auto stage = std::make_shared<Stage>(std::move(scenario), models_, player_);
  return actor.stages.emplace(case_number, std::move(stage)).first->second;
}

/// Draws a seed: each sort equally often, and younger seeds more often, since they are closer to what is
/// still unknown.
std::size_t Hunt::draw_seed(Dice& dice) const {
  std::vector<const std::vector<std::size_t>*> sorts;
  for (std::size_t i = 0; i < kSorts.size(); ++i) {
    const auto& numbers = corpus_.seeds_of(static_cast<Sort>(i));
    if (!numbers.empty()) sorts.push_back(&numbers);
  }
  const std::vector<std::size_t>& numbers = *sorts[dice.below(sorts.size())];
  const std::uint64_t first = dice.below(numbers.size());
  return numbers[std::max(first, dice.below(numbers.size()))];
}

/// Draws a course: a new one or, equally often, a change of one that reached something new.
Course Hunt::draw(Actor& actor, std::uint64_t number) const {
  Dice dice(options_.seed, number);
  const std::vector<Seed>& seeds = corpus_.seeds();
  Course course;
  if (seeds.empty() || !options_.is_guided || dice.one_in(2)) {
    course.case_number = dice.below(cases_.cases_of(0));
    Stage& stage = *stage_of(actor, course.case_number);
    if (!stage.undisturbed_outcome().kind.empty()) return course;
    course.disturbances = draw_disturbances({.plan = stage.plan(), .undisturbed = stage.undisturbed()}, dice);
    return course;
  }
  const Seed& seed = seeds[draw_seed(dice)];
  const Seed& other = seeds[dice.below(seeds.size())];
  course.case_number = seed.course.case_number;
  Stage& stage = *stage_of(actor, course.case_number);
  const bool is_of_case = other.course.case_number == course.case_number;
  course.disturbances =
      changed(seed.course.disturbances,
              is_of_case ? std::span<const play::Disturbance>(other.course.disturbances)
                         : std::span<const play::Disturbance>(),
              {.plan = stage.plan(), .undisturbed = stage.undisturbed(), .moments = seed.moments}, dice);
  return course;
}

Hunt::Played Hunt::play(Actor& actor, Course course) const {
  Stage& stage = *stage_of(actor, course.case_number);
  Played played{.course = std::move(course), .outcome = stage.undisturbed_outcome()};
  if (played.outcome.kind.empty())
    played.outcome = stage.play(played.course, options_.is_guided ? &played.reached : nullptr);
  return played;
}

/// Counts a course, and shrinks it if it is the first that failed in its way.
void Hunt::judge(std::uint64_t number, const Played& played,
                 const std::function<void(const Finding&)>& found) {
  const Outcome& outcome = played.outcome;
  const bool is_new = !outcome.kind.empty() &&
                      (kinds_.contains(outcome.kind) || kinds_.size() < play::FailureKinds::kMax) &&
                      ++kinds_[outcome.kind] == 1;
  {
    const std::lock_guard lock(tally_mutex_);
    ++tally_.courses;
    tally_.simulated += outcome.simulated;
    if (!outcome.kind.empty()) ++tally_.failed;
    if (outcome.is_cut_short) ++tally_.cut_short;
    if (is_new) ++tally_.findings;
    // A course that fails always ends in the same way, so no other starts from it.
    if (outcome.kind.empty() && !outcome.is_cut_short) corpus_.add(played.course, played.reached);
    tally_.reached = corpus_.counts();
  }
  if (!is_new) return;
  auto actor = take_actor();
  Finding finding{.course = number, .disturbances = played.course.disturbances.size()};
  finding.stage = stage_of(*actor, played.course.case_number);
  finding.shrunk = Shrinker(*finding.stage, outcome.kind).shrink(played.course, outcome);
  found(finding);
  give_back(std::move(actor));
}

/// Plays the courses of this shard from `first` to `end`. Returns false if there was no time for all of them.
bool Hunt::play_generation(std::uint64_t first, std::uint64_t end,
                           const std::function<void(const Finding&)>& found) {
  std::vector<std::optional<Played>> all(end - first);
  std::uint64_t next = first;
  bool is_whole = true;
  const auto next_course = [&]() -> std::optional<play::CaseId> {
    while (next < end && next % options_.shard.of != options_.shard.number - 1) ++next;
    if (next >= end) return std::nullopt;
    if (options_.is_over()) {
      is_whole = false;
      return std::nullopt;
    }
    return play::CaseId{.file = 0, .number = next++};
  };
  const auto make_play = [&]() -> play::Play {
    const auto return_it = [this](Actor* actor) { give_back(std::unique_ptr<Actor>(actor)); };
    const std::shared_ptr<Actor> actor(take_actor().release(), return_it);
    return [this, actor, &all, first](const play::CaseId& course) {
      all[course.number - first] = play(*actor, draw(*actor, course.number));
      return std::vector<play::ScenarioResult>{};
    };
  };
  play::run_suite(next_course, make_play, options_.jobs,
                  [&](const play::CaseId& course, const std::vector<play::ScenarioResult>&) {
                    auto& played = all[course.number - first];
                    judge(course.number, *played, found);
                    played.reset();
                  });
  return is_whole;
}

/// Judges the only case without disturbances, if it fails: every course would fail in the same way.
bool Hunt::fails_by_itself(const std::function<void(const Finding&)>& found) {
  auto actor = take_actor();
  const Played played{.course = {}, .outcome = stage_of(*actor, 0)->undisturbed_outcome()};
  give_back(std::move(actor));
  if (played.outcome.kind.empty()) return false;
  judge(0, played, found);
  return true;
}

/// Plays the courses of earlier hunts, to learn what they have reached.
void Hunt::play_earlier() {
  auto actor = take_actor();
  options_.corpus.insert(options_.corpus.begin(), Course{});  // the scenario without disturbances
  for (Course& course : options_.corpus) {
    if (options_.is_over()) break;
    if (course.case_number >= cases_.cases_of(0)) continue;
    Stage& stage = *stage_of(*actor, course.case_number);
    if (!stage.undisturbed_outcome().kind.empty()) continue;
    const bool fits =
        std::all_of(course.disturbances.begin(), course.disturbances.end(), [&](const auto& one) {
          return is_possible(one, {.plan = stage.plan(), .undisturbed = stage.undisturbed()});
        });
    if (!fits) continue;
    arrange(course.disturbances);
    const Played played = play(*actor, course);
    if (played.outcome.kind.empty() && !played.outcome.is_cut_short)
      corpus_.add(played.course, played.reached);
  }
  give_back(std::move(actor));
  corpus_.renew();
}

void Hunt::note_curve() {
  const Tally now = tally();
  if (curve_.empty() || curve_.back().reached != now.reached)
    curve_.push_back({.courses = now.courses, .reached = now.reached});
}

void Hunt::play_corpus(
    const std::function<std::vector<play::ObserverMaker>(const play::Scenario&)>& observers) {
  corpus_.renew();
  auto actor = take_actor();
  for (const Seed& seed : corpus_.seeds()) {
    Stage& stage = *stage_of(*actor, seed.course.case_number);
    stage.play(seed.course, observers(stage.scenario()));
  }
  give_back(std::move(actor));
}

void Hunt::run(const std::function<void(const Finding&)>& found, const std::function<void()>& pause) {
  next_ = options_.first;
  if (cases_.cases_of(0) == 1 && fails_by_itself(found)) return;
  play_earlier();
  const std::uint64_t end =
      options_.courses > UINT64_MAX - options_.first ? UINT64_MAX : options_.first + options_.courses;
  while (next_ < end) {
    const std::uint64_t count = std::min(kGeneration * options_.shard.of, end - next_);
    if (!play_generation(next_, next_ + count, found)) return;
    next_ += count;
    corpus_.renew();
    note_curve();
    pause();
  }
}

Tally Hunt::tally() const {
  const std::lock_guard lock(tally_mutex_);
  return tally_;
}

}  // namespace understudy::emulator::hunt
