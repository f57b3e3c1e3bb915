#include "emulator/command_line/host_course.h"

#include <signal.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/command_line/coverage_file.h"
#include "emulator/command_line/log.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/lint/lint.h"
#include "emulator/play/performing/side_scenario.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/host_time/host_time.h"
#include "emulator/serve/loop/child.h"
#include "emulator/serve/ports/port_group.h"
#include "emulator/serve/ports/tty_shim.h"
#include "emulator/world/bench/bench.h"

namespace understudy::emulator::command_line {

namespace {

/// Calls a function once after a given time.
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

serve::ChildCommand command_for(const HostArguments& host, const serve::Daemon& daemon, int output) {
  serve::ChildCommand command{.words = host.command, .environment = host.environment, .output = output};
  auto& environment = command.environment;
  for (const auto& port : daemon.ports()) {
    const std::string path = port->place();
    if (port == daemon.ports().front()) environment.emplace_back("UNDERSTUDY_PORT", path);
    environment.emplace_back(variable_of(daemon.world().line(port->line_number()).line.name()), path);
  }
  environment.emplace_back("UNDERSTUDY_CONTROL", daemon.control_path());
  if (host.tty_shim && !host.host_time)
    environment.emplace_back("LD_PRELOAD", serve::preload_with(serve::kTtyShimLibrary));
  return command;
}

/// Returns the log of the daemon. In a campaign, the recording of a case has what its ports went through.
std::function<void(const std::string&)> log_of(const CourseSetup& setup) {
  if (setup.output >= 0) return [](const std::string&) {};
  return log_line;
}

void share_ports(const serve::Daemon& daemon, gid_t group) {
  for (const auto& port : daemon.ports()) {
    if (port->terminal() != nullptr) serve::share_port(port->terminal()->path(), group);
  }
}

/// All members are used only on the daemon's thread.
class Course final : public play::HostCommand {
 public:
  Course(CourseSetup& setup, const ServeArguments& flags, serve::ParentSignals& signals)
      : setup_(setup),
        signals_(signals),
        daemon_(setup.serving.bench, setup.serving.options, log_of(setup)),
        coverage_(flags, daemon_) {
    if (setup.serving.group) share_ports(daemon_, *setup.serving.group);
    if (flags.lint) lint_.emplace(daemon_.world());
    start_command();
    if (setup.timeout) {
      alarm_.emplace(daemon_.loop(), *setup.timeout, [this] {
        end_.has_timed_out = true;
        end_command(SIGTERM);
        if (is_command_over_) give_up_scenario();
      });
    }
    if (setup.scenario == nullptr) return;
    setup.run.command = this;
    side_scenario_.emplace(
        *setup.scenario, daemon_, [this] { on_scenario_over(); }, host_time_ ? &*host_time_ : nullptr,
        setup.run);
  }

  CourseEnd run() {
    daemon_.run();
    signals_.unwatch(daemon_.loop());
    if (lint_) print_findings(lint_->findings());
    coverage_.write();
    end_.exit_code = child_->exit_code();
    end_.was_reached = !host_time_ || host_time_->was_reached();
    if (!side_scenario_) return std::move(end_);
    end_.was_given_up = side_scenario_->was_given_up();
    if (!end_.was_given_up) end_.results = side_scenario_->results();
    return std::move(end_);
  }

  // --- HostCommand
  std::optional<int> exit_code() const override {
    return is_command_over_ ? std::optional(child_->exit_code()) : std::nullopt;
  }
  void stop() override {
    end_.was_stopped = true;
    end_command(SIGTERM);
  }

 private:
  void start_command() {
    serve::ChildCommand command = command_for(setup_.host, daemon_, setup_.output);
    if (setup_.host.host_time) {
      host_time_.emplace(daemon_, setup_.folder + "/host", log_line);
      for (auto& variable : host_time_->environment()) command.environment.push_back(std::move(variable));
    }
    child_.emplace(daemon_.loop(), signals_, command, [this] { on_command_over(); });
    if (host_time_) host_time_->command_began(child_->process());
    signals_.watch(daemon_.loop(), [this](int signal_number) {
      if (signal_number == SIGCHLD) {
        if (host_time_) host_time_->look_at_command();
        return child_->look_after_children();
      }
      end_.was_interrupted = true;
      end_command(signal_number);
      if (is_command_over_) give_up_scenario();
    });
  }

  void end_command(int signal_number) {
    if (host_time_) host_time_->host_is_to_end();
    child_->end_with(signal_number);
  }

  void on_command_over() {
    is_command_over_ = true;
    const bool is_of_scenario = (setup_.output >= 0 || end_.was_stopped) && !end_.has_timed_out;
    // No client is left that could advance time. In host time, the scenario itself advances it.
    if ((child_->was_ended() && !is_of_scenario) || (daemon_.pacer().standing() && !host_time_))
      give_up_scenario();
    if (host_time_) host_time_->host_ended();
    stop_if_over();
  }

  void on_scenario_over() {
    is_scenario_over_ = true;
    const bool has_failed =
        side_scenario_ && !side_scenario_->was_given_up() &&
        side_scenario_->results().front().verdict == play::ScenarioResult::Verdict::failed;
    if (setup_.output >= 0 && has_failed) end_command(SIGTERM);
    stop_if_over();
  }

  void give_up_scenario() {
    if (side_scenario_) side_scenario_->give_up();
  }
  void stop_if_over() {
    if (is_command_over_ && (is_scenario_over_ || setup_.scenario == nullptr)) daemon_.stop();
  }

  CourseSetup& setup_;
  serve::ParentSignals& signals_;
  serve::Daemon daemon_;
  ServedCoverage coverage_;
  std::optional<play::Lint> lint_;
  std::optional<serve::HostTime> host_time_;
  std::optional<serve::Child> child_;
  std::optional<Alarm> alarm_;
  CourseEnd end_;
  bool is_command_over_ = false;
  bool is_scenario_over_ = false;
  std::optional<play::SideScenario> side_scenario_;
};

}  // namespace

std::optional<serve::WallTime> parse_timeout(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto timeout = parse_duration(text);
  if (!timeout || *timeout <= SimTime{0}) {
    throw UsageError("--timeout: " + understudy::quoted(text) +
                     " is not a duration; expected one such as 30s");
  }
  return timeout;
}

void require_variables(const world::Bench& bench) {
  for (std::size_t i = 0; i < bench.lines.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (variable_of(bench.lines[i].name) != variable_of(bench.lines[j].name)) continue;
      throw UsageError("exec: the lines " + understudy::quoted(bench.lines[j].name) + " and " +
                       understudy::quoted(bench.lines[i].name) + " would both have the variable " +
                       variable_of(bench.lines[i].name) +
                       "; expected names that differ in more than case and punctuation");
    }
  }
}

CourseEnd run_course(CourseSetup setup, const ServeArguments& flags, serve::ParentSignals& signals) {
  return Course(setup, flags, signals).run();
}

}  // namespace understudy::emulator::command_line
