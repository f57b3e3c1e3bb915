
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/result_file.h"
#include "emulator/command_line/run_files.h"
#include "emulator/command_line/terminal.h"
#include "emulator/command_line/yaml_files.h"
#include "emulator/device/model.h"
#include "emulator/play/lint/lint.h"
#include "emulator/play/performing/onlooker.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/performing/suite.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/report/camera.h"
#include "emulator/play/report/page.h"
#include "emulator/play/results/junit.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/play/stages/real_stage.h"
#include "emulator/world/names/names.h"
#include "emulator/world/trace/trace.h"

namespace understudy::emulator::command_line {

namespace {

/// The files that are played: of a folder its scenarios, and neither its benches nor steps to include.
std::vector<std::string> files_of(const std::string& path) {
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::string> files = files_below(path, kYamlEndings);
  std::erase_if(files,
                [](const std::string& file) { return play::kind_of_file(file) != play::FileKind::scenario; });
  if (files.empty()) throw FileError(path + ": folder: has no scenario; expected at least one");
  return files;
}

/// All scenarios of all files; what is wrong with each is told. Nothing if anything is.
std::optional<std::vector<play::Scenario>> load_all(ModelList models, const RunArguments& arguments) {
  std::vector<play::Scenario> scenarios;
  std::vector<std::string> files;
  play::SharedReading shared{.models = models, .benches = {}, .included = {}};
  bool is_well = true;
  for (const std::string& path : arguments.scenarios) {
    try {
      const auto more = files_of(path);
      files.insert(files.end(), more.begin(), more.end());
    } catch (const FileError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      is_well = false;
    }
  }
  for (const std::string& file : files) {
    try {
      for (play::Scenario& scenario : play::load_scenarios(file, arguments.save_below, shared)) {
        if (arguments.seed) scenario.seed = scenario.bench.seed = *arguments.seed;
        scenarios.push_back(std::move(scenario));
      }
    } catch (const FileError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      is_well = false;
    }
  }
  if (!is_well) return std::nullopt;
  return scenarios;
}

std::vector<play::Scenario> choose_some(std::vector<play::Scenario> scenarios,
                                        const RunArguments& arguments) {
  play::Shard shard;
  if (!arguments.shard.empty()) {
    const auto parsed = play::parse_shard(arguments.shard);
    if (!parsed) {
      throw UsageError("--shard: " + understudy::quoted(arguments.shard) +
                       " is not a part; expected I/N such as 1/4, I up to N");
    }
    shard = *parsed;
  }
  if (!arguments.filter.empty() && play::choose(scenarios, arguments.filter, {}).empty()) {
    throw UsageError("--filter: " + understudy::quoted(arguments.filter) +
                     " matches no scenario's name; expected a pattern such as '*move*'");
  }
  return play::choose(std::move(scenarios), arguments.filter, shard);
}

RunFolders folders_of(const RunArguments& arguments) {
  return {.recordings = arguments.record,
          .traces = arguments.trace,
          .captures = arguments.capture,
          .trace_also = arguments.trace_also};
}

/// What is written is nothing that is read, whichever scenario comes first, and nothing else that is written.
void demand_own_files(FileClaims& claims, const std::vector<play::Scenario>& scenarios,
                      const RunArguments& arguments) {
  for (const play::Scenario& scenario : scenarios) {
    for (const std::string& path : scenario.saved) {
      if (const std::string why = claims.objection_to(path); !why.empty()) {
        throw UsageError(scenario.file + ": save: " + path + " " + why);
      }
    }
    for (const std::string& path : scenario.saved) claims.add({path, "what " + scenario.file + " saves"});
  }
  if (arguments.junit != kStandardOutput) demand_output(claims, "--junit", arguments.junit);
  demand_output(claims, "--report", arguments.report);
  demand_folders(claims, folders_of(arguments));
  if (arguments.trace_also.empty()) return;
  for (const play::Scenario& scenario : scenarios) {
    try {
      world::trace_signals(world::World(scenario.bench, {}, {}), arguments.trace_also);
    } catch (const world::NameError& error) {
      throw UsageError("--trace-also: " + scenario.file + ": " + error.what());
    }
  }
}

// In real time a scenario mostly waits.
constexpr int kRealTimeJobs = 8;

int jobs_of(const RunArguments& arguments) {
  if (!arguments.jobs) {
    const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    return arguments.real_time ? std::max(cores, kRealTimeJobs) : cores;
  }
  if (*arguments.jobs < 1) {
    throw UsageError("--jobs: " + std::to_string(*arguments.jobs) + " is too few; expected 1 or more");
  }
  return *arguments.jobs;
}

void print(const std::vector<play::ScenarioResult>& results, bool with_hash, std::FILE* to) {
  for (const play::ScenarioResult& result : results) {
    std::fprintf(to, "%s\n", coloured_verdict(play::verdict_line(result), wants_colour(fileno(to))).c_str());
    if (with_hash && result.verdict != play::ScenarioResult::Verdict::not_reached) {
      std::fprintf(to, "hash %s %016" PRIx64 "\n", one_line(result.name).c_str(), result.outcome_hash);
    }
    for (const std::string& line : play::failure_lines(result)) std::fprintf(to, "      %s\n", line.c_str());
  }
  std::fflush(to);
}

}  // namespace

int run_scenarios(ModelList models, const RunArguments& arguments) {
  const int jobs = jobs_of(arguments);
  if (arguments.hash && arguments.real_time) {
    throw UsageError("--hash: in real time no two runs are the same; expected it without --real-time");
  }
  auto loaded = load_all(models, arguments);
  if (!loaded) return kExitBadInput;
  FileClaims claims;  // also by those that are not chosen
  for (const play::Scenario& scenario : *loaded) claims.add(scenario.files);
  const std::vector<play::Scenario> scenarios = choose_some(std::move(*loaded), arguments);
  demand_own_files(claims, scenarios, arguments);
  ResultFile junit("--junit", arguments.junit);
  ResultFile report("--report", arguments.report);
  RunFiles files(folders_of(arguments), std::move(claims), arguments.real_time, arguments.version);
  junit.empty();
  report.empty();
  // What is for people makes way for results on standard output.
  std::FILE* const told = arguments.junit == kStandardOutput ? stderr : stdout;
  std::vector<play::ScenarioResult> all;
  play::RunOptions options{.with_hash = arguments.hash};
  if (arguments.lint) {
    options.onlookers.push_back([](world::World& world) { return std::make_unique<play::Lint>(world); });
  }
  if (arguments.real_time) options.make_stage = play::make_real_stage;
  if (report.is_wanted()) {
    options.onlookers.push_back([](world::World& world) { return std::make_unique<play::Camera>(world); });
  }
  const auto options_for = [&](const play::Scenario& scenario) {
    play::RunOptions of_one = options;
    for (play::OnlookerMaker& maker : files.onlookers(scenario)) of_one.onlookers.push_back(std::move(maker));
    return of_one;
  };
  {
    ProgressLine progress(scenarios.size());
    play::run_suite(scenarios, options_for, jobs, [&](std::vector<play::ScenarioResult> results) {
      for (play::ScenarioResult& result : results) files.settle(result);
      progress.one_done([&] { print(results, arguments.hash, told); });
      all.insert(all.end(), results.begin(), results.end());
    });
  }
  std::fprintf(told, "%s\n", play::summary_line(all).c_str());
  for (const play::ScenarioResult& result : all) {
    for (const std::string& finding : result.manners) {
      std::fprintf(stderr, "lint: %s\n", one_line(result.file + ": " + result.name + ": " + finding).c_str());
    }
  }
  if (junit.is_wanted()) junit.write(play::junit_text(all));
  if (report.is_wanted()) report.write(play::report_page(all, arguments.version));
  const bool has_failed = std::any_of(all.begin(), all.end(), [](const play::ScenarioResult& result) {
    return result.verdict == play::ScenarioResult::Verdict::failed;
  });
  return has_failed ? kExitFailed : kExitWell;
}

}  // namespace understudy::emulator::command_line
