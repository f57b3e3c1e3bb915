// The result of a scenario as a value, for terminal output, JUnit, or a report.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/play/scenario/case.h"

namespace understudy::emulator::play {

struct RunLog;  // emulator/play/report/run_log.h

struct StepResult {
  std::string file{};
  int line = 0;
  std::string text{};
  SimTime begin{0};  // simulated time
  SimTime end{0};
  bool has_failed = false;
  std::string skipped{};  // why the step was not executed; empty if it was
};

/// All texts are single lines.
struct Failure {
  SimTime at{0};                       // for a span, the tick in which it was violated
  std::string what{};                  // "feeder.Cord_A is 31999; expected 32000"
  std::string expected{};              // "feeder.Cord_A = 32000"
  std::string came{};                  // "feeder.Cord_A = 31999"
  std::vector<std::string> details{};  // expressions with their values, and other differences
  std::vector<std::string> led_to{};   // the events that led to it (world::Story)
  std::vector<std::string> frames{};   // the last frames on all lines, decoded
  std::vector<std::string> state{};    // the state of the devices and machines
};

/// The result of a scenario, or of one of its branches.
struct ScenarioResult {
  enum class Verdict : std::uint8_t {
    passed,
    failed,
    not_reached,   // a branch that was not reached, because a step before its fork failed
    not_tellable,  // with a real controller: none of the steps that check something could be executed
  } verdict = Verdict::passed;
  std::string name{};  // "a move takes its time"; for a branch, "a move takes its time / with a stall"
  std::string file{};
  std::vector<StepResult> steps{};          // ends with the failed step; a branch contains only its own steps
  std::optional<Failure> failure{};         // set if it failed
  SimTime simulated{0};                     // how long it ran; for a branch, since its fork
  std::uint64_t outcome_hash = 0;           // the hash of all output, if requested (outcome_hash.h)
  std::shared_ptr<const RunLog> run_log{};  // for a report, if requested
  std::vector<std::string> lint_findings{};  // if requested; single lines
  std::string recording{};                   // the path, if there is one; the same for a trace and a capture
  std::string trace{};
  std::string capture{};
  Case which{};  // the case within the file
  std::uint64_t seed = 0;
  /// "with a stall"; for a nested branch, "with a stall / again"; empty for the scenario itself.
  std::string branch{};
  bool is_unreadable = false;  // the case could not be read and did not run; the failure contains the reason
  std::string rerun{};  // the words after `understudy` that run only this case; empty: run FILE --filter ID
  std::string like{};   // the earlier case that failed in the same way, whose recording was kept
};

}  // namespace understudy::emulator::play
