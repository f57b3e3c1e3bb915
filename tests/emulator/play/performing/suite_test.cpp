// The number of threads that run cases makes no difference.
#include "emulator/play/performing/suite.h"

#include <atomic>
#include <mutex>

#include "emulator/play/results/junit.h"
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace suite_test {

/// Moves of different lengths, every third of which fails, and one with branches.
std::vector<Scenario> many() {
  std::vector<Scenario> scenarios;
  for (int i = 0; i < 24; ++i) {
    const std::string pulses = std::to_string(200 * (24 - i));
    scenarios.push_back(scenario_of(kServoOn + "  - write: { feeder.Aaxis_Pulse: " + pulses +
                                    ", feeder.Aaxis_Speed: 200, feeder.Aaxis_AccTime: 5, "
                                    "feeder.Aaxis_DecTime: 5, feeder.Aaxis_Move_INC: 1 }\n"
                                    "  - wait: { until: feeder.STATUS.4 == 0, within: 4s }\n"
                                    "  - fork: { on: [ advance: 1s ] }\n"
                                    "  - expect: { feeder.Cord_A: " +
                                    (i % 3 == 0 ? "1" : pulses) + " }\n"));
    scenarios.back().name = "move " + std::to_string(i);
  }
  return scenarios;
}

NextCase each_of(const std::vector<Scenario>& scenarios) {
  return [&, next = std::uint64_t{0}]() mutable -> std::optional<CaseId> {
    if (next >= scenarios.size()) return std::nullopt;
    return CaseId{.file = 0, .number = next++};
  };
}

std::function<Play()> players(const std::vector<Scenario>& scenarios, const RunOptions& options) {
  return [&]() -> Play {
    return [&](const CaseId& which_case) { return run_scenario(scenarios[which_case.number], options); };
  };
}

std::string reported(const std::vector<Scenario>& scenarios, int jobs) {
  std::vector<ScenarioResult> all;
  std::string text;
  const RunOptions options{.with_hash = true};
  std::uint64_t number = 0;
  run_suite(each_of(scenarios), players(scenarios, options), jobs,
            [&](const CaseId& which_case, const std::vector<ScenarioResult>& results) {
              EXPECT_EQ(which_case.number, number++);
              for (const ScenarioResult& result : results) {
                text += verdict_line(result) + " " + std::to_string(result.outcome_hash) + "\n" + why(result);
                all.push_back(result);
              }
            });
  return text + junit_text(all) + summary_line(all);
}

TEST(Suite, OneJobAndEightTellTheSameInTheSameOrder) {
  const auto scenarios = many();
  const std::string of_one = reported(scenarios, 1);
  EXPECT_NE(of_one.find("40 passed, 8 failed; "), std::string::npos) << of_one;
  EXPECT_LT(of_one.find("move 0"), of_one.find("move 1"));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(reported(scenarios, 8), of_one);
}

TEST(Suite, WithoutScenariosNothingIsReported) {
  EXPECT_EQ(reported({}, 8), junit_text({}) + "0 passed, 0 failed; 0s simulated");
}

TEST(Suite, AMissingExecutorIsThrownAfterWhatCameBefore) {
  const auto scenarios = many();
  std::atomic<int> made = 0;
  const RunOptions options{.make_executor = [&](const Scenario& scenario) -> std::unique_ptr<Executor> {
    ++made;
    if (scenario.name == "move 5") throw std::runtime_error("no port is free");
    return make_free_executor(scenario);
  }};
  std::vector<std::string> names;
  const auto tell = [&](const CaseId&, const std::vector<ScenarioResult>& results) {
    names.push_back(results.front().name);
  };
  try {
    run_suite(each_of(scenarios), players(scenarios, options), 4, tell);
    ADD_FAILURE() << "expected it to throw";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no port is free");
  }
  EXPECT_EQ(names, (std::vector<std::string>{"move 0", "move 1", "move 2", "move 3", "move 4"}));
  EXPECT_LT(made, 48);  // the rest does not run
}

TEST(Suite, ThreadsAreNeverFarAheadOfWhatIsReported) {
  std::uint64_t taken = 0;
  std::uint64_t reported = 0;
  std::uint64_t farthest = 0;
  std::mutex mutex;
  const auto next = [&]() -> std::optional<CaseId> {
    const std::lock_guard lock(mutex);
    if (taken == 20'000) return std::nullopt;
    farthest = std::max(farthest, taken - reported);
    return CaseId{.file = 0, .number = taken++};
  };
  const auto make_play = []() -> Play {
    return [](const CaseId& which_case) {
      std::vector<ScenarioResult> results(1);
      results.front().name = std::to_string(which_case.number);
      return results;
    };
  };
  run_suite(next, make_play, 3, [&](const CaseId& which_case, const std::vector<ScenarioResult>& results) {
    const std::lock_guard lock(mutex);
    EXPECT_EQ(results.front().name, std::to_string(which_case.number));
    EXPECT_EQ(which_case.number, reported++);
  });
  EXPECT_EQ(reported, 20'000U);
  EXPECT_LE(farthest, 300U);
}

TEST(Suite, WhatNextThrowsComesOutInItsTurn) {
  std::uint64_t taken = 0;
  const auto next = [&]() -> std::optional<CaseId> {
    if (taken == 7) throw std::runtime_error("the file is gone");
    return CaseId{.file = 0, .number = taken++};
  };
  const auto make_play = []() -> Play {
    return [](const CaseId&) { return std::vector<ScenarioResult>(1); };
  };
  std::uint64_t reported = 0;
  try {
    run_suite(next, make_play, 3, [&](const CaseId&, const std::vector<ScenarioResult>&) { ++reported; });
    ADD_FAILURE() << "expected it to throw";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the file is gone");
  }
  EXPECT_EQ(reported, 7U);
}

}  // namespace suite_test
}  // namespace understudy::emulator::play
