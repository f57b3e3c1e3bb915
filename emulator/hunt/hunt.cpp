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
#include "emulator/hunt/course_player.h"
#include "emulator/hunt/course_players.h"
#include "emulator/hunt/reach.h"
#include "emulator/hunt/shrinker.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/performing/suite.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/results/failure_kinds.h"
#include "emulator/play/results/result.h"

namespace understudy::emulator::hunt {

Hunt::Hunt(const play::CaseList& cases, ModelList models, HuntOptions options,
           std::function<Player()> make_player)
    : cases_(cases), models_(models), options_(std::move(options)), make_player_(std::move(make_player)) {}

std::unique_ptr<CoursePlayers> Hunt::take_course_players() {
  const std::lock_guard lock(stages_mutex_);
  if (course_players_.empty()) return std::make_unique<CoursePlayers>(cases_, models_, make_player_());
  auto course_players = std::move(course_players_.back());
  course_players_.pop_back();
  return course_players;
}

void Hunt::give_back(std::unique_ptr<CoursePlayers> course_players) {
  const std::lock_guard lock(stages_mutex_);
  course_players_.push_back(std::move(course_players));
}

/// Returns true if a course starts from another one. Half of the courses do, except for the first ones: a
/// fault that is easy to find needs no guidance, and later courses have more seeds to start from.
bool Hunt::goes_on(std::uint64_t number) const {
  const bool is_early = number < kDrawnAlone * options_.shard.of;
  if (!options_.is_guided || is_early || corpus_.seeds().empty()) return false;
  return Dice(~options_.seed, number).one_in(2);  // a course that is drawn alone is the same without guidance
}

/// Draws a course: a new one, or one that starts from a course that reached something new.
Course Hunt::draw(CoursePlayers& course_players, std::uint64_t number) const {
  Dice dice(options_.seed, number);
  const std::vector<Seed>& seeds = corpus_.seeds();
  Course course;
  if (!goes_on(number)) {
    course.case_number = dice.below(cases_.cases_of(0));
    CoursePlayer& course_player = *course_players.of(course.case_number);
    if (!course_player.undisturbed_outcome().kind.empty()) return course;
    course.disturbances =
        draw_disturbances({.plan = course_player.plan(), .undisturbed = course_player.undisturbed()}, dice);
    return course;
  }
  const Seed& seed = seeds[corpus_.draw_seed(dice)];
  const Seed& other = seeds[dice.below(seeds.size())];
  course.case_number = seed.course.case_number;
  CoursePlayer& course_player = *course_players.of(course.case_number);
  const bool is_of_case = other.course.case_number == course.case_number;
  course.disturbances = changed(
      seed.course.disturbances,
      is_of_case ? std::span<const play::Disturbance>(other.course.disturbances)
                 : std::span<const play::Disturbance>(),
      {.plan = course_player.plan(), .undisturbed = course_player.undisturbed(), .moments = seed.moments},
      dice);
  return course;
}

Hunt::Played Hunt::play(CoursePlayers& course_players, Course course) const {
  CoursePlayer& course_player = *course_players.of(course.case_number);
  Played played{.course = std::move(course), .outcome = course_player.undisturbed_outcome()};
  if (played.outcome.kind.empty())
    played.outcome = course_player.play(played.course, options_.is_guided ? &played.reached : nullptr);
  return played;
}

/// Counts a course, and shrinks it if it is the first to fail in this way.
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
  auto course_players = take_course_players();
  Finding finding{.course = number, .disturbances = played.course.disturbances.size()};
  finding.course_player = course_players->of(played.course.case_number);
  finding.shrunk = Shrinker(*finding.course_player, outcome.kind).shrink(played.course, outcome);
  found(finding);
  give_back(std::move(course_players));
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
    const auto return_it = [this](CoursePlayers* course_players) {
      give_back(std::unique_ptr<CoursePlayers>(course_players));
    };
    const std::shared_ptr<CoursePlayers> course_players(take_course_players().release(), return_it);
    return [this, course_players, &all, first](const play::CaseId& course) {
      all[course.number - first] = play(*course_players, draw(*course_players, course.number));
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

/// Judges the only case without disturbances, if it fails, because then every course would fail in the same
/// way.
bool Hunt::fails_by_itself(const std::function<void(const Finding&)>& found) {
  auto course_players = take_course_players();
  const Played played{.course = {}, .outcome = course_players->of(0)->undisturbed_outcome()};
  give_back(std::move(course_players));
  if (played.outcome.kind.empty()) return false;
  judge(0, played, found);
  return true;
}

/// Plays the courses of earlier hunts, to learn what they have reached.
void Hunt::play_earlier() {
  auto course_players = take_course_players();
  options_.corpus.insert(options_.corpus.begin(), Course{});  // the scenario without disturbances
  for (Course& course : options_.corpus) {
    if (options_.is_over()) {
      unplayed_.push_back(std::move(course));
      continue;
    }
    if (course.case_number >= cases_.cases_of(0)) continue;
    CoursePlayer& course_player = *course_players->of(course.case_number);
    if (!course_player.undisturbed_outcome().kind.empty()) continue;
    const bool fits =
        std::all_of(course.disturbances.begin(), course.disturbances.end(), [&](const auto& one) {
          return is_possible(one, {.plan = course_player.plan(), .undisturbed = course_player.undisturbed()});
        });
    if (!fits) continue;
    arrange(course.disturbances);
    const Played played = play(*course_players, course);
    if (played.outcome.kind.empty() && !played.outcome.is_cut_short)
      corpus_.add(played.course, played.reached);
  }
  give_back(std::move(course_players));
  corpus_.renew();
}

void Hunt::note_curve() {
  const Tally now = tally();
  if (curve_.empty() || curve_.back().reached != now.reached)
    curve_.push_back({.courses = now.courses, .reached = now.reached});
}

void Hunt::play_corpus(
    const std::function<std::vector<play::ObserverMaker>(const play::Scenario&)>& observers,
    const std::function<void(const Course&, const play::HuntPlan&)>& over) {
  corpus_.renew();
  auto course_players = take_course_players();
  for (const Seed& seed : corpus_.seeds()) {
    CoursePlayer& course_player = *course_players->of(seed.course.case_number);
    course_player.play(seed.course, observers(course_player.scenario()));
    over(seed.course, course_player.plan());
  }
  give_back(std::move(course_players));
}

void Hunt::run(const std::function<void(const Finding&)>& found, const std::function<void()>& pause) {
  next_ = options_.first;
  if (cases_.cases_of(0) == 1 && fails_by_itself(found)) {
    unplayed_ = std::move(options_.corpus);
    return;
  }
  play_earlier();
  const std::uint64_t end =
      options_.courses > UINT64_MAX - options_.first ? UINT64_MAX : options_.first + options_.courses;
  // The first generations are small, so that courses soon start from the first discoveries.
  for (std::uint64_t generation = kFirstGeneration; next_ < end;
       generation = std::min(2 * generation, kGeneration)) {
    const std::uint64_t count = std::min(generation * options_.shard.of, end - next_);
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
