#include "emulator/command_line/run_settings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "base/files/text_file.h"
#include "base/state/state_bytes.h"
#include "base/text/one_line.h"
#include "emulator/command_line/commands.h"
#include "emulator/command_line/coverage_file.h"
#include "emulator/command_line/host_case.h"
#include "emulator/command_line/on_box.h"
#include "emulator/command_line/result_file.h"
#include "emulator/play/performing/case_list.h"
#include "emulator/serve/host_time/host_program.h"

namespace understudy::emulator::command_line {

namespace {

// In real time, scenarios mostly wait, so more of them run at a time.
constexpr int kRealTimeJobs = 8;

/// Returns all that decides what a real controller is asked, and what it may do.
std::string words_of_box(const OnArguments& on) {
  std::string words;
  for (const std::string& line : on.on) words += " --on " + line;
  const std::array<std::pair<bool, const char*>, 5> allowed{{{on.allow_writes, " --allow-writes"},
                                                             {on.allow_memory, " --allow-memory"},
                                                             {on.allow_outputs, " --allow-outputs"},
                                                             {on.allow_motion, " --allow-motion"},
                                                             {on.ask, " --ask"}}};
  for (const auto& [is_given, flag] : allowed) words += is_given ? flag : "";
  // A file that cannot be read is reported when it is needed.
  if (const auto limits = read_text_file(on.envelope); limits) words += " --envelope " + *limits;
  return words + " --rig " + on.rig + " --timeout " + on.timeout;
}

}  // namespace

play::Shard shard_of(const RunArguments& arguments) {
  if (arguments.shard.empty()) return {};
  const auto parsed = play::parse_shard(arguments.shard);
  if (!parsed) {
    throw UsageError("--shard: " + understudy::quoted(arguments.shard) +
                     " is not a shard; expected I/N such as 1/4, with I up to N");
  }
  return *parsed;
}

int jobs_of(const RunArguments& arguments) {
  if (!arguments.on.on.empty()) return 1;  // there is only one machine
  if (!arguments.jobs) {
    const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    return arguments.real_time ? std::max(cores, kRealTimeJobs) : cores;
  }
  if (*arguments.jobs < 1) {
    throw UsageError("--jobs: " + std::to_string(*arguments.jobs) + " is too few; expected 1 or more");
  }
  return *arguments.jobs;
}

void require_flags_that_agree(const RunArguments& arguments) {
  if (arguments.hash && arguments.real_time) {
    throw UsageError("--hash: no two runs in real time are the same; expected it without --real-time");
  }
  if (arguments.resume && arguments.results.empty()) {
    throw UsageError("--resume: needs the list of the cases that have run; expected --results FILE");
  }
  const bool is_covered = coverage_of(arguments).is_wanted() || !arguments.device_coverage.empty();
  if (arguments.resume && is_covered) {
    throw UsageError(
        "--resume: leaves out cases, whose coverage would be missing; expected it without --coverage and "
        "--device-coverage");
  }
}

std::string maker_of(const RunArguments& arguments) {
  std::string maker = arguments.version;
  for (const std::string& word : arguments.host.command) {
    maker += ' ' + word;
    const bool is_program = &word == &arguments.host.command.front();
    const auto text = read_text_file(is_program ? serve::program_file(word) : word);
    if (text) maker += ' ' + std::to_string(hash_of(std::as_bytes(std::span(*text))));
  }
  if (arguments.host.host_time) maker += " --host-time";
  if (arguments.real_time) maker += " --real-time";
  if (is_on_box(arguments)) maker += words_of_box(arguments.on);
  return maker;
}

std::uint64_t made_of(const play::CaseList& case_list, std::size_t file, const std::string& maker) {
  return hash_of(std::as_bytes(std::span(maker)), case_list.made_of(file));
}

}  // namespace understudy::emulator::command_line
