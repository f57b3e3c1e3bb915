#include "emulator/play/results/result_text.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "emulator/play/results/result.h"
#include "emulator/play/scenario/case.h"

namespace understudy::emulator::play {

namespace {

using Verdict = ScenarioResult::Verdict;

std::string place_of(const StepResult& step) { return step.file + ":" + std::to_string(step.line); }

std::string skipped_text(const ScenarioResult& result) {
  const auto count =
      std::ranges::count_if(result.steps, [](const StepResult& step) { return !step.skipped.empty(); });
  if (count == 0) return {};
  return ", " + std::to_string(count) + (count == 1 ? " step" : " steps") + " skipped";
}

}  // namespace

std::string seconds_text(SimTime time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return std::to_string(time.count() / kSecond) + "." +
         std::to_string(time.count() % kSecond + kSecond).substr(1);
}

std::string verdict_line(const ScenarioResult& result) {
  const std::string name = result.file + ": " + result.name;
  switch (result.verdict) {
    case Verdict::passed:
      return one_line("ok    " + name + " (" + format_duration(result.simulated) + skipped_text(result) +
                      ")");
    case Verdict::failed: {
      const SimTime at = result.failure ? result.failure->at : SimTime{0};
      return one_line("FAIL  " + name + " (at " + format_duration(at) + ")");
    }
    case Verdict::not_reached: return one_line("-     " + name + " (not reached)");
    case Verdict::not_tellable: return one_line("-     " + name + " (not tellable)");
  }
  return {};
}

std::vector<std::string> step_lines(const ScenarioResult& result) {
  std::vector<std::string> lines;
  for (const StepResult& step : result.steps) {
    lines.push_back(one_line(format_duration(step.begin) + " to " + format_duration(step.end) + "  " +
                             place_of(step) + "  " + step.text + (step.has_failed ? "  FAILED" : "") +
                             (step.skipped.empty() ? "" : "  SKIPPED: " + step.skipped)));
  }
  return lines;
}

std::vector<std::string> skipped_lines(const ScenarioResult& result) {
  std::vector<std::string> lines;
  std::string last;
  for (const StepResult& step : result.steps) {
    if (step.skipped.empty() || step.skipped == last) continue;
    last = step.skipped;
    lines.push_back(one_line("skipped: " + place_of(step) + ": " + step.text + ": " + step.skipped));
  }
  return lines;
}

std::vector<std::string> failure_lines(const ScenarioResult& result) {
  if (!result.failure) return {};
  const Failure& failure = *result.failure;
  std::vector<std::string> lines;
  const auto add = [&](const std::string& text) { lines.push_back(one_line(text)); };
  if (!result.steps.empty()) add(place_of(result.steps.back()) + ": " + result.steps.back().text);
  add("  " + failure.what);
  if (!failure.expected.empty()) add("  expected: " + failure.expected);
  if (!failure.came.empty()) add("  got:      " + failure.came);
  for (const std::string& detail : failure.details) add("  also:     " + detail);
  if (!failure.led_to.empty()) add("  what led to it:");
  for (const std::string& moment : failure.led_to) add("    " + moment);
  if (!failure.frames.empty()) add("  the last frames:");
  for (const std::string& frame : failure.frames) add("    " + frame);
  if (!failure.state.empty()) add("  the state at " + format_duration(failure.at) + ":");
  for (const std::string& state : failure.state) add("    " + state);
  if (!result.recording.empty()) {
    add("to run this again: understudy replay " + result.recording);
    add("to see it in a browser: understudy replay " + result.recording + " --page");
  }
  if (!result.like.empty())
    add("it failed in the same way as this case, whose recording is kept: " + result.like);
  if (!result.rerun.empty()) {
    add("to run this case alone: understudy " + result.rerun);
  } else if (result.which.is_varied) {
    add("to run this case alone: understudy run " + result.file + " --filter " +
        identity_text(identity_of(result.which)));
  }
  return lines;
}

void Tally::add(const ScenarioResult& result) {
  switch (result.verdict) {
    case Verdict::passed: ++passed; break;
    case Verdict::failed: ++failed; break;
    case Verdict::not_reached: ++not_reached; break;
    case Verdict::not_tellable: ++not_tellable; break;
  }
  if (result.is_unreadable) ++unreadable;
  simulated += result.simulated;
}

std::string summary_line(const Tally& tally) {
  std::string text = std::to_string(tally.passed) + " passed, " + std::to_string(tally.failed) + " failed";
  if (tally.not_reached != 0) text += ", " + std::to_string(tally.not_reached) + " not reached";
  if (tally.not_tellable != 0) text += ", " + std::to_string(tally.not_tellable) + " not tellable";
  if (tally.unreadable != 0) text += ", " + std::to_string(tally.unreadable) + " of them could not be read";
  return text + "; " + format_duration(tally.simulated) + " simulated";
}

std::string summary_line(std::span<const ScenarioResult> results) {
  Tally tally;
  for (const ScenarioResult& result : results) tally.add(result);
  return summary_line(tally);
}

}  // namespace understudy::emulator::play
