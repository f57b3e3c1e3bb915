#include "emulator/command_line/host_case.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "base/files/descriptor.h"
#include "base/files/file_error.h"
#include "base/text/one_line.h"
#include "emulator/command_line/host_course.h"
#include "emulator/command_line/log.h"
#include "emulator/play/performing/side_scenario.h"
#include "emulator/serve/control/control_door.h"
#include "emulator/serve/host_time/host_library.h"
#include "emulator/serve/host_time/host_program.h"
#include "emulator/serve/loop/child.h"
#include "emulator/serve/loop/parent_signals.h"
#include "emulator/serve/ports/private_folder.h"
#include "emulator/serve/ports/tty_shim.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::command_line {

namespace {

constexpr serve::WallTime kUsualTimeout = std::chrono::seconds(60);
constexpr std::size_t kReportedLines = 5;     // of the command's output, from its end
constexpr std::size_t kReportedBytes = 2000;  // the most bytes in these lines

bool is_command_end(const play::Step& step) {
  return std::holds_alternative<play::CommandEndStep>(step.what);
}

/// Creates a file for output, and unlinks it immediately.
Descriptor make_output(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0600));
  if (!file) throw std::system_error(errno, std::generic_category(), path);
  ::unlink(path.c_str());
  return file;
}

/// Returns the last lines of a file.
std::vector<std::string> last_lines(int file) {
  std::array<char, kReportedBytes> bytes{};
  const off_t size = ::lseek(file, 0, SEEK_END);
  const auto from = std::max<off_t>(0, size - static_cast<off_t>(bytes.size()));
  const ssize_t got = ::pread(file, bytes.data(), bytes.size(), from);
  std::vector<std::string> lines;
  std::string line;
  for (ssize_t i = 0; i < got; ++i) {
    const char c = bytes[static_cast<std::size_t>(i)];
    if (c != '\n') {
      line += c;
      continue;
    }
    lines.push_back(std::exchange(line, {}));
  }
  if (!line.empty()) lines.push_back(line);
  if (lines.size() > kReportedLines)
    lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(kReportedLines));
  return lines;
}

/// Returns a setup with links in the folder and memories that are never written. In real time, cases that run
/// side by side cannot listen at the same addresses, so they do not listen at all.
Serving serving_of(const play::Scenario& scenario, const RunArguments& arguments, const std::string& folder,
                   const std::string& recording) {
  Serving serving;
  serving.bench = scenario.bench;
  for (world::LineSetup& line : serving.bench.lines) {
    if (!arguments.host.host_time) {
      line.tcp.clear();
      line.has_pty = true;
    }
    if (line.has_pty) line.link = folder + "/" + line.name + ".port";
  }
  for (world::DeviceSetup& device : serving.bench.devices) device.nv_path.clear();
  serving.options.watch_signals = false;
  serving.options.door = serve::control_door(folder + "/control");
  serving.options.record_path = recording;
  serving.options.version = arguments.version;
  serving.options.is_host_simulated = arguments.host.host_time;
  if (arguments.host.host_time) serving.options.speed.kind = serve::Speed::Kind::manual;
  return serving;
}

/// Returns a word, quoted for a shell if necessary.
std::string shell_word(const std::string& word) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_./=:,@%+-").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Returns the command line that runs only this case, with all flags that affect it.
std::string rerun_of(const play::Scenario& scenario, const RunArguments& arguments) {
  const HostArguments& host = arguments.host;
  std::string text = "exec " + shell_word(scenario.file);
  if (host.host_time) text += " --host-time";
  if (host.tty_shim) text += " --tty-shim";
  if (!arguments.timeout.empty()) text += " --timeout " + shell_word(arguments.timeout);
  if (arguments.seed) text += " --seed " + std::to_string(*arguments.seed);
  if (scenario.which.is_varied) text += " --filter " + play::identity_text(play::identity_of(scenario.which));
  return text + " -- " + shell_text(host.command);
}

/// Returns the reason why the case has failed, apart from its steps, or an empty text.
std::string why_failed(const CourseEnd& end, const play::Scenario& scenario, const std::string& timeout) {
  if (!end.was_reached) {
    return "the command did not load our library, so it ran in real time; expected a program that keeps "
           "LD_PRELOAD";
  }
  if (end.has_timed_out)
    return "the command was stopped because it took longer than " + (timeout.empty() ? "60s" : timeout);
  if (end.was_given_up) return "the scenario did not run to its end, because the run was stopped";
  if (end.exit_code == 0 || std::ranges::any_of(scenario.steps, is_command_end)) return {};
  return "the command ended with exit code " + std::to_string(end.exit_code) + "; expected 0";
}

}  // namespace

void require_steps_for(const play::Scenario& scenario, bool has_command, const std::string& verb) {
  if (has_command) return play::require_steps_beside_host(scenario);
  const auto step = std::ranges::find_if(scenario.steps, is_command_end);
  if (step == scenario.steps.end()) return;
  throw FileError(step->file + ":" + std::to_string(step->line) + ": " + step->text +
                  ": no command runs alongside this scenario; expected `understudy " + verb + " " +
                  scenario.file + " -- COMMAND`");
}

std::string shell_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + shell_word(word);
  return text;
}

std::optional<int> code_of_unusable(const HostArguments& host, const std::string& verb) {
  const std::string& program = host.command[0];
  if (program.find("${") != std::string::npos) return std::nullopt;
  if (!serve::can_be_started(program)) {
    std::fprintf(stderr, "understudy: %s: %s: cannot be started; expected a program\n", verb.c_str(),
                 one_line(program).c_str());
    return kExitNotStarted;
  }
  if (!host.host_time) return std::nullopt;
  serve::require_host_library(serve::library_path(serve::kHostTimeLibrary));
  const std::string why = serve::why_not_in_host_time(program);
  if (why.empty()) return std::nullopt;
  std::fprintf(stderr, "understudy: %s: --host-time: %s\n", verb.c_str(), why.c_str());
  return kExitNoHostTime;
}

std::vector<play::ScenarioResult> run_host_case(const play::Scenario& scenario, play::RunOptions options,
                                                const RunArguments& arguments, const std::string& recording) {
  serve::PrivateFolder folder;
  const Descriptor output = make_output(folder.path() + "/output");
  HostArguments host = arguments.host;
  host.command = scenario.command;
  host.environment = scenario.environment;
  serve::ParentSignals signals;
  CourseEnd end = run_course({.serving = serving_of(scenario, arguments, folder.path(), recording),
                              .host = std::move(host),
                              .folder = folder.path(),
                              .timeout = parse_timeout(arguments.timeout).value_or(kUsualTimeout),
                              .scenario = &scenario,
                              .run = std::move(options),
                              .output = output.get()},
                             {}, signals);
  if (end.results.empty()) {
    end.results.push_back(
        {.name = scenario.name, .file = scenario.file, .which = scenario.which, .seed = scenario.seed});
  }
  play::ScenarioResult& result = end.results.front();
  result.recording = recording;
  result.rerun = rerun_of(scenario, arguments);
  const std::string why = why_failed(end, scenario, arguments.timeout);
  if (!why.empty() && (!result.failure || end.has_timed_out)) {
    // A command that takes too long is a different kind of failure from a command that fails.
    result.verdict = play::ScenarioResult::Verdict::failed;
    if (!result.failure) result.failure = play::Failure{.at = result.simulated};
    result.failure->what = why;
    result.failure->expected.clear();
    result.failure->came.clear();
  }
  if (!result.failure) return std::move(end.results);
  for (const std::string& line : last_lines(output.get()))
    result.failure->details.push_back("the command printed: " + one_line(line));
  return std::move(end.results);
}

}  // namespace understudy::emulator::command_line
