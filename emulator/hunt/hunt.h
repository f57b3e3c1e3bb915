// Plays courses of a scenario file, and shrinks the first failure of each kind. Courses are played on several
// threads, in generations, and judged in the order of their numbers. The findings therefore depend only on
// the seed.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/hunt/corpus.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/course_player.h"
#include "emulator/hunt/course_players.h"
#include "emulator/hunt/reach.h"
#include "emulator/hunt/shrinker.h"
#include "emulator/play/performing/case_list.h"

namespace understudy::emulator::hunt {

struct HuntOptions {
  std::uint64_t seed = 0;
  int jobs = 1;
  std::uint64_t courses = UINT64_MAX;  // the maximum number of courses
  play::Shard shard{};
  std::uint64_t first = 0;                               // the number of the first course
  std::vector<Course> corpus{};                          // courses of earlier hunts, which are played first
  bool is_guided = true;                                 // starts from courses that reached something new
  std::function<bool()> is_over = [] { return false; };  // may be called on any thread
};

/// A kind of failure.
struct Finding {
  std::uint64_t course = 0;      // the number of the first such course
  std::size_t disturbances = 0;  // the number of its disturbances
  Shrunk shrunk{};
  std::shared_ptr<CoursePlayer> course_player{};  // plays its case
};

/// The totals so far.
struct Tally {
  std::uint64_t courses = 0;
  std::uint64_t failed = 0;
  std::uint64_t cut_short = 0;  // courses in which a disturbance failed as a step
  std::size_t findings = 0;
  SimTime simulated{0};
  Counts reached{};
};

/// The counts after some courses.
struct CurvePoint {
  std::uint64_t courses = 0;
  Counts reached{};
};

class Hunt {
 public:
  /// No more courses than this are played at a time.
  static constexpr int kMaxJobs = 256;

  /// `cases` has one file with a plan; it must outlive the hunt.
  /// `make_player` is called for each thread, and once more.
  Hunt(
      const play::CaseList& cases, ModelList models, HuntOptions options,
      std::function<Player()> make_player = [] { return Player{}; });

  /// Hunts until it is over. `found` receives each finding as soon as it is shrunk, on this thread, which
  /// also calls `pause` after each generation.
  void run(
      const std::function<void(const Finding&)>& found, const std::function<void()>& pause = [] {});

  /// May be called on any thread.
  Tally tally() const;
  /// Returns how many courses failed, by kind of failure.
  const std::map<std::string, std::uint64_t>& kinds() const { return kinds_; }
  /// Returns the courses that reached something new.
  const Corpus& corpus() const { return corpus_; }
  /// Returns the courses of earlier hunts for which there was no time.
  const std::vector<Course>& unplayed() const { return unplayed_; }
  /// Returns the number of the next course.
  std::uint64_t next_course() const { return next_; }
  const std::vector<CurvePoint>& curve() const { return curve_; }
  /// Plays the courses that together have reached everything, with these observers. `over` is called after
  /// each course.
  void play_corpus(
      const std::function<std::vector<play::ObserverMaker>(const play::Scenario&)>& observers,
      const std::function<void(const Course&, const play::HuntPlan&)>& over = [](const Course&,
                                                                                 const play::HuntPlan&) {});

 private:
  static constexpr std::uint64_t kFirstGeneration = 16;   // courses
  static constexpr std::uint64_t kGeneration = kMaxJobs;  // of all later generations

  /// This many courses are drawn without starting from another one. They fill the first generations: 16 + 32
  /// + 64.
  static constexpr std::uint64_t kDrawnAlone = 112;

  struct Played {
    Course course;
    Outcome outcome;
    Reached reached{};
  };

  std::unique_ptr<CoursePlayers> take_course_players();
  void give_back(std::unique_ptr<CoursePlayers> course_players);
  bool goes_on(std::uint64_t number) const;
  Course draw(CoursePlayers& course_players, std::uint64_t number) const;
  Played play(CoursePlayers& course_players, Course course) const;
  void play_earlier();
  void note_curve();
  void judge(std::uint64_t number, const Played& played, const std::function<void(const Finding&)>& found);
  bool fails_by_itself(const std::function<void(const Finding&)>& found);
  bool play_generation(std::uint64_t first, std::uint64_t end,
                       const std::function<void(const Finding&)>& found);

  const play::CaseList& cases_;
  ModelList models_;
  HuntOptions options_;
  std::function<Player()> make_player_;
  std::mutex stages_mutex_;
  std::vector<std::unique_ptr<CoursePlayers>> course_players_;  // those that no thread uses
  std::map<std::string, std::uint64_t> kinds_;
  Corpus corpus_;
  std::vector<Course> unplayed_;
  std::vector<CurvePoint> curve_;
  std::uint64_t next_ = 0;
  mutable std::mutex tally_mutex_;
  Tally tally_;
};

}  // namespace understudy::emulator::hunt
