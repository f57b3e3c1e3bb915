#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/files/growing_file.h"
#include "base/files/text_file.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/failure_story.h"
#include "emulator/command_line/interruption.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/terminal.h"
#include "emulator/device/model.h"
#include "emulator/hunt/found_file.h"
#include "emulator/hunt/hunt.h"
#include "emulator/hunt/stage.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/performing/performance_recorder.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/report/page.h"
#include "emulator/play/report/run_logger.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/bench_file/yaml_text.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kScenarioEnding = ".yaml";
constexpr const char* kRecordingEnding = ".jsonl";
constexpr const char* kPageEnding = ".html";

/// Returns when the hunt is to end; nothing if only the number of courses ends it.
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
  if (*arguments.jobs >= 1) return *arguments.jobs;
  throw UsageError("--jobs: " + std::to_string(*arguments.jobs) + " is too few; expected 1 or more");
}

play::Shard shard_of_hunt(const HuntArguments& arguments) {
  if (arguments.shard.empty()) return {};
  if (const auto parsed = play::parse_shard(arguments.shard)) return *parsed;
  throw UsageError("--shard: " + quoted(arguments.shard) +
                   " is not a part; expected I/N such as 1/4, I up to N");
}

void require_hunted(const play::Scenario& scenario) {
  if (scenario.hunt == nullptr) {
    throw FileError(scenario.file +
                    ": hunt: is missing; expected `hunt:` with what may happen, as in "
                    "`hunt: { may: [ inject: { drop: feeder } ] }`");
  }
  if (!scenario.saved.empty()) {
    throw FileError(scenario.file + ": save: cannot be hunted, since courses would write the same file");
  }
}

/// Keeps what is found in a folder, and tells people about it.
class FoundFiles {
 public:
  FoundFiles(ModelList models, const HuntArguments& arguments, FileClaims claims)
      : models_(models), arguments_(arguments), claims_(std::move(claims)) {
    if (fs::exists(arguments.found) && !fs::is_directory(arguments.found)) {
      throw UsageError("--found: " + arguments.found + ": is not a folder; expected one");
    }
  }

  void add(const hunt::Finding& finding) {
    ++count_;
    fs::create_directories(arguments_.found);
    const hunt::Stage& stage = *finding.stage;
    const std::string path =
        (fs::path(arguments_.found) / hunt::name_of_finding(stage, finding.shrunk)).generic_string();
    hunt::Origin origin{.command = "understudy hunt " + arguments_.scenario,
                        .course = finding.course,
                        .disturbances = finding.disturbances};
    if (arguments_.seed != 0) origin.command += " --seed " + std::to_string(arguments_.seed);
    write(path + kScenarioEnding, hunt::text_of_finding(stage, finding.shrunk, origin, arguments_.found),
          ContentKind::scenario);
    print(finding, path);
    play(finding, path);
    std::fflush(stdout);
  }

 private:
  void write(const std::string& path, const std::string& text, ContentKind kind) {
    std::string why = claims_.objection_to(path);
    if (why.empty()) why = replace_text_file(path, text, kind);
    if (!why.empty()) throw GrowingFileError("--found: " + path + " cannot be written: " + why);
  }

  void print(const hunt::Finding& finding, const std::string& path) const {
    const hunt::Shrunk& found = finding.shrunk;
    const std::string verdict = coloured_verdict(
        "FAIL  " + path + kScenarioEnding + ": " + one_line(found.outcome.failed->failure->what),
        wants_colour(fileno(stdout)));
    std::printf("%s\n", verdict.c_str());
    if (found.course.disturbances.empty()) {
      std::printf("      without any disturbance\n");
      return;
    }
    for (const play::Disturbance& one : found.course.disturbances) {
      std::string step = world::flow_text(finding.stage->plan().step_of(one));
      step = step.substr(2, step.size() - 4);  // without its braces
      std::printf("      %s\n", one_line(step).c_str());
    }
    std::printf("      course %" PRIu64 ": %zu of %zu disturbances, shrunk in %d more courses\n",
                finding.course, found.course.disturbances.size(), finding.disturbances, found.plays);
  }

  /// Plays the written file once more, with a recorder, as `run` does.
  void play(const hunt::Finding& finding, const std::string& path) {
    std::vector<play::Scenario> scenarios = play::load_scenarios(models_, path + kScenarioEnding);
    const play::Scenario& scenario = scenarios.front();
    play::RunOptions options;
    options.observers.push_back([](world::World& world) { return std::make_unique<play::RunLogger>(world); });
    const std::string recording = path + kRecordingEnding;
    if (const std::string why = claims_.objection_to(recording); !why.empty())
      throw GrowingFileError("--found: " + recording + " cannot be written: " + why);
    options.observers.push_back([&](world::World& world) {
      world::RecordingHeader header{.version = arguments_.version,
                                    .bench = world::to_text(scenario.bench),
                                    .options = {},
                                    .seed = scenario.bench.seed,
                                    .snapshot = {}};
      header.options.strict_framing = true;
      return std::make_unique<play::PerformanceRecorder>(world, std::move(header), recording);
    });
    std::vector<play::ScenarioResult> results = play::run_scenario(scenario, options);
    bool fails = false;
    for (play::ScenarioResult& result : results) {
      if (!result.failure) continue;
      fails = fails || result.branch == finding.shrunk.outcome.failed->branch;
      result.failure->led_to = what_led_to_it(models_, recording);
    }
    if (!fails) log_line("hunt: " + path + kScenarioEnding + " does not fail; this is a fault of understudy");
    write(path + kPageEnding, play::report_page(results, arguments_.version), ContentKind::page);
  }

  ModelList models_;
  const HuntArguments& arguments_;
  FileClaims claims_;
  std::size_t count_ = 0;
};

std::string rate_text(double rate) {
  char figures[40];
  std::snprintf(figures, sizeof figures, rate < 10 ? "%.1f/s" : "%.0f/s", rate);
  return figures;
}

/// Returns the line that a terminal shows.
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
    if (tally.findings > 0)
      text += ", the last " + std::to_string(static_cast<int>(seconds - last_)) + " s ago";
    return text;
  }

 private:
  const hunt::Hunt& hunt_;
  std::size_t findings_ = 0;
  double last_ = 0;
};

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
  hunt::HuntOptions options{.seed = arguments.seed,
                            .jobs = jobs_of_hunt(arguments),
                            .courses = arguments.courses.value_or(UINT64_MAX),
                            .shard = shard_of_hunt(arguments)};
  play::CaseList cases(models, {});
  FileClaims claims;
  cases.add(arguments.scenario, [&](const play::Scenario& scenario) {
    require_hunted(scenario);
    claims.add(scenario.files);
  });
  FoundFiles files(models, arguments, std::move(claims));
  const auto end = end_of(arguments);
  watch_for_interruption();
  options.is_over = [&end] { return is_interrupted() || (end && Clock::now() >= *end); };
  hunt::Hunt hunt(cases, models, options, play::run_scenario);
  {
    HuntProgress state(hunt);
    ProgressLine progress([&](double seconds) { return state.text(seconds); });
    hunt.run([&](const hunt::Finding& finding) { progress.above([&] { files.add(finding); }); });
  }
  print_summary(hunt);
  return hunt.tally().findings > 0 ? kExitFailed : kExitWell;
}

}  // namespace understudy::emulator::command_line
