#include "emulator/command_line/hunt_files.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
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
#include "emulator/command_line/host_case.h"
#include "emulator/command_line/hunt_hosts.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/terminal.h"
#include "emulator/device/model.h"
#include "emulator/hunt/course_player.h"
#include "emulator/hunt/found_file.h"
#include "emulator/hunt/hunt.h"
#include "emulator/play/performing/performance_recorder.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/report/page.h"
#include "emulator/play/report/run_logger.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench/bench_text.h"
#include "emulator/world/recording/recording.h"
#include "emulator/world/world.h"

namespace understudy::emulator::command_line {

namespace {

namespace fs = std::filesystem;

constexpr const char* kScenarioEnding = ".yaml";
constexpr const char* kRecordingEnding = ".jsonl";
constexpr const char* kPageEnding = ".html";

void write_found(const std::string& path, const std::string& text, ContentKind kind) {
  const std::string why = replace_text_file(path, text, kind);
  if (!why.empty()) throw GrowingFileError("--found: " + path + " cannot be written: " + why);
}

/// Returns the words of the command with each `${` escaped as `$${`, so that loading the file does not
/// replace parameters in them.
std::vector<std::string> without_parameters(std::vector<std::string> words) {
  for (std::string& word : words) {
    for (std::size_t at = 0; (at = word.find("${", at)) != std::string::npos; at += 3) word.insert(at, "$");
  }
  return words;
}

play::Scenario load_found(ModelList models, const std::string& path,
                          const std::vector<std::string>& command) {
  play::SharedReading shared{.models = models, .benches = {}, .included = {}};
  play::ScenarioFile file(path, {.command = command}, shared);
  return file.read(0);
}

}  // namespace

FoundFiles::FoundFiles(ModelList models, const HuntArguments& arguments, FileClaims claims)
    : models_(models), arguments_(arguments), claims_(std::move(claims)) {
  std::error_code error;
  if (fs::exists(arguments.found, error) && !fs::is_directory(arguments.found, error)) {
    throw UsageError("--found: " + arguments.found + ": is not a folder; expected a folder");
  }
  for (fs::path folder = arguments.found; !folder.empty() && !fs::exists(folder, error);
       folder = folder.parent_path())
    made_.push_back(folder.generic_string());
  fs::create_directories(arguments.found, error);
  const bool is_writable = !error && ::access(arguments.found.c_str(), W_OK | X_OK) == 0;
  if (!is_writable) {
    const std::string why = error ? error.message() : std::generic_category().message(errno);
    throw GrowingFileError("--found: " + arguments.found + " cannot be written: " + why);
  }
}

FoundFiles::~FoundFiles() {
  std::error_code ignored;  // a folder that is not empty is kept
  for (const std::string& folder : made_) fs::remove(folder, ignored);
}

/// Returns the path for a finding, without an extension: the first path that is not used by an edited file.
std::string FoundFiles::path_of(const hunt::Finding& finding) const {
  const std::string name = hunt::name_of_finding(*finding.course_player, finding.shrunk);
  const std::string first = (fs::path(arguments_.found) / name).generic_string();
  std::string path = first;
  for (int number = 2; hunt::is_edited(read_text_file(path + kScenarioEnding).value_or("")); ++number)
    path = first + "-" + std::to_string(number);
  return path;
}

void FoundFiles::add(const hunt::Finding& finding) {
  const hunt::CoursePlayer& course_player = *finding.course_player;
  const std::string path = path_of(finding);
  hunt::Origin origin{.command = "understudy hunt " + shell_text({arguments_.scenario}),
                      .course = finding.course,
                      .disturbances = finding.disturbances};
  if (arguments_.seed != 0) origin.command += " --seed " + std::to_string(arguments_.seed);
  if (!arguments_.shard.empty()) origin.command += " --shard " + arguments_.shard;
  if (arguments_.unguided) origin.command += " --unguided";
  if (!arguments_.corpus.empty()) origin.command += " --corpus " + shell_text({arguments_.corpus});
  if (hosts_ != nullptr) {
    origin.command += " -- " + shell_text(arguments_.host.command);
    origin.again = again_with(finding, path);
  }
  for (const char* const ending : {kScenarioEnding, kRecordingEnding, kPageEnding})
    require_writable(path + ending);
  write_found(path + kScenarioEnding,
              hunt::text_of_finding(course_player, finding.shrunk, origin, arguments_.found),
              ContentKind::scenario);
  print(finding, path);
  play(finding, path);
  std::fflush(stdout);
}

void FoundFiles::require_writable(const std::string& path) const {
  const std::string why = claims_.objection_to(path);
  if (!why.empty()) throw GrowingFileError("--found: " + path + " cannot be written: " + why);
}

/// Returns a shell command that runs a finding's scenario together with the host's command.
std::string FoundFiles::again_with(const hunt::Finding& finding, const std::string& path) const {
  const std::vector<std::string> words = without_parameters(finding.course_player->scenario().command);
  std::string text = "understudy exec " + shell_text({path + kScenarioEnding}) + " --host-time";
  if (arguments_.timeout != HuntArguments{}.timeout) text += " --timeout " + arguments_.timeout;
  return text + " -- " + shell_text(words);
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
  for (const play::Disturbance& one : found.course.disturbances)
    std::printf("      %s\n", hunt::line_of(finding.course_player->plan(), one).c_str());
  std::printf("      course %" PRIu64 ": %zu of %zu disturbances, shrunk in %d more courses\n",
              finding.course, found.course.disturbances.size(), finding.disturbances, found.plays);
  if (hosts_ != nullptr) std::printf("      %s\n", again_with(finding, path).c_str());
}

/// Plays the written file again.
void FoundFiles::play(const hunt::Finding& finding, const std::string& path) {
  const std::vector<play::ScenarioResult> results =
      hosts_ != nullptr ? hosts_->show(path, without_parameters(finding.course_player->scenario().command))
                        : show_finding(models_, arguments_, path, {});
  const bool fails = std::ranges::any_of(results, [&](const play::ScenarioResult& result) {
    return result.failure && result.branch == finding.shrunk.outcome.failed->branch;
  });
  if (!fails) log_line("hunt: " + path + kScenarioEnding + " does not fail; this is a bug in understudy");
}

std::vector<play::ScenarioResult> show_finding(ModelList models, const HuntArguments& arguments,
                                               const std::string& path,
                                               const std::vector<std::string>& command) {
  const play::Scenario scenario = load_found(models, path + kScenarioEnding, command);
  const std::string recording = path + kRecordingEnding;
  play::RunOptions options;
  options.observers.push_back([](world::World& world) { return std::make_unique<play::RunLogger>(world); });
  std::vector<play::ScenarioResult> results;
  if (command.empty()) {
    options.observers.push_back([&](world::World& world) {
      world::RecordingHeader header{.version = arguments.version,
                                    .bench = world::to_text(scenario.bench),
                                    .options = {},
                                    .seed = scenario.bench.seed,
                                    .snapshot = {}};
      header.options.strict_framing = true;
      return std::make_unique<play::PerformanceRecorder>(world, std::move(header), recording);
    });
    results = play::run_scenario(scenario, options);
  } else {
    results = run_beside(scenario, std::move(options), arguments, recording);
  }
  for (play::ScenarioResult& result : results) {
    if (result.failure) result.failure->led_to = events_before_failure(models, recording);
  }
  write_found(path + kPageEnding, play::report_page(results, arguments.version), ContentKind::page);
  return results;
}

}  // namespace understudy::emulator::command_line
