// Formats results for people.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/results/result.h"

namespace understudy::emulator::play {

/// Returns exact seconds: "3.061338541".
std::string seconds_text(SimTime time);

/// Returns "ok    feed.yaml: a move takes its time (3.06s)".
std::string verdict_line(const ScenarioResult& result);
/// Returns a line for each step: when it began and ended, its position in the file, and its text.
std::vector<std::string> step_lines(const ScenarioResult& result);
/// Returns a line for each reason why steps were skipped, with the first step that was skipped for that
/// reason.
std::vector<std::string> skipped_lines(const ScenarioResult& result);
/// Returns the failed step, the expectation, the observation, the last frames, and the state at the failure.
/// Empty if nothing failed.
std::vector<std::string> failure_lines(const ScenarioResult& result);

/// Counts the results of each kind, without keeping the results.
struct Tally {
  std::uint64_t passed = 0;
  std::uint64_t failed = 0;
  std::uint64_t not_reached = 0;
  std::uint64_t not_tellable = 0;
  std::uint64_t unreadable = 0;  // unreadable cases, which are also counted as failed
  SimTime simulated{0};

  void add(const ScenarioResult& result);
};

/// Returns "12 passed, 1 failed, 2 not reached; 48.3s simulated".
std::string summary_line(const Tally& tally);
std::string summary_line(std::span<const ScenarioResult> results);

}  // namespace understudy::emulator::play
