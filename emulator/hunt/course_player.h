// Plays the courses of one case of a scenario file. Each thread has its own players.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/hunt/course.h"
#include "emulator/hunt/reach.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/reading/trial.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::hunt {

/// The end of a course.
struct Outcome {
  std::string kind{};                            // the kind of failure; empty if there is none that counts
  std::optional<play::ScenarioResult> failed{};  // the scenario, or the branch, that failed
  std::size_t failed_step = SIZE_MAX;            // the index of the scenario's step; SIZE_MAX for a branch
  bool is_cut_short = false;                     // a disturbance failed as a step, so the rest was not played
  SimTime simulated{0};
};

/// A course as it was played.
struct Playing {
  std::vector<play::ScenarioResult> results;
  Reached reached{};
  std::int64_t requests = 0;  // requests to all stations
};

/// How courses are played. A CoursePlayer uses it on one thread.
struct Player {
  /// Plays a scenario in this process: run_scenario(), or something that runs a command alongside it.
  std::function<std::vector<play::ScenarioResult>(const play::Scenario&, const play::RunOptions&)> here =
      play::run_scenario;
  bool can_begin_later = true;  // `here` supports RunOptions::begin
  /// Plays a course of an identical CoursePlayer in another process. If it is empty, all courses are played
  /// in this process.
  std::function<Playing(const Course&, bool has_reached)> elsewhere{};
};

class CoursePlayer {
 public:
  /// The scenario must have a plan.
  CoursePlayer(std::shared_ptr<const play::Scenario> scenario, ModelList models, Player player);
  CoursePlayer(const CoursePlayer&) = delete;
  CoursePlayer& operator=(const CoursePlayer&) = delete;

  const play::HuntPlan& plan() const { return *scenario_->hunt; }
  const play::Scenario& scenario() const { return *scenario_; }
  /// Plays the case without disturbances, if that has not been done yet.
  const Outcome& undisturbed_outcome();
  const Undisturbed& undisturbed();

  /// Sets `reached`, if that is given, to what the course reaches.
  Outcome play(const Course& course, Reached* reached = nullptr);
  /// Plays the course in this process, with observers.
  Outcome play(const Course& course, std::vector<play::ObserverMaker> observers);
  /// Plays the course in this process.
  Playing play_here(const Course& course, bool has_reached);
  /// Returns the steps of all entries of the plan, with any of their values.
  play::Steps disturbing_steps();

 private:
  Playing playing_of(const Course& course, bool has_reached);
  const play::Steps& spans();
  bool begins_later(const Course& course) const;
  void put_on(const Course& course);
  Outcome outcome_of(std::vector<play::ScenarioResult> results) const;
  void note_undisturbed(const Playing& playing);

  std::shared_ptr<const play::Scenario> scenario_;
  Player player_;
  play::SharedReading shared_;
  play::FileReading reading_;
  play::Trial trial_;
  play::StepsReader reader_;
  play::Steps spans_;
  play::Scenario played_;                             // with the steps of the current course
  std::size_t common_ = 0;                            // the number of steps before which nothing may happen
  std::shared_ptr<const play::Beginning> beginning_;  // the state after these steps; null: not known yet
  Reached reached_before_{};                          // what these steps reach
  std::vector<std::size_t> sources_;  // for each step played: the scenario's step, or SIZE_MAX
  std::optional<Outcome> undisturbed_outcome_;
  Undisturbed undisturbed_;
};

}  // namespace understudy::emulator::hunt
