// snapshot, restore and fork: every continuation begins from the same state.
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace runner_fork_test {

using Verdict = ScenarioResult::Verdict;

std::vector<ScenarioResult> all_of(const std::string& steps, bool with_hash = false) {
  return run_scenario(scenario_of(steps), {.with_hash = with_hash});
}

std::vector<std::string> verdicts(const std::vector<ScenarioResult>& results) {
  std::vector<std::string> lines;
  for (const ScenarioResult& result : results) {
    const char* const word = result.verdict == Verdict::passed   ? "passed "
                             : result.verdict == Verdict::failed ? "failed "
                                                                 : "not reached ";
    lines.push_back(word + result.name);
  }
  return lines;
}

TEST(RunnerSnapshots, RestoreGoesBackInTimeWithAllThatLooksOn) {
  const ScenarioResult result =
      passing(kServoOn + kExampleMove +
              "  - advance: 100ms\n"
              "  - inject: { slip: feeder.A, pulses: 5 }\n"
              "  - inject: { stuck: feeder.DIN_2, level: on, name: two }\n"
              "  - always: { what: feeder.A.pulses < 20000, name: early }\n"
              "  - snapshot: moving\n"
              "  - clear: two\n"
              "  - end: early\n"
              "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, takes: 3050ms }\n"
              "  - write: { feeder.Aaxis_Speed: 7 }\n"
              "  - restore: moving\n"
              "  - assert: [ time == 129286458ns, feeder.STATUS.4 == 1, feeder.Aaxis_Speed == 200 ]\n"
              "  - expect: { feeder.Aaxis_Speed: 200, feeder.DIN_2: 1 }\n"
              "  - clear: two\n"
              "  - end: early\n"
              // The last write is again the one before the snapshot.
              "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, takes: 3050ms }\n"
              "  - assert: [ feeder.A.pulses == 32000, feeder.A.position == 32005 ]\n");
  // 100 ms after the write's reply; and again after the restore.
  const SimTime there = SimTime{29'286'458} + std::chrono::milliseconds(100);
  EXPECT_EQ(result.steps[6].end, there);
  EXPECT_EQ(result.steps[11].end, there);
}

TEST(RunnerSnapshots, ASpanThatWasOpenIsWatchedAgain) {
  const Failure failure = failing(
      "  - never: { what: feeder.A.pulses > 266, name: far }\n"
      "  - snapshot: begin\n"
      "  - end: far\n" +
      kServoOn + kExampleMove +
      "  - advance: 200ms\n"
      "  - restore: begin\n" +
      kServoOn + kExampleMove + "  - advance: 200ms\n");
  EXPECT_EQ(failure.at, time_of(kExampleBegins + 51));
}

TEST(RunnerForks, EachBranchIsAResultAndTheMainLineContinuesToo) {
  const auto results = all_of(kServoOn + kExampleMove +
                              "  - advance: 100ms\n"
                              "  - fork:\n"
                              "      to its end:\n"
                              "        - wait: { until: feeder.STATUS.4 == 0, within: 4s, takes: 3050ms }\n"
                              "        - assert: feeder.A.pulses == 32000\n"
                              "      stopped:\n"
                              "        - write: { feeder.Aaxis_STOP: 1 }\n"
                              "        - wait: { until: feeder.STATUS.4 == 0, within: 1s }\n"
                              "        - assert: feeder.A.pulses == 32000\n"
                              "      with a stall:\n"
                              "        - inject: { stall: feeder.A }\n"
                              "        - fork:\n"
                              "            short: [ advance: 1s ]\n"
                              "            long: [ advance: 5s, assert: feeder.A.position < 2000 ]\n"
                              "  - assert: time == 129286458ns\n");
  EXPECT_EQ(verdicts(results),
            (std::vector<std::string>{"passed test", "passed test / to its end", "failed test / stopped",
                                      "passed test / with a stall", "passed test / with a stall / short",
                                      "passed test / with a stall / long"}));
  // A branch reports its own steps, at the world's time.
  EXPECT_EQ(results[1].steps.size(), 2U);
  EXPECT_EQ(results[1].steps[0].begin, SimTime{129'286'458});
  EXPECT_EQ(results[1].steps[0].end, time_of(kExampleBegins + 3050));
  EXPECT_EQ(results[1].simulated, time_of(kExampleBegins + 3050) - SimTime{129'286'458});
  EXPECT_EQ(results[4].simulated, std::chrono::seconds(1));
}

TEST(RunnerForks, OnlyAFailureBeforeTheForkSkipsItsBranches) {
  const std::string fork =
      "  - fork:\n"
      "      one: [ advance: 1ms ]\n"
      "      two: [ advance: 1ms, fork: { three: [ advance: 1ms ] } ]\n";
  const std::string wrong = "  - assert: feeder.STATUS == 1\n";
  EXPECT_EQ(verdicts(all_of(wrong + fork)),
            (std::vector<std::string>{"failed test", "not reached test / one", "not reached test / two",
                                      "not reached test / two / three"}));
  EXPECT_EQ(verdicts(all_of(fork + wrong)),
            (std::vector<std::string>{"failed test", "passed test / one", "passed test / two",
                                      "passed test / two / three"}));
}

TEST(RunnerForks, BranchesThatDoTheSameHaveTheSameOutcome) {
  const std::string course =
      "[ wait: { until: feeder.STATUS.4 == 0, within: 4s }, expect: { feeder.Cord_A: 32000 } ]\n";
  const auto results = all_of(kServoOn + kExampleMove +
                                  "  - advance: 100ms\n"
                                  "  - fork:\n"
                                  "      one: " +
                                  course + "      two: " + course +
                                  "      three: [ advance: 1s ]\n"
                                  "  - wait: { until: feeder.STATUS.4 == 0, within: 4s }\n"
                                  "  - expect: { feeder.Cord_A: 32000 }\n",
                              true);
  ASSERT_EQ(verdicts(results), (std::vector<std::string>{"passed test", "passed test / one",
                                                         "passed test / two", "passed test / three"}));
  EXPECT_EQ(results[1].outcome_hash, results[2].outcome_hash);
  EXPECT_EQ(results[0].outcome_hash, results[1].outcome_hash);  // the main line continued in the same way
  EXPECT_NE(results[0].outcome_hash, results[3].outcome_hash);
}

TEST(RunnerForks, TheHostIsSilentAsLongInABranchAsOnTheMainLine) {
  const std::string reads = "[ expect: { feeder.Aaxis_Speed: 200 }, expect: { feeder.STATUS.10: 1 } ]\n";
  const std::string read_here =
      "  - expect: { feeder.Aaxis_Speed: 200 }\n  - expect: { feeder.STATUS.10: 1 }\n";
  // Once right after a reply, once 1 ms after it, which is within t3.5.
  for (const std::string between : {"", "  - advance: 1ms\n"}) {
    const auto results = all_of(kServoOn + kExampleMove + between + "  - fork: { one: " + reads + "  }\n" +
                                    "  - snapshot: there\n" + read_here +
                                    // The line has been busy, and is idle now.
                                    "  - restore: there\n" + read_here,
                                true);
    ASSERT_EQ(verdicts(results), (std::vector<std::string>{"passed test", "passed test / one"}));
    const std::vector<StepResult>& main = results[0].steps;
    const std::vector<StepResult>& branch = results[1].steps;
    const std::size_t first = main.size() - 5;  // read twice, restore, read twice
    // t3.5 after the reply to the write, which was over at 29,286,458 ns, come 8 characters, 750 us and 7
    // ones: 2,005,209 + 4,583,333 + 750,000 + 4,010,416 or 4,010,417.
    EXPECT_NEAR(static_cast<double>(branch[0].end.count()), 29'286'458 + 11'348'958, 2);
    for (const std::size_t i : {0U, 1U}) {
      EXPECT_EQ(branch[i].end, main[first + i].end);
      EXPECT_EQ(branch[i].end, main[first + 3 + i].end);
    }
  }
}

TEST(RunnerForks, ASpanThatIsOpenIsWatchedInEachBranch) {
  // The names that are requested before the span differ from those that a branch requests first.
  const auto results =
      all_of(kServoOn +
             "  - wait: { until: feeder.STATUS.10 == 1 and feeder.Aaxis_Speed == 0, within: 1s }\n"
             "  - never: { what: feeder.A.lost > 100, name: lost }\n"
             "  - fork:\n"
             "      sound: [ wait: { until: time > 1s, within: 2s }, assert: feeder.A.lost == 0 ]\n"
             "      blocked:\n"
             "        - inject: { stall: feeder.A }\n"
             "      " +
             kExampleMove + "        - advance: 1s\n");
  ASSERT_EQ(verdicts(results),
            (std::vector<std::string>{"passed test", "passed test / sound", "failed test / blocked"}));
  EXPECT_NE(results[2].failure->what.find("never 'lost'"), std::string::npos) << results[2].failure->what;
}

TEST(RunnerForks, ASnapshotFromBeforeIsKnownInABranch) {
  const auto results =
      all_of("  - snapshot: begin\n" + kServoOn +
             "  - fork:\n"
             "      back: [ restore: begin, assert: time == 0, assert: feeder.STATUS.10 == 0 ]\n");
  EXPECT_EQ(verdicts(results), (std::vector<std::string>{"passed test", "passed test / back"}));
}

}  // namespace runner_fork_test
}  // namespace understudy::emulator::play
