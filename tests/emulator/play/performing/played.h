// Runs scenarios that tests give as texts.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/models/models.h"
#include "emulator/play/executors/free_executor.h"
#include "emulator/play/performing/run.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/play/results/result_text.h"

namespace understudy::emulator::play {

/// Returns a scenario with one Simple2-R3 at 19200 baud and the steps, one per line.
inline std::string scenario_text(const std::string& steps, const std::string& more = "") {
  return "understudy: 1\n"
         "name: test\n"
         "bench: { lines: { rs485: { baud: 19200, stations: "
         "[ { name: feeder, model: simple2-r3, address: 1 } ] } } }\n" +
         more + "steps:\n" + steps;
}

inline Scenario scenario_of(const std::string& steps, const std::string& more = "") {
  return parse_scenarios(models::all_models(), scenario_text(steps, more), "test.yaml").front();
}

/// Returns the result of a scenario without branches.
inline ScenarioResult played(const std::string& steps, const std::string& more = "",
                             const RunOptions& options = {}) {
  const Scenario scenario = scenario_of(steps, more);
  return run_scenario(scenario, options).front();
}

inline std::string why(const ScenarioResult& result) {
  std::string text;
  for (const std::string& line : failure_lines(result)) text += line + "\n";
  return text;
}

inline bool has_passed(const ScenarioResult& result) {
  return result.verdict == ScenarioResult::Verdict::passed && !result.failure;
}

/// Runs the steps, and expects them to pass.
inline ScenarioResult passing(const std::string& steps, const std::string& more = "") {
  ScenarioResult result = played(steps, more);
  EXPECT_TRUE(has_passed(result)) << steps << why(result);
  return result;
}

/// Runs the steps, and expects them to fail at the last step that ran.
inline Failure failing(const std::string& steps, const std::string& more = "") {
  const ScenarioResult result = played(steps, more);
  EXPECT_EQ(result.verdict, ScenarioResult::Verdict::failed) << steps;
  if (!result.failure || result.steps.empty()) {
    ADD_FAILURE() << "did not fail: " << steps;
    return {};
  }
  EXPECT_TRUE(result.steps.back().has_failed);
  return *result.failure;
}

// The manual's example: 32000 pulses at 200 RPM (10,666.67 pulses per second), ramps of 50 ms, 3050 ms in
// total.
inline const std::string kServoOn = "  - write: { feeder.Aaxis_SVON: 1 }\n";
inline const std::string kExampleMove =
    "  - write: { feeder.Aaxis_Pulse: 32000, feeder.Aaxis_Speed: 200, feeder.Aaxis_AccTime: 5, "
    "feeder.Aaxis_DecTime: 5, feeder.Aaxis_Move_INC: 1 }\n";
// Both of these writes begin with an idle line. The first request is executed at 5.333 ms, and its reply ends
// at 9,916,666 ns. The second request starts 2,005,209 ns later, has 21 characters (12,031,250 ns) and is
// executed 750 us after its end, at 24,703,125 ns, so the move starts with tick 25. Its reply ends at
// 29,286,458 ns.
inline constexpr Tick kExampleBegins = 25;

}  // namespace understudy::emulator::play
