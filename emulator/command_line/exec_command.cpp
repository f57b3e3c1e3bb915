// Implements `understudy exec`: serves a bench while a command that uses it runs.
#include <signal.h>
#include <sys/timerfd.h>
#include <sys/types.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "base/files/file_claims.h"
#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/coverage_file.h"
#include "emulator/command_line/exec_courses.h"
#include "emulator/command_line/log.h"
#include "emulator/command_line/output_paths.h"
#include "emulator/command_line/serving.h"
#include "emulator/command_line/terminal.h"
#include "emulator/device/model.h"
#include "emulator/play/lint/lint.h"
#include "emulator/play/performing/side_scenario.h"
#include "emulator/play/results/result.h"
#include "emulator/play/results/result_text.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/control/control_door.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/host_time/host_program.h"
#include "emulator/serve/host_time/host_time.h"
#include "emulator/serve/loop/child.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/serve/loop/pacer.h"
#include "emulator/serve/loop/parent_signals.h"
#include "emulator/serve/ports/port_group.h"
#include "emulator/serve/ports/private_folder.h"
#include "emulator/serve/ports/tty_shim.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::command_line {

namespace {

// These are the codes of timeout(1) and of shells.
constexpr int kExitTimedOut = 124;
constexpr int kExitNotStarted = 127;
constexpr int kExitNoHostTime = 125;  // the command cannot live in simulated time

/// Calls a function once, this long after its construction.
class Alarm {
 public:
  Alarm(serve::EventLoop& loop, serve::WallTime after, std::function<void()> call)
      : loop_(loop), timer_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {
    if (timer_ < 0) throw std::system_error(errno, std::generic_category(), "timerfd_create");
    itimerspec setting{};
    setting.it_value.tv_sec = after.count() / 1'000'000'000;
    setting.it_value.tv_nsec = after.count() % 1'000'000'000;
    timerfd_settime(timer_, 0, &setting, nullptr);
    loop_.watch(timer_, serve::EventLoop::readable, [this, call = std::move(call)](std::uint32_t) {
      std::uint64_t ignored = 0;
      if (read(timer_, &ignored, sizeof ignored) > 0) call();
    });
  }
  ~Alarm() {
    loop_.unwatch(timer_);
    close(timer_);
  }
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;

 private:
  serve::EventLoop& loop_;
  int timer_;
};

std::string variable_of(const std::string& line) {
  std::string name = "UNDERSTUDY_PORT_" + line;
  for (char& c : name) {
    const auto letter = static_cast<unsigned char>(c);
    c = std::isalnum(letter) != 0 ? static_cast<char>(std::toupper(letter)) : '_';
  }
  return name;
}

void require_variables(const world::Bench& bench) {
  for (std::size_t i = 0; i < bench.lines.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (variable_of(bench.lines[i].name) != variable_of(bench.lines[j].name)) continue;
      throw UsageError("exec: the lines " + understudy::quoted(bench.lines[j].name) + " and " +
                       understudy::quoted(bench.lines[i].name) + " would both be " +
                       variable_of(bench.lines[i].name) + "; expected names that differ more");
    }
  }
}

/// Puts everything without a given path into a folder that no other process uses.
void use_private_places(Serving& serving, const ExecArguments& arguments, serve::PrivateFolder& folder) {
  if (arguments.serve.links.empty() && arguments.serve.link.empty()) {
    for (world::LineSetup& line : serving.bench.lines) {
      if (line.has_pty) line.link = folder.path() + "/" + line.name + ".port";
    }
  }
  if (arguments.serve.control.empty()) serving.options.door = serve::control_door(folder.path() + "/control");
  if (serving.options.record_path.empty()) serving.options.record_path = folder.path() + "/recording";
}

serve::ChildCommand command_for(const ExecArguments& arguments, const serve::Daemon& daemon) {
  serve::ChildCommand command{.words = arguments.command, .environment = {}};
  auto& environment = command.environment;
  for (const auto& port : daemon.ports()) {
    const std::string path = port->place();
    if (port == daemon.ports().front()) environment.emplace_back("UNDERSTUDY_PORT", path);
    environment.emplace_back(variable_of(daemon.world().line(port->line_number()).line.name()), path);
  }
  environment.emplace_back("UNDERSTUDY_CONTROL", daemon.control_path());
  if (arguments.tty_shim && !arguments.host_time)
    environment.emplace_back("LD_PRELOAD", serve::preload_with(serve::kTtyShimLibrary));
  return command;
}

void require_host_time(const ExecArguments& arguments, const world::Bench& bench) {
  if (arguments.has_speed)
    throw UsageError("--host-time: the host's waits decide how fast time goes; expected no --speed");
  for (const world::LineSetup& line : bench.lines) {
    if (line.tcp.empty()) continue;
    throw UsageError("--host-time: line " + line.name +
                     " listens on TCP; expected lines with pseudo-terminals only");
  }
}

std::optional<serve::WallTime> timeout_of(const ExecArguments& arguments) {
  if (arguments.timeout.empty()) return std::nullopt;
  const auto timeout = parse_duration(arguments.timeout);
  if (!timeout || *timeout <= SimTime{0}) {
    throw UsageError("--timeout: " + understudy::quoted(arguments.timeout) +
                     " is not a time to wait; expected one such as 30s");
  }
  return timeout;
}

/// Prints the verdicts of the scenario and returns its exit code.
int tell_of(const play::SideScenario& side_scenario, const play::Scenario& scenario) {
  if (side_scenario.was_given_up()) {
    std::fprintf(stderr, "understudy: exec: %s: did not run to its end\n", one_line(scenario.file).c_str());
    return kExitFailed;
  }
  int code = kExitWell;
  for (const play::ScenarioResult& result : side_scenario.results()) {
    std::fprintf(stderr, "%s\n",
                 coloured_verdict(play::verdict_line(result), wants_colour(STDERR_FILENO)).c_str());
    for (const std::string& line : play::failure_lines(result))
      std::fprintf(stderr, "      %s\n", line.c_str());
    if (result.verdict == play::ScenarioResult::Verdict::failed) code = kExitFailed;
  }
  return code;
}

/// Reports why the command's own exit code does not count, if it does not.
int exit_code_of(const ExecArguments& arguments, const serve::Child& child, bool timed_out,
                 bool was_reached) {
  const std::string command = one_line(arguments.command[0]);
  if (timed_out) {
    std::fprintf(stderr, "understudy: exec: %s: was ended because it took longer than %s\n", command.c_str(),
                 arguments.timeout.c_str());
    return kExitTimedOut;
  }
  if (!was_reached) {
    std::fprintf(stderr,
                 "understudy: exec: %s: did not load our library, so it ran in real time; expected a program "
                 "that keeps LD_PRELOAD\n",
                 command.c_str());
    return kExitNoHostTime;
  }
  return child.exit_code();
}

void share_ports(const serve::Daemon& daemon, gid_t group) {
  for (const auto& port : daemon.ports()) {
    if (port->terminal() != nullptr) serve::share_port(port->terminal()->path(), group);
  }
}

/// Serves the bench until both the command and the scenario alongside it end.
int play(const ExecArguments& arguments, const Serving& serving, serve::PrivateFolder& folder,
         const std::optional<play::Scenario>& scenario, serve::ParentSignals& signals) {
  const auto timeout = timeout_of(arguments);
  serve::Daemon daemon(serving.bench, serving.options, log_line);
  ServedCoverage coverage(arguments.serve, daemon);
  if (serving.group) share_ports(daemon, *serving.group);
  std::optional<play::Lint> lint;
  if (arguments.serve.lint) lint.emplace(daemon.world());
  std::optional<serve::HostTime> host_time;
  serve::ChildCommand command = command_for(arguments, daemon);
  if (arguments.host_time) {
    host_time.emplace(daemon, folder.path() + "/host", log_line);
    for (auto& variable : host_time->environment()) command.environment.push_back(std::move(variable));
  }
  std::optional<serve::Child> child;
  std::optional<play::SideScenario> side_scenario;
  bool child_is_over = false;
  bool side_scenario_is_over = !scenario;
  bool timed_out = false;
  const auto give_up_side_scenario = [&] {
    if (side_scenario) side_scenario->give_up();
  };
  const auto stop_if_over = [&] {
    if (child_is_over && side_scenario_is_over) daemon.stop();
  };
  child.emplace(daemon.loop(), signals, command, [&] {
    child_is_over = true;
    if (host_time) host_time->host_ended();
    // No client is left that could advance the time.
    if (child->was_ended() || daemon.pacer().standing()) give_up_side_scenario();
    stop_if_over();
  });
  signals.watch(daemon.loop(), [&](int signal_number) {
    if (signal_number == SIGCHLD) return child->look_after_children();
    child->end_with(signal_number);
    if (child_is_over) give_up_side_scenario();
  });
  std::optional<Alarm> alarm;
  if (timeout) {
    alarm.emplace(daemon.loop(), *timeout, [&] {
      timed_out = true;
      child->end_with(SIGTERM);
      if (child_is_over) give_up_side_scenario();
    });
  }
  if (scenario) {
    side_scenario.emplace(*scenario, daemon, [&] {
      side_scenario_is_over = true;
      stop_if_over();
    });
  }
  daemon.run();
  signals.unwatch(daemon.loop());
  if (lint) print_findings(lint->findings());
  coverage.write();
  const int scenario_code = side_scenario ? tell_of(*side_scenario, *scenario) : kExitWell;
  const int code = exit_code_of(arguments, *child, timed_out, !host_time || host_time->was_greeted());
  return code != kExitWell ? code : scenario_code;
}

/// Throws UsageError if the scenario and the bench would write the same file.
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

int execute_once(ModelList models, const ExecArguments& arguments) {
  Serving serving = make_serving(models, arguments.serve, "exec");
  require_variables(serving.bench);
  if (arguments.host_time) require_host_time(arguments, serving.bench);
  std::optional<play::Scenario> scenario;
  if (!arguments.with.empty()) {
    scenario = play::load_side_scenario(models, arguments.with, serving.bench, arguments.save_below);
    require_apart(*scenario, arguments.serve, serving.options.files);
  }
  if (arguments.host_time) {
    if (const std::string why = serve::why_not_in_host_time(arguments.command[0]); !why.empty()) {
      std::fprintf(stderr, "understudy: exec: --host-time: %s\n", why.c_str());
      return kExitNoHostTime;
    }
    serving.options.speed.kind = serve::Speed::Kind::manual;
  }
  serve::remove_left_overs();
  serve::PrivateFolder folder;
  use_private_places(serving, arguments, folder);
  serving.options.watch_signals = false;
  serve::ParentSignals signals;
  int code = kExitNotStarted;
  try {
    code = play(arguments, serving, folder, scenario, signals);
  } catch (const serve::ChildError& error) {
    std::fprintf(stderr, "understudy: exec: %s\n", one_line(error.what()).c_str());
  }
  const bool has_failed = code != kExitWell && code != kExitNotStarted;
  if (!has_failed && arguments.serve.record.empty()) {
    std::error_code ignored;
    std::filesystem::remove(serving.options.record_path, ignored);
  } else if (has_failed) {
    std::fprintf(stderr, "understudy: exec: to run this again: understudy replay %s\n",
                 serving.options.record_path.c_str());
  }
  return code;
}

/// Runs the command several times, and compares what happened.
int execute_repeatedly(ModelList models, const ExecArguments& arguments, int times) {
  if (!arguments.host_time)
    throw UsageError("--repeat: runs differ in real time; expected --host-time as well");
  if (!arguments.serve.nv.empty())
    throw UsageError("--repeat: each run would begin with the memory of the run before; expected no --nv");
  serve::PrivateFolder folder;
  Courses courses;
  int first_failure = kExitWell;
  for (int run = 1; run <= times; ++run) {
    ExecArguments once = arguments;
    once.serve.record = arguments.serve.record.empty() ? folder.path() + "/run" : arguments.serve.record;
    if (run > 1) once.serve.record += "." + std::to_string(run);
    const int code = execute_once(models, once);
    if (code == kExitNotStarted || code == kExitNoHostTime) return code;
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

}  // namespace

int execute(ModelList models, const ExecArguments& arguments) {
  if (!arguments.stray_words.empty() || arguments.command.empty()) {
    throw UsageError("exec: expected -- and a command after it, such as `exec bench.yaml -- ./my_host`");
  }
  timeout_of(arguments);
  if (arguments.repeat && *arguments.repeat < 1)
    throw UsageError("--repeat: " + std::to_string(*arguments.repeat) +
                     " is too few; expected 1 or more runs");
  if (arguments.repeat) return execute_repeatedly(models, arguments, *arguments.repeat);
  return execute_once(models, arguments);
}

int print_tty_shim() {
  std::printf("%s\n", serve::library_path(serve::kTtyShimLibrary).c_str());
  return kExitWell;
}

}  // namespace understudy::emulator::command_line
