#include "emulator/command_line/hunt_files.h"

#include <algorithm>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/files/growing_file.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/failure_story.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/terminal.h"
#include "emulator/device/model.h"
#include "emulator/hunt/corpus.h"
#include "emulator/hunt/found_file.h"
#include "emulator/hunt/hunt.h"
#include "emulator/hunt/stage.h"
#include "emulator/play/performing/performance_recorder.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/report/page.h"
#include "emulator/play/report/run_logger.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/bench_file/yaml_text.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;

constexpr const char* kScenarioEnding = ".yaml";
constexpr const char* kRecordingEnding = ".jsonl";
constexpr const char* kPageEnding = ".html";

}  // namespace

FoundFiles::FoundFiles(ModelList models, const HuntArguments& arguments, FileClaims claims)
    : models_(models), arguments_(arguments), claims_(std::move(claims)) {
  if (fs::exists(arguments.found) && !fs::is_directory(arguments.found)) {
    throw UsageError("--found: " + arguments.found + ": is not a folder; expected one");
  }
}

void FoundFiles::add(const hunt::Finding& finding) {
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

void FoundFiles::write(const std::string& path, const std::string& text, ContentKind kind) {
  std::string why = claims_.objection_to(path);
  if (why.empty()) why = replace_text_file(path, text, kind);
  if (!why.empty()) throw GrowingFileError("--found: " + path + " cannot be written: " + why);
}

void FoundFiles::print(const hunt::Finding& finding, const std::string& path) const {
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
void FoundFiles::play(const hunt::Finding& finding, const std::string& path) {
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
  if (!fails) log_line("hunt: " + path + kScenarioEnding + " does not fail; this is a bug in understudy");
  write(path + kPageEnding, play::report_page(results, arguments_.version), ContentKind::page);
}

CorpusFile::CorpusFile(const std::string& path) : path_(path) {
  if (path_.empty() || !fs::exists(path_)) return;
  const FileText text = read_text_file(path_);
  if (!text) throw FileError(path_ + ": corpus: " + text.why + "; expected the corpus of a hunt");
  std::istringstream lines(*text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    auto parsed = hunt::parse_corpus_line(line);
    if (!parsed) throw FileError({path_, number, 1}, "corpus: is not a line of a corpus; expected a course");
    if (parsed->course) {
      courses_.push_back(*std::move(parsed->course));
    } else {
      std::uint64_t& next = next_[parsed->seed];
      next = std::max(next, parsed->next);
    }
  }
}

std::uint64_t CorpusFile::next_course(std::uint64_t seed) const {
  const auto it = next_.find(seed);
  return it == next_.end() ? 0 : it->second;
}

void CorpusFile::write(const hunt::Hunt& hunt, std::uint64_t seed) {
  next_[seed] = hunt.next_course();
  std::string text;
  for (const auto& [its_seed, next] : next_) text += hunt::json_text(its_seed, next) + "\n";
  for (const hunt::Seed& one : hunt.corpus().seeds()) text += hunt::json_text(one.course) + "\n";
  const std::string why = replace_text_file(path_, text, ContentKind::other);
  if (!why.empty()) throw GrowingFileError("--corpus: " + path_ + " cannot be written: " + why);
}

}  // namespace understudy::emulator::command_line
