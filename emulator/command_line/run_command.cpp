
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/state/state_bytes.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/coverage_file.h"
#include "emulator/command_line/device_coverage_file.h"
#include "emulator/command_line/dialogue.h"
#include "emulator/command_line/findings.h"
#include "emulator/command_line/host_case.h"
#include "emulator/command_line/on_box.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/result_file.h"
#include "emulator/command_line/run_account.h"
#include "emulator/command_line/run_files.h"
#include "emulator/command_line/run_settings.h"
#include "emulator/command_line/terminal.h"
#include "emulator/command_line/worker_processes.h"
#include "emulator/command_line/yaml_files.h"
#include "emulator/device/model.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/lint/lint.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/play/performing/observer.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/performing/suite.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/reading/scenario_warnings.h"
#include "emulator/play/report/run_logger.h"
#include "emulator/play/results/junit.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_state.h"
#include "emulator/play/scenario/case.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/world/names/names.h"
#include "emulator/world/trace/trace.h"
#include "pty/port_link.h"

namespace understudy::emulator::command_line {

namespace {

/// Returns the scenario files at a path. For a folder, omits benches and included steps.
std::vector<std::string> files_of(const std::string& path) {
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::string> files = files_below(path, kYamlEndings);
  std::erase_if(files,
                [](const std::string& file) { return play::kind_of_file(file) != play::FileKind::scenario; });
  if (files.empty()) throw FileError(path + ": folder: has no scenario; expected at least one");
  return files;
}

/// A file that a scenario saves.
struct SavedFile {
  std::string path;
  std::string scenario;  // the scenario's file
  std::size_t case_number;
  bool is_varied;  // only a case list can determine whether two such cases save the same file
};

/// The results of checking all scenarios before any of them runs.
struct Known {
  FileClaims claims;      // claims for the files that are read
  std::size_t cases = 0;  // the number of checked cases
  std::vector<SavedFile> saved{};
  std::set<std::string> warned{};  // warnings about programs, each of which is printed only once
  std::string trace_error{};       // why --trace-also does not fit one of the scenarios; empty: it fits
  std::set<std::string> lines{};   // the lines of all benches
};

void warn(const play::Scenario& scenario, Known& known) {
  for (const FileError::Diagnostic& odd : play::warnings_of(scenario)) {
    const std::string line = warning_line(odd);
    if (known.warned.insert(line).second) std::fprintf(stderr, "%s\n", line.c_str());
  }
}

bool has_command(const RunArguments& arguments) { return !arguments.host.command.empty(); }

void note_saved(const play::Scenario& scenario, const RunArguments& arguments, Known& known) {
  ++known.cases;
  for (const world::LineSetup& line : scenario.bench.lines) known.lines.insert(line.name);
  require_steps_for(scenario, has_command(arguments));
  if (!play::matches(arguments.filter, scenario.name, play::identity_of(scenario.which))) return;
  warn(scenario, known);
  for (const std::string& path : scenario.saved) {
    known.saved.push_back({path, scenario.file, known.cases, scenario.which.is_varied});
  }
  if (arguments.trace_also.empty() || !known.trace_error.empty()) return;
  try {
    world::trace_signals(world::World(scenario.bench, {}, {}), arguments.trace_also);
  } catch (const world::NameError& error) {
    known.trace_error = "--trace-also: " + scenario.file + ": " + error.what();
  }
}

/// Adds all files and prints their errors. Returns false if there are any.
bool add_all(play::CaseList& case_list, const RunArguments& arguments, Known& known) {
  std::vector<std::string> files;
  bool is_well = true;
  const auto attempt = [&](const auto& act) {
    try {
      act();
    } catch (const FileError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      is_well = false;
    }
  };
  for (const std::string& path : arguments.scenarios) {
    attempt([&] {
      const auto more = files_of(path);
      files.insert(files.end(), more.begin(), more.end());
    });
  }
  for (const std::string& file : files) {
    attempt([&] {
      case_list.add(file, [&](const play::Scenario& scenario) {
        known.claims.add(scenario.files);  // the files of unselected scenarios also count
        note_saved(scenario, arguments, known);
      });
    });
  }
  return is_well;
}

void require_some(const play::CaseList& case_list, const RunArguments& arguments) {
  if (arguments.filter.empty() || play::Selection(case_list, arguments.filter, {}).next()) return;
  throw UsageError("--filter: " + understudy::quoted(arguments.filter) +
                   " matches no scenario's name; expected a pattern such as '*move*'");
}

RunFolders folders_of(const RunArguments& arguments) {
  return {.recordings = arguments.record,
          .failures = arguments.failures,
          .traces = arguments.trace,
          .captures = arguments.capture,
          .trace_also = arguments.trace_also};
}

/// Throws UsageError if an output file is also read or is written twice, or if a name in a flag is in no
/// scenario. The order of scenarios does not matter.
void require_fitting_flags(Known& known, const RunArguments& arguments) {
  FileClaims& claims = known.claims;
  std::vector<FileClaim> of_this;  // the same case may save a file twice
  for (std::size_t i = 0; i < known.saved.size(); ++i) {
    const SavedFile& saved = known.saved[i];
    if (const std::string why = claims.objection_to(saved.path); !why.empty()) {
      throw UsageError(saved.scenario + ": save: " + saved.path + " " + why);
    }
    if (!saved.is_varied) of_this.push_back({saved.path, "what " + saved.scenario + " saves"});
    const bool is_last = i + 1 == known.saved.size() || known.saved[i + 1].case_number != saved.case_number;
    if (is_last) claims.add(std::exchange(of_this, {}));
  }
  if (arguments.junit != kStandardOutput) require_output(claims, "--junit", arguments.junit);
  require_output(claims, "--report", arguments.report);
  require_coverage(claims, coverage_of(arguments));
  require_device_coverage(claims, arguments.device_coverage);
  for (const std::string& path : arguments.results) require_output(claims, "--results", path);
  require_folders(claims, folders_of(arguments));
  if (!known.trace_error.empty()) throw UsageError(known.trace_error);
  require_lines_of_benches(arguments.on, known.lines);
}

/// Returns how failures are recorded.
Recorded recorded_by(const RunArguments& arguments) {
  if (has_command(arguments) || is_on_box(arguments)) return Recorded::apart;
  return arguments.real_time ? Recorded::always : Recorded::again;
}

/// Runs a scenario with its observers.
class CaseRunner {
 public:
  CaseRunner(ModelList models, const RunArguments& arguments, RunFiles& files, RunCoverage& coverage)
      : models_(models), arguments_(arguments), files_(files), coverage_(coverage) {
    // Result rows contain the hash.
    options_.with_hash = arguments.hash || (!arguments.results.empty() && !arguments.real_time);
    if (arguments.lint) {
      options_.observers.push_back([](world::World& world) { return std::make_unique<play::Lint>(world); });
    }
    if (arguments.real_time) options_.make_executor = play::make_real_executor;
    if (is_on_box(arguments)) {
      options_.with_hash = false;
      on_box_ = std::make_shared<OnBox>(arguments.on);
      options_.make_executor = [stage = on_box_](const play::Scenario& scenario) {
        return stage->make(scenario);
      };
    }
  }

  std::vector<play::ScenarioResult> play(play::CaseReader& reader, const play::CaseId& which_case,
                                         const play::CaseList& case_list) const {
    try {
      const auto scenario = reader.read(which_case);
      play::RunOptions options = options_;
      // For varied cases, the run log is created only when a case is shown, because there may be any number
      // of cases.
      if (is_on_box(arguments_)) return play_on_box(*scenario);
      if (!arguments_.report.empty() && !scenario->which.is_varied) options.observers.push_back(run_logger());
      add(options, files_.observers(*scenario));
      add(options, coverage_.observers(*scenario));
      if (has_command(arguments_))
        return run_host_case(*scenario, std::move(options), arguments_, files_.next_spool(".jsonl"));
      return with_rerun(play::run_scenario(*scenario, options));
    } catch (const FileError& error) {
      return {unreadable(reader, which_case, case_list, error)};
    }
  }

  /// Runs the case again with a recorder, and with a run log if there is a page. In virtual time, the result
  /// is the same.
  std::vector<play::ScenarioResult> play_again(play::CaseReader& reader,
                                               const play::CaseId& which_case) const {
    const auto scenario = reader.read(which_case);
    play::RunOptions options = options_;
    if (!arguments_.report.empty()) options.observers.push_back(run_logger());
    options.observers.push_back(files_.recorder(*scenario));
    return play::run_scenario(*scenario, options);
  }

 private:
  /// If a port is lost, the case fails. If a port cannot be opened, the run ends.
  std::vector<play::ScenarioResult> play_on_box(const play::Scenario& scenario) const {
    if (arguments_.on.plan)
      std::printf("%s: %s\n", one_line(scenario.file).c_str(), one_line(scenario.name).c_str());
    bool was_opened = false;
    play::RunOptions options = options_;
    if (arguments_.dialogue)
      options.more = [&](play::Performance& performance) { hold_dialogue(models_, scenario, performance); };
    options.make_executor = [&](const play::Scenario& of) {
      auto executor = options_.make_executor(of);
      was_opened = true;
      return executor;
    };
    try {
      return play::run_scenario(scenario, options);
    } catch (const pty::PortError& error) {
      if (!was_opened) throw;
      play::ScenarioResult result{
          .verdict = play::ScenarioResult::Verdict::failed, .name = scenario.name, .file = scenario.file};
      result.which = scenario.which;
      result.failure = play::Failure{.what = one_line(error.what())};
      return {std::move(result)};
    }
  }

  /// Adds the seed of `--seed` to the command line for running a case alone.
  std::vector<play::ScenarioResult> with_rerun(std::vector<play::ScenarioResult> results) const {
    for (play::ScenarioResult& result : results) {
      if (!arguments_.seed || !result.which.is_varied) continue;
      result.rerun = "run " + shell_text({result.file}) + " --seed " + std::to_string(*arguments_.seed) +
                     " --filter " + play::identity_text(play::identity_of(result.which));
    }
    return results;
  }

  static play::ObserverMaker run_logger() {
    return [](world::World& world) { return std::make_unique<play::RunLogger>(world); };
  }
  static void add(play::RunOptions& options, std::vector<play::ObserverMaker> more) {
    for (play::ObserverMaker& maker : more) options.observers.push_back(std::move(maker));
  }

  /// Returns the result of a case that was not checked before the run and cannot be read.
  static play::ScenarioResult unreadable(play::CaseReader& reader, const play::CaseId& which_case,
                                         const play::CaseList& case_list, const FileError& error) {
    play::ScenarioResult result{.verdict = play::ScenarioResult::Verdict::failed,
                                .name = case_list.path(which_case.file),
                                .file = case_list.path(which_case.file)};
    result.is_unreadable = true;
    result.which.is_varied = case_list.is_varied(which_case.file);
    try {
      result.which = reader.case_of(which_case);
      result.name = reader.name_of(which_case);
    } catch (const FileError&) {
      // The result contains the file's name.
    }
    play::Failure failure{.what = one_line(error.diagnostics().front().text)};
    for (std::size_t i = 1; i < error.diagnostics().size(); ++i) {
      failure.details.push_back(one_line(error.diagnostics()[i].text));
    }
    result.failure = std::move(failure);
    return result;
  }

  ModelList models_;
  const RunArguments& arguments_;
  RunFiles& files_;
  RunCoverage& coverage_;
  std::shared_ptr<OnBox> on_box_{};  // null: the controllers are simulated
  play::RunOptions options_{};
};

/// Creates a function for each thread that runs cases. A case with a command runs in a separate process.
class Players {
 public:
  Players(const CaseRunner& runner, const play::CaseList& case_list, bool have_processes, int threads)
      : runner_(runner), case_list_(case_list) {
    if (have_processes) workers_.emplace(threads, [this] { return make_work(); });
  }
  /// May be called on any thread.
  play::Play make() {
    if (!workers_) return make_here();
    return [this, worker = taken_++](const play::CaseId& which_case) {
      StateWriter question;
      question.write(which_case.file);
      question.write(which_case.number);
      const std::vector<std::byte> answer = workers_->ask(worker, question.take());
      std::vector<play::ScenarioResult> results;
      StateReader(answer).read(results);
      return results;
    };
  }

 private:
  play::Play make_here() const {
    return [this, own = std::make_shared<play::CaseReader>(case_list_)](const play::CaseId& which_case) {
      return runner_.play(*own, which_case, case_list_);
    };
  }

  Work make_work() const {
    return [play = make_here()](std::span<const std::byte> question) {
      play::CaseId which_case;
      StateReader reader(question);
      reader.read(which_case.file);
      reader.read(which_case.number);
      StateWriter answer;
      answer.write(play(which_case));
      return answer.take();
    };
  }

  const CaseRunner& runner_;
  const play::CaseList& case_list_;
  std::atomic<std::size_t> taken_ = 0;
  std::optional<WorkerProcesses> workers_;
};

/// Returns false if the run was interrupted. A stage with real controllers then stops their machine and ends.
bool play_all(const play::NextCase& next, Players& players, int threads,
              const std::function<void(const play::CaseId&, std::vector<play::ScenarioResult>)>& add) {
  try {
    play::run_suite(
        next, [&] { return players.make(); }, threads, add);
    return true;
  } catch (const play::ExecutionAborted&) {
    return false;
  }
}

/// Returns the exit code, which is also 1 if the coverage of programs is too low.
int exit_code_of(const RunAccount& account, bool was_interrupted, bool is_enough) {
  const int code = was_interrupted ? static_cast<int>(kExitFailed) : account.exit_code();
  return code == kExitWell && !is_enough ? static_cast<int>(kExitFailed) : code;
}

}  // namespace

int run_scenarios(ModelList models, const RunArguments& arguments) {
  const int jobs = jobs_of(arguments);
  require_flags_that_agree(arguments);
  require_flags_of_boxes(arguments);
  const std::string maker = maker_of(arguments);
  const play::Shard shard = shard_of(arguments);
  play::CaseList case_list(
      models,
      {.save_below = arguments.save_below, .seed = arguments.seed, .command = arguments.host.command});
  Known known;
  if (!add_all(case_list, arguments, known)) return kExitBadInput;
  require_some(case_list, arguments);
  require_fitting_flags(known, arguments);
  ResultFile junit("--junit", arguments.junit, ContentKind::junit);
  ResultFile report("--report", arguments.report, ContentKind::page);
  RunCoverage coverage(arguments);
  RunAccount account(models, arguments);
  RunFiles files(folders_of(arguments), std::move(known.claims), recorded_by(arguments), arguments.version);
  junit.empty();
  report.empty();
  coverage.empty();
  account.begin();
  const CaseRunner runner(models, arguments, files, coverage);
  play::CaseReader reader(case_list);  // one reader for each thread
  play::CaseReader next_reader(case_list);
  const std::uint64_t total = play::Selection::count(case_list, arguments.filter, shard);
  play::Selection selection(case_list, arguments.filter, shard);
  const auto threads = static_cast<int>(std::min<std::uint64_t>(static_cast<std::uint64_t>(jobs), total));
  Players players(runner, case_list, has_command(arguments), threads);
  bool was_interrupted = false;
  {
    ProgressLine progress(total, !arguments.on.ask);
    const auto next = [&] {
      std::optional<play::CaseId> which_case;
      while ((which_case = selection.next())) {
        if (!arguments.resume) break;
        const bool was_played =
            account.was_played({.file = case_list.path(which_case->file),
                                .identity = play::identity_of(next_reader.case_of(*which_case)),
                                .made_of = made_of(case_list, which_case->file, maker)});
        if (!was_played) break;
        progress.one_left_out();
      }
      return which_case;
    };
    const auto add = [&](const play::CaseId& which_case, std::vector<play::ScenarioResult> results) {
      account.add(std::move(results), made_of(case_list, which_case.file, maker), files, progress,
                  [&] { return runner.play_again(reader, which_case); });
    };
    was_interrupted = !play_all(next, players, threads, add);
  }
  account.finish();
  if (was_interrupted) std::fprintf(stderr, "understudy: interrupted; the other scenarios were not played\n");
  if (play::Junit* const results = account.junit()) {
    results->write([&](std::string_view piece) { junit.write(piece); });
  }
  const bool is_enough = coverage.write(arguments.junit == kStandardOutput ? stderr : stdout);
  if (report.is_wanted()) report.replace(account.report(coverage.section()));
  return exit_code_of(account, was_interrupted, is_enough);
}

}  // namespace understudy::emulator::command_line
