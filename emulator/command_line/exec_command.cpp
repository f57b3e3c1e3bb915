// Implements `understudy exec`: serves a bench while a command runs that uses it.
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/exec_courses.h"
#include "emulator/command_line/host_case.h"
#include "emulator/command_line/host_course.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/serving.h"
#include "emulator/command_line/terminal.h"
#include "emulator/device/model.h"
#include "emulator/play/performing/side_scenario.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/control/control_door.h"
#include "emulator/serve/host_time/host_library.h"
#include "emulator/serve/host_time/host_program.h"
#include "emulator/serve/loop/child.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/serve/loop/parent_signals.h"
#include "emulator/serve/ports/private_folder.h"
#include "emulator/serve/ports/tty_shim.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::command_line {

namespace {

constexpr int kExitTimedOut = 124;  // as with timeout(1)

/// Puts every file without a given path into a folder that no other process uses.
void use_private_places(Serving& serving, const ExecArguments& arguments, serve::PrivateFolder& folder) {
  if (arguments.serve.links.empty() && arguments.serve.link.empty()) {
    for (world::LineSetup& line : serving.bench.lines) {
      if (line.has_pty) line.link = folder.path() + "/" + line.name + ".port";
    }
  }
  if (arguments.serve.control.empty()) serving.options.door = serve::control_door(folder.path() + "/control");
  if (serving.options.record_path.empty()) serving.options.record_path = folder.path() + "/recording";
}

void require_host_time(const ExecArguments& arguments) {
  if (arguments.has_speed)
    throw UsageError("--host-time: the host's waits determine how fast time passes; expected no --speed");
}

/// Prints the verdicts of the scenario, and returns its exit code.
int report(const CourseEnd& end, const play::Scenario& scenario) {
  if (end.was_given_up) {
    std::fprintf(stderr, "understudy: exec: %s: did not run to its end\n", one_line(scenario.file).c_str());
    return kExitFailed;
  }
  int code = kExitWell;
  for (const play::ScenarioResult& result : end.results) {
    std::fprintf(stderr, "%s\n",
                 coloured_verdict(play::verdict_line(result), wants_colour(STDERR_FILENO)).c_str());
    for (const std::string& line : play::failure_lines(result))
      std::fprintf(stderr, "      %s\n", line.c_str());
    if (result.verdict == play::ScenarioResult::Verdict::failed) code = kExitFailed;
  }
  return code;
}

/// Returns the exit code. Reports the reason if it is not the command's own exit code.
int exit_code_of(const ExecArguments& arguments, const CourseEnd& end) {
  const std::string command = one_line(arguments.host.command[0]);
  if (end.has_timed_out) {
    std::fprintf(stderr, "understudy: exec: %s: was stopped because it took longer than %s\n",
                 command.c_str(), arguments.timeout.c_str());
    return kExitTimedOut;
  }
  if (!end.was_reached) {
    std::fprintf(stderr,
                 "understudy: exec: %s: did not load our library, so it ran in real time; expected a program "
                 "that keeps LD_PRELOAD\n",
                 command.c_str());
    return kExitNoHostTime;
  }
  return end.was_stopped ? static_cast<int>(kExitWell) : end.exit_code;
}

/// The result of a run.
struct Outcome {
  int code = kExitNotStarted;
  bool was_interrupted = false;  // exec was told to end
};

/// Serves the bench until both the command and the scenario beside it have ended.
Outcome play(const ExecArguments& arguments, const Serving& serving, serve::PrivateFolder& folder,
             const std::optional<play::Scenario>& scenario, serve::ParentSignals& signals) {
  const CourseEnd end = run_course({.serving = serving,
                                    .host = arguments.host,
                                    .folder = folder.path(),
                                    .timeout = parse_timeout(arguments.timeout),
                                    .scenario = scenario ? &*scenario : nullptr},
                                   arguments.serve, signals);
  const int scenario_code = scenario ? report(end, *scenario) : static_cast<int>(kExitWell);
  const int code = exit_code_of(arguments, end);
  return {.code = code != kExitWell ? code : scenario_code, .was_interrupted = end.was_interrupted};
}

/// Throws UsageError if the scenario and the bench would write to the same file.
void require_apart(const play::Scenario& scenario, const ServeArguments& serve, FileClaims& files) {
  FileClaims of_scenario;
  of_scenario.add(scenario.files);
  const auto require = [&](const char* flag, const std::string& path) {
    require_output(of_scenario, flag, path);
  };
  require("--capture", serve.capture);
  require("--record", older_part_of(serve.record));
  require("--record", serve.record);
  require("--trace", serve.trace);
  for (const std::string& path : scenario.saved) require_output(files, "--with: save", path);
  files.add(scenario.files);
}

Outcome execute_once(ModelList models, const ExecArguments& arguments) {
  Serving serving = make_serving(models, arguments.serve, "exec");
  require_variables(serving.bench);
  if (arguments.host.host_time) require_host_time(arguments);
  std::optional<play::Scenario> scenario;
  if (!arguments.with.empty()) {
    scenario = play::load_side_scenario(models, arguments.with, serving.bench, arguments.save_below);
    require_apart(*scenario, arguments.serve, serving.options.files);
  }
  if (arguments.host.host_time) {
    if (const std::string why = serve::why_not_in_host_time(arguments.host.command[0]); !why.empty()) {
      std::fprintf(stderr, "understudy: exec: --host-time: %s\n", why.c_str());
      return {.code = kExitNoHostTime};
    }
    serving.options.speed.kind = serve::Speed::Kind::manual;
    serving.options.is_host_simulated = true;
  }
  serve::remove_left_overs();
  serve::PrivateFolder folder;
  use_private_places(serving, arguments, folder);
  serving.options.watch_signals = false;
  serve::ParentSignals signals;
  Outcome outcome;
  try {
    outcome = play(arguments, serving, folder, scenario, signals);
  } catch (const serve::ChildError& error) {
    std::fprintf(stderr, "understudy: exec: %s\n", one_line(error.what()).c_str());
  }
  const bool has_failed = outcome.code != kExitWell && outcome.code != kExitNotStarted;
  if (!has_failed && arguments.serve.record.empty()) {
    std::error_code ignored;
    std::filesystem::remove(serving.options.record_path, ignored);
  } else if (has_failed) {
    std::fprintf(stderr, "understudy: exec: to run this again: understudy replay %s\n",
                 serving.options.record_path.c_str());
  }
  return outcome;
}

/// Runs the command several times, and compares the recordings.
int execute_repeatedly(ModelList models, const ExecArguments& arguments, int times) {
  if (!arguments.host.host_time)
    throw UsageError("--repeat: runs differ in real time; expected --repeat with --host-time");
  if (!arguments.serve.nv.empty())
    throw UsageError("--repeat: each run would begin with the memory of the previous run; expected no --nv");
  serve::PrivateFolder folder;
  Courses courses;
  int first_failure = kExitWell;
  for (int run = 1; run <= times; ++run) {
    ExecArguments once = arguments;
    once.serve.record = arguments.serve.record.empty() ? folder.path() + "/run" : arguments.serve.record;
    if (run > 1) once.serve.record += "." + std::to_string(run);
    const auto [code, was_interrupted] = execute_once(models, once);
    if (was_interrupted || code == kExitNotStarted || code == kExitNoHostTime) return code;
    if (first_failure == kExitWell) first_failure = code;
    const std::string difference = courses.add(once.serve.record);
    if (!difference.empty()) std::fprintf(stderr, "understudy: exec: %s\n", difference.c_str());
    const bool is_kept =
        run == 1 || !difference.empty() || code != kExitWell || !arguments.serve.record.empty();
    std::error_code ignored;
    if (!is_kept) std::filesystem::remove(once.serve.record, ignored);
  }
  std::fprintf(stderr, "understudy: exec: %s\n", courses.summary().c_str());
  const bool are_same = courses.count() == 1;
  if (are_same && first_failure == kExitWell && arguments.serve.record.empty()) {
    std::error_code ignored;
    std::filesystem::remove(folder.path() + "/run", ignored);
  }
  if (first_failure != kExitWell) return first_failure;
  return are_same ? kExitWell : kExitFailed;
}

bool is_scenario(const std::string& path) {
  if (path.empty() || !std::filesystem::is_regular_file(path)) return false;
  try {
    return play::kind_of_file(path) == play::FileKind::scenario;
  } catch (const FileError&) {
    return false;  // the error is reported when the file is read as a bench
  }
}

/// A flag that was given.
struct GivenFlag {
  const char* flag;
  bool is_given;
};

void require_none(std::span<const GivenFlag> flags, const std::string& why) {
  for (const GivenFlag& each : flags) {
    if (each.is_given) throw UsageError(std::string("exec: ") + each.flag + ": " + why);
  }
}

void require_bench_flags(const ExecArguments& arguments) {
  const RunArguments& cases = arguments.cases;
  const std::array<GivenFlag, 9> of_cases{{{"--junit", !cases.junit.empty()},
                                           {"--hash", cases.hash},
                                           {"--jobs", cases.jobs.has_value()},
                                           {"--shard", !cases.shard.empty()},
                                           {"--seed", cases.seed.has_value()},
                                           {"--filter", !cases.filter.empty()},
                                           {"--results", !cases.results.empty()},
                                           {"--resume", cases.resume},
                                           {"--failures", !cases.failures.empty()}}};
  require_none(of_cases, "applies only to the cases of a scenario; expected a scenario instead of the bench");
}

/// Runs the command in each case of a scenario.
int execute_cases(ModelList models, const ExecArguments& arguments) {
  const ServeArguments& serve = arguments.serve;
  const std::array<GivenFlag, 21> of_bench{{{"--with", !arguments.with.empty()},
                                            {"--repeat", arguments.repeat.has_value()},
                                            {"--speed", arguments.has_speed},
                                            {"--model", !serve.model.empty()},
                                            {"--station", serve.station.has_value()},
                                            {"--modules", serve.modules.has_value()},
                                            {"--firmware", !serve.firmware.empty()},
                                            {"--baud", serve.baud.has_value()},
                                            {"--link", !serve.link.empty()},
                                            {"--links", !serve.links.empty()},
                                            {"--group", !serve.group.empty()},
                                            {"--timing", !serve.timing.empty()},
                                            {"--strict-framing", serve.strict_framing},
                                            {"--ignore-baud", serve.ignore_baud},
                                            {"--byte-timeout", !serve.byte_timeout.empty()},
                                            {"--control", !serve.control.empty()},
                                            {"--nv", !serve.nv.empty()},
                                            {"--listen", !serve.listen.empty()},
                                            {"--no-pty", serve.no_pty},
                                            {"--coverage", !serve.coverage.empty()},
                                            {"--device-coverage", !serve.device_coverage.empty()}}};
  require_none(
      of_bench,
      "cannot be used with the cases of a scenario; expected a bench, or the scenario without this flag");
  if (const auto code = code_of_unusable(arguments.host, "exec")) return *code;
  RunArguments run = arguments.cases;
  run.scenarios = {serve.bench};
  run.real_time = !arguments.host.host_time;
  run.record = serve.record;
  run.trace = serve.trace;
  run.trace_also = serve.trace_also;
  run.capture = serve.capture;
  run.lint = serve.lint;
  run.save_below = arguments.save_below;
  run.host = arguments.host;
  run.timeout = arguments.timeout;
  run.version = serve.version;
  return run_scenarios(models, run);
}

}  // namespace

int execute(ModelList models, const ExecArguments& arguments) {
  if (!arguments.stray_words.empty() || arguments.host.command.empty()) {
    throw UsageError("exec: expected -- and a command after it, such as `exec bench.yaml -- ./my_host`");
  }
  parse_timeout(arguments.timeout);
  if (is_scenario(arguments.serve.bench)) return execute_cases(models, arguments);
  require_bench_flags(arguments);
  if (arguments.repeat && *arguments.repeat < 1)
    throw UsageError("--repeat: " + std::to_string(*arguments.repeat) +
                     " is too few; expected 1 or more runs");
  if (arguments.repeat) return execute_repeatedly(models, arguments, *arguments.repeat);
  return execute_once(models, arguments).code;
}

int print_tty_shim() {
  std::printf("%s\n", serve::library_path(serve::kTtyShimLibrary).c_str());
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
