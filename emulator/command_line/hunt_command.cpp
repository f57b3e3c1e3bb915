#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/corpus_file.h"
#include "emulator/command_line/coverage_file.h"
#include "emulator/command_line/ctl_coverage.h"
#include "emulator/command_line/device_coverage_file.h"
#include "emulator/command_line/host_case.h"
#include "emulator/command_line/host_course.h"
#include "emulator/command_line/hunt_files.h"
#include "emulator/command_line/hunt_hosts.h"
#include "emulator/command_line/hunt_plan_text.h"
#include "emulator/command_line/interruption.h"
#include "emulator/command_line/nearest_courses.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/terminal.h"
#include "emulator/device/model.h"
#include "emulator/hunt/corpus.h"
#include "emulator/hunt/course.h"
#include "emulator/hunt/course_player.h"
#include "emulator/hunt/found_file.h"
#include "emulator/hunt/hunt.h"
#include "emulator/hunt/reach.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxGaps = 10;  // the most gaps in programs that are printed

/// Returns the end of the hunt, or nothing if it is limited only by the number of courses.
std::optional<Clock::time_point> end_of(const HuntArguments& arguments) {
  constexpr auto kUsual = std::chrono::seconds(60);
  if (arguments.time.empty()) {
    if (arguments.courses) return std::nullopt;
    return Clock::now() + kUsual;
  }
  const auto time = parse_duration(arguments.time);
  if (!time || *time <= SimTime{0}) {
    throw UsageError("--for: " + quoted(arguments.time) + " is not a duration; expected one such as 60s");
  }
  return Clock::now() + *time;
}

int jobs_of_hunt(const HuntArguments& arguments) {
  if (!arguments.jobs) return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (*arguments.jobs >= 1) return std::min(*arguments.jobs, hunt::Hunt::kMaxJobs);
  throw UsageError("--jobs: " + std::to_string(*arguments.jobs) + " is too few; expected 1 or more");
}

play::Shard shard_of_hunt(const HuntArguments& arguments) {
  if (arguments.shard.empty()) return {};
  if (const auto parsed = play::parse_shard(arguments.shard)) return *parsed;
  throw UsageError("--shard: " + quoted(arguments.shard) +
                   " is not a shard; expected I/N such as 1/4, with I up to N");
}

/// Throws FileError if the file, or one of its plays, has no hunt plan.
void require_plans(const std::string& file, const std::vector<std::string>& without, bool has_any) {
  if (without.empty()) return;
  if (has_any) {
    throw FileError(file + ": hunt: is missing in the play " + quoted(without.front()) +
                    "; expected it in each play, or once for the whole file");
  }
  throw FileError(file +
                  ": hunt: is missing; expected `hunt:` with possible disturbances, as in "
                  "`hunt: { may: [ inject: { drop: feeder } ] }`");
}

void require_hunted(const play::Scenario& scenario, ModelList models, bool has_command) {
  if (!scenario.saved.empty()) {
    throw FileError(scenario.file +
                    ": save: cannot be used in a hunt, because its courses would write the same file");
  }
  require_hunted_steps(scenario, models, has_command);
}

RunArguments coverage_arguments(const HuntArguments& arguments) {
  RunArguments covered;
  covered.coverage = arguments.coverage;
  covered.device_coverage = arguments.device_coverage;
  covered.version = arguments.version;
  return covered;
}

/// Prints the hunt plan of the first case.
int print_plan(const play::CaseList& cases, ModelList models, const HuntArguments& arguments) {
  std::optional<HuntHosts> hosts;
  if (!arguments.host.command.empty()) hosts.emplace(cases, models, arguments, 1);
  hunt::CoursePlayer player(play::CaseReader(cases).read({.file = 0, .number = 0}), models,
                            hosts ? hosts->player() : hunt::Player{});
  std::fputs(plan_text(player.plan(), player.undisturbed()).c_str(), stdout);
  return kExitWell;
}

std::string rate_text(double rate) {
  char figures[40];
  std::snprintf(figures, sizeof figures, rate < 10 ? "%.1f/s" : "%.0f/s", rate);
  return figures;
}

/// Formats the progress line for a terminal.
class HuntProgress {
 public:
  explicit HuntProgress(const hunt::Hunt& hunt) : hunt_(hunt) {}
  std::string text(double seconds) {
    const hunt::Tally tally = hunt_.tally();
    if (tally.findings != findings_) {
      findings_ = tally.findings;
      last_ = seconds;
    }
    std::string text = std::to_string(tally.courses) + " courses, " +
                       rate_text(seconds > 0 ? static_cast<double>(tally.courses) / seconds : 0) + ", " +
                       std::to_string(tally.findings) + " found";
    for (std::size_t i = 0; i < tally.reached.size(); ++i) {
      if (tally.reached[i] > 0)
        text += ", " + std::to_string(tally.reached[i]) + " " + std::string(hunt::kSorts[i]);
    }
    if (tally.findings > 0)
      text += ", the last " + std::to_string(static_cast<int>(seconds - last_)) + " s ago";
    return text;
  }

 private:
  const hunt::Hunt& hunt_;
  std::size_t findings_ = 0;
  double last_ = 0;
};

/// Prints how much was reached after 16, 48, 112 courses, and so on.
void print_curve(const hunt::Hunt& hunt) {
  const auto& curve = hunt.curve();
  if (curve.size() < 2 || curve.back().reached == hunt::Counts{}) return;
  std::printf("%10s", "courses");
  for (const std::string_view sort : hunt::kSorts) std::printf("  %s", std::string(sort).c_str());
  std::printf("\n");
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].courses < next && i + 1 < curve.size()) continue;
    next = 2 * curve[i].courses;
    std::printf("%10" PRIu64, curve[i].courses);
    for (std::size_t sort = 0; sort < hunt::kSorts.size(); ++sort) {
      std::printf("  %*zu", static_cast<int>(hunt::kSorts[sort].size()), curve[i].reached[sort]);
    }
    std::printf("\n");
  }
}

/// Prints gaps in groups with the same nearest course, and that course below each group.
void print_gaps(const std::vector<Gap>& gaps) {
  const std::size_t shown = std::min(gaps.size(), kMaxGaps);
  for (std::size_t i = 0; i < shown; ++i) {
    std::printf("  %s\n", gaps[i].text.c_str());
    const bool is_last = i + 1 == shown || gaps[i + 1].nearest != gaps[i].nearest;
    if (is_last && !gaps[i].nearest.empty()) std::printf("    nearest: %s\n", gaps[i].nearest.c_str());
  }
  if (gaps.size() > shown) std::printf("  ... and %zu more\n", gaps.size() - shown);
}

/// Plays the courses that reached something new again. Prints the lines and parts that none of them reached,
/// with the nearest course to each.
void print_unreached(hunt::Hunt& hunt, RunCoverage& coverage) {
  std::optional<CoverageFile> of_course;
  NearestCourses nearest;
  hunt.play_corpus(
      [&](const play::Scenario& scenario) {
        of_course.emplace(CoverageWish{});
        return std::vector{of_course->observer(scenario), coverage.devices.observer()};
      },
      [&](const hunt::Course& course, const play::HuntPlan& plan) {
        coverage.programs.add(of_course->report());
        std::string text;
        for (const play::Disturbance& one : course.disturbances)
          text += (text.empty() ? "" : "; ") + hunt::line_of(plan, one);
        nearest.add(of_course->report(), course.disturbances.size(), text);
      });
  if (!coverage.programs.report().files.empty() || coverage.programs.is_wanted()) {
    const std::vector<Gap> gaps = nearest.gaps(coverage.programs.report());
    coverage.programs.write(stdout);
    print_files(coverage.programs.report());
    print_gaps(gaps);
  }
  coverage.devices.write(stdout);
}

void print_summary(const hunt::Hunt& hunt) {
  const hunt::Tally tally = hunt.tally();
  for (const auto& [kind, count] : hunt.kinds()) {
    if (count > 1)
      std::printf("%" PRIu64 " courses failed in the same way: %s\n", count, one_line(kind).c_str());
  }
  if (tally.cut_short > 0) {
    std::printf("%" PRIu64
                " courses ended early, because a step of `may` failed; "
                "use `send` for requests that need not succeed\n",
                tally.cut_short);
  }
  std::printf("%" PRIu64 " courses, %zu found; %ss simulated\n", tally.courses, tally.findings,
              play::seconds_text(tally.simulated).c_str());
}

}  // namespace

int hunt_scenario(ModelList models, const HuntArguments& arguments) {
  const bool has_command = !arguments.host.command.empty();
  if (has_command) {
    parse_timeout(arguments.timeout);
    if (const auto code = code_of_unusable(arguments.host, "hunt")) return *code;
  }
  CorpusFile corpus(arguments.corpus);
  hunt::HuntOptions options{.seed = arguments.seed,
                            .jobs = jobs_of_hunt(arguments),
                            .courses = arguments.courses.value_or(UINT64_MAX),
                            .shard = shard_of_hunt(arguments),
                            .first = corpus.next_course(arguments.seed),
                            .corpus = corpus.courses(),
                            .is_guided = !arguments.unguided};
  if (arguments.unguided && corpus.is_wanted())
    throw UsageError("--unguided: uses no earlier courses; expected no --corpus");
  play::CaseList cases(models, {.command = arguments.host.command});
  FileClaims claims;
  std::vector<std::string> without;  // the names of scenarios that have no plan
  bool has_any = false;
  cases.add(arguments.scenario, [&](const play::Scenario& scenario) {
    claims.add(scenario.files);
    if (scenario.hunt == nullptr) return without.push_back(scenario.name);
    has_any = true;
    require_hunted(scenario, models, has_command);
  });
  require_plans(arguments.scenario, without, has_any);
  if (arguments.plan) return print_plan(cases, models, arguments);
  const RunArguments covered = coverage_arguments(arguments);
  require_coverage(claims, coverage_of(covered));
  require_device_coverage(claims, covered.device_coverage);
  require_output(claims, "--corpus", arguments.corpus);
  RunCoverage coverage(covered);
  corpus.try_to_write();
  FoundFiles files(models, arguments, std::move(claims));
  std::optional<HuntHosts> hosts;
  if (has_command) hosts.emplace(cases, models, arguments, options.jobs);
  if (hosts) files.show_with(*hosts);
  const auto end = end_of(arguments);
  watch_for_interruption();
  options.is_over = [&end] { return is_interrupted() || (end && Clock::now() >= *end); };
  hunt::Hunt hunt(cases, models, options, [&] { return hosts ? hosts->player() : hunt::Player{}; });
  {
    HuntProgress state(hunt);
    ProgressLine progress([&](double seconds) { return state.text(seconds); });
    auto written = Clock::now();
    hunt.run([&](const hunt::Finding& finding) { progress.above([&] { files.add(finding); }); },
             [&] {
               constexpr auto kEvery = std::chrono::seconds(5);
               if (!corpus.is_wanted() || Clock::now() < written + kEvery) return;
               corpus.write(hunt, arguments.seed);
               written = Clock::now();
             });
  }
  if (corpus.is_wanted()) corpus.write(hunt, arguments.seed);
  print_summary(hunt);
  print_curve(hunt);
  if (!arguments.unguided) print_unreached(hunt, coverage);
  return hunt.tally().findings > 0 ? kExitFailed : kExitWell;
}

}  // namespace understudy::emulator::command_line
