#include "emulator/command_line/on_box.h"

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/box/photograph/photograph.h"
#include "emulator/box/stage/box_executor.h"
#include "emulator/box/stage/permission.h"
#include "emulator/box/stage/rig.h"
#include "emulator/box/wire/port_name.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/interruption.h"
#include "emulator/device/register_map/hazards.h"
#include "emulator/play/executors/executor.h"
#include "emulator/play/executors/real_executor.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

namespace {

std::map<std::string, box::PortName> ports_of(const OnArguments& arguments) {
  std::map<std::string, box::PortName> ports;
  for (const std::string& text : arguments.on) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--on: " + quoted(text) +
                       " does not name a line; expected LINE=PORT such as rs485=/dev/ttyUSB0,19200");
    try {
      if (!ports.emplace(text.substr(0, equals), box::parse_port_name(text.substr(equals + 1))).second)
        throw UsageError("--on: " + quoted(text.substr(0, equals)) +
                         " is given twice; expected each line only once");
    } catch (const box::PortNameError& error) {
      throw UsageError("--on: " + std::string(error.what()));
    }
  }
  return ports;
}

SimTime timeout_of(const OnArguments& arguments) {
  const auto timeout = parse_duration(arguments.timeout);
  if (timeout && *timeout >= std::chrono::milliseconds(1) && *timeout <= std::chrono::minutes(1))
    return *timeout;
  throw UsageError("--reply-timeout: " + quoted(arguments.timeout) +
                   " is not a duration; expected one such as 300ms");
}

Hazards allowed_by(const OnArguments& arguments) {
  if (arguments.allow_motion) return Hazards::all;
  Hazards allowed = Hazards::reads;
  if (arguments.allow_writes) allowed = allowed | Hazards::settings;
  if (arguments.allow_memory) allowed = allowed | Hazards::settings | Hazards::memory;
  if (arguments.allow_outputs) allowed = allowed | Hazards::settings | Hazards::output;
  return allowed;
}

box::StageSettings settings_of(const OnArguments& arguments) {
  box::StageSettings settings{.allowed = allowed_by(arguments),
                              .rig = arguments.rig,
                              .asks = arguments.ask,
                              .only_plans = arguments.plan,
                              .is_interrupted = is_interrupted};
  if (!arguments.envelope.empty()) settings.envelope = box::read_envelope(arguments.envelope);
  std::FILE* const to = arguments.plan ? stdout : stderr;
  settings.say = [to](const std::string& line) {
    std::fprintf(to, "%s\n", one_line(line).c_str());
    std::fflush(to);
  };
  return settings;
}

}  // namespace

bool is_on_box(const RunArguments& arguments) { return !arguments.on.on.empty(); }

void require_flags_of_boxes(const RunArguments& arguments) {
  const OnArguments& on = arguments.on;
  const bool has_stage_flags = on.allow_writes || on.allow_memory || on.allow_outputs || on.allow_motion ||
                               on.ask || on.plan || !on.envelope.empty() || !on.rig.empty();
  if (!is_on_box(arguments)) {
    if (has_stage_flags || arguments.dialogue)
      throw UsageError(
          "run: --allow-..., --envelope, --rig, --ask, --plan and --dialogue need a real controller; "
          "expected --on LINE=PORT");
    return;
  }
  if (arguments.dialogue && (arguments.scenarios.size() != 1 || arguments.on.ask))
    throw UsageError("--dialogue: reads standard input; expected one scenario, and no --ask");
  const std::pair<bool, const char*> others[] = {{arguments.real_time, "--real-time"},
                                                 {arguments.hash, "--hash"},
                                                 {arguments.lint, "--lint"},
                                                 {!arguments.record.empty(), "--record"},
                                                 {!arguments.trace.empty(), "--trace"},
                                                 {!arguments.capture.empty(), "--capture"},
                                                 {!arguments.failures.empty(), "--failures"},
                                                 {!arguments.coverage.empty(), "--coverage"},
                                                 {!arguments.device_coverage.empty(), "--device-coverage"},
                                                 {!arguments.host.command.empty(), "a command"}};
  for (const auto& [is_given, flag] : others) {
    if (is_given)
      throw UsageError(std::string(flag) +
                       ": needs the internal state of a simulated controller; expected it without --on");
  }
}

void require_lines_of_benches(const OnArguments& arguments, const std::set<std::string>& lines) {
  std::string names;
  for (const std::string& line : lines) names += (names.empty() ? "" : ", ") + line;
  for (const auto& [name, port] : ports_of(arguments)) {
    if (!lines.contains(name))
      throw UsageError("--on: no bench has a line called " + quoted(name) + "; expected one of " + names);
  }
}

OnBox::OnBox(const OnArguments& arguments)
    : settings_(settings_of(arguments)), lines_(ports_of(arguments), timeout_of(arguments)) {
  of_rehearsals_ = settings_;
  of_rehearsals_.rehearses = true;
  of_rehearsals_.only_plans = false;
  of_rehearsals_.say = {};
  settings_.on_rig_failure = [this] { has_rig_failed_ = true; };
  if (!arguments.plan) watch_for_interruption_of_machine();
}

void OnBox::have_bare_controller(const std::string& name) {
  settings_.is_bare = !settings_.only_plans;
  of_rehearsals_.is_bare = true;
  settings_.rig_name = of_rehearsals_.rig_name = name;
}

std::unique_ptr<play::Executor> OnBox::make(const play::Scenario& scenario) {
  try {
    return std::make_unique<box::BoxExecutor>(scenario, lines_, settings_);
  } catch (const box::BoxError& error) {
    throw box::WireError(error.what());
  }
}

bool OnBox::revive(const std::string& device) {
  if (!has_rig()) return false;
  const auto check = [] {
    if (is_interrupted()) throw play::ExecutionAborted();
  };
  box::run_command(settings_.rig, {"factory", device}, check);
  box::run_command(settings_.rig, {"power", device, "cycle"}, check);
  constexpr int kTries = 10;  // it may take seconds to start
  for (int i = 0; i < kTries; ++i)
    if (lines_.are_answering()) return true;
  return false;
}

std::unique_ptr<play::Executor> OnBox::rehearse(const play::Scenario& scenario) {
  return std::make_unique<box::BoxExecutor>(scenario, lines_, of_rehearsals_);
}

}  // namespace understudy::emulator::command_line
