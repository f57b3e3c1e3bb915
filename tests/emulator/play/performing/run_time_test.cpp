// wait, takes, polls, spans, peaks: times are exact, to the tick.
#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace runner_time_test {

const std::string kEnds = "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, takes: 3050ms +- 2ms }\n";

TEST(RunnerTimes, TheManualsExampleTakes3050Milliseconds) {
  const ScenarioResult result =
      passing(kServoOn + kExampleMove + kEnds + "  - expect: { feeder.Cord_A: 32000 }\n");
  ASSERT_EQ(result.steps.size(), 4U);
  EXPECT_EQ(result.steps[0].end, SimTime{9'916'666});
  EXPECT_EQ(result.steps[1].end, SimTime{29'286'458});
  EXPECT_EQ(result.steps[2].begin, SimTime{29'286'458});
  EXPECT_EQ(result.steps[2].end, time_of(kExampleBegins + 3050));
  // The line has long been quiet: 8 characters, 750 us, 9 characters (5,156,250).
  EXPECT_EQ(result.steps[3].end, time_of(3075) + SimTime{4'583'333 + 750'000 + 5'156'250});
  EXPECT_EQ(result.steps[2].text, "wait until feeder.STATUS.4 == 0 within 4s, takes 3050ms +- 2ms");
}

TEST(RunnerTimes, TakesIsExactToTheTick) {
  struct Case {
    const char* takes;
    bool holds;
  };
  const std::vector<Case> cases = {{"3050ms", true},        {"3049ms", false},   {"3051ms", false},
                                   {"3049ms +- 1ms", true}, {"..3050ms", true},  {"3051ms..", false},
                                   {"3s..3.1s", true},      {"3s +- 1%", false}, {"3s +- 2%", true}};
  for (const Case& c : cases) {
    const ScenarioResult result =
        played(kServoOn + kExampleMove + "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, takes: \"" +
               c.takes + "\" }\n");
    EXPECT_EQ(has_passed(result), c.holds) << c.takes << "\n" << why(result);
    if (!c.holds) {
      EXPECT_EQ(result.failure->what, std::string("took 3.05s; expected ") + c.takes);
      EXPECT_EQ(result.failure->at, time_of(3075));
    }
  }
}

TEST(RunnerTimes, TakesCountsFromTheLastWriteDespiteOtherWaits) {
  // s(t) = 8 t^2 / 75 up to t = 50 ms, then 32 (t - 25) / 3: the axis passes 10000 at t = 962.5, so at tick
  // 963.
  passing(kServoOn + kExampleMove +
          "  - wait: { until: feeder.A.pulses > 266, within: 1s, takes: 51ms }\n"
          "  - expect: { feeder.STATUS.4: 1 }\n"
          "  - wait: { until: feeder.A.pulses >= 10000, within: 2s, takes: 963ms }\n" +
          kEnds);
}

TEST(RunnerTimes, WhatComesTrueWhileTheReplyIsOnTheLineIsNotMissed) {
  // The reply to the write ends 4.3 ms after tick 25; at t = 4 ms one pulse has been sent (8 * 16 / 75
  // = 1.7).
  const ScenarioResult result = passing(
      kServoOn + kExampleMove + "  - wait: { until: feeder.A.pulses == 1, within: 1s, takes: 4ms }\n");
  EXPECT_EQ(result.steps.back().begin, result.steps.back().end);
  // 0 pulses up to t = 3 (0.96): the write's own tick counts as 0 ms.
  passing(kServoOn + kExampleMove + "  - wait: { until: feeder.A.pulses == 0, within: 1s, takes: 0ms }\n");
}

TEST(RunnerTimes, StepsThatPassNoTimeMayStandBetweenAWriteAndItsWait) {
  // As above: no pulse has been sent at tick 25, one has at tick 29, and the reply is on the line up
  // to 29.286 ms.
  const std::string wait = "  - wait: { until: feeder.A.pulses == 0, within: 1s, takes: 0ms }\n";
  for (const std::string between :
       {"say: on its way", "assert: feeder.STATUS.4 == 1", "input: { feeder.DIN_10: on }",
        "inject: { stall: feeder.B, name: b }", "never: feeder.A.pulses > 32000",
        "always: { what: feeder.power, name: fed }", "reset: peaks", "snapshot: moving",
        "fork: { one: [ say: one ] }", "power: { feeder: on }"}) {
    passing(kServoOn + kExampleMove + "  - " + between + "\n" + wait);
  }
  passing("  - inject: { stall: feeder.B, name: b }\n  - always: { what: feeder.power, name: fed }\n" +
          kServoOn + kExampleMove + "  - clear: b\n  - end: fed\n  - say: both are gone\n" + wait);
  // The wait starts after a step that passes time: at 31.286 ms tick 31 has ended, 6 ms after tick 25.
  passing(kServoOn + kExampleMove +
          "  - advance: 2ms\n  - wait: { until: feeder.A.pulses >= 1, within: 1s, takes: 6ms }\n");
}

TEST(RunnerTimes, WhatABranchWaitsForIsLookedForFromTheWriteAsWell) {
  const std::string wait = "wait: { until: feeder.A.pulses == 0, within: 1s, takes: 0ms }";
  const auto results =
      run_scenario(scenario_of(kServoOn + kExampleMove + "  - fork:\n      one: [ say: one, " + wait +
                               " ]\n      two: [ wait: { until: feeder.A.pulses < 1, within: 1s, "
                               "takes: 0ms } ]\n  - snapshot: there\n  - " +
                               wait + "\n  - restore: there\n  - " + wait + "\n"),
                   {});
  ASSERT_EQ(results.size(), 3U);
  for (const ScenarioResult& result : results) EXPECT_TRUE(has_passed(result)) << result.name << why(result);
}

TEST(RunnerTimes, NothingRunsBeyondTheEndOfTime) {
  // 100 years of 365 days are 876000 hours.
  const ScenarioResult result = passing("  - advance: 876000h\n");
  EXPECT_EQ(result.steps.back().end, kHorizon);
  const std::string beyond = " from now is beyond the end of simulated time; expected at most ";
  for (const auto& [steps, what] : std::vector<std::pair<std::string, std::string>>{
           {"  - advance: 876000h\n  - advance: 876000h\n  - advance: 876000h\n",
            "3153600000s" + beyond + "0s"},
           {"  - advance: 876000h\n  - advance: 1ns\n", "1ns" + beyond + "0s"},
           {"  - advance: 875999h\n  - wait: { until: feeder.STATUS == 1, within: 2h }\n",
            "7200s" + beyond + "3600s"},
           {"  - advance: 875999h\n  - wait: { until: feeder.STATUS == 1, within: 2h, poll: 1h }\n",
            "7200s" + beyond + "3600s"},
           {"  - advance: 876000h\n  - send: { line: rs485, bytes: 01, within: 1s }\n",
            "1s" + beyond + "0s"}}) {
    EXPECT_EQ(failing(steps).what, what) << steps;
  }
}

TEST(RunnerTimes, AWaitThatIsTrueAlreadyEndsAtOnce) {
  const ScenarioResult result =
      passing("  - advance: 10.4ms\n  - wait: { until: feeder.STATUS == 0, within: 1s }\n");
  EXPECT_EQ(result.steps[1].end, SimTime{10'400'000});
}

TEST(RunnerTimes, WithoutAWriteItTakesFromPowerUpOn) {
  passing("  - wait: { until: time >= 70ms, within: 1s, takes: 70ms }\n");
}

TEST(RunnerTimes, WhatDoesNotComeTrueFailsAtTheEndOfItsTime) {
  const Failure failure =
      failing(kServoOn + kExampleMove + "  - wait: { until: feeder.STATUS.4 == 0, within: 3s }\n");
  EXPECT_EQ(failure.what, "'feeder.STATUS.4 == 0' did not become true within 3s");
  EXPECT_EQ(failure.expected, "feeder.STATUS.4 == 0 within 3s");
  EXPECT_EQ(failure.came, "feeder.STATUS.4 == 0  (feeder.STATUS.4 is 1)");
  EXPECT_EQ(failure.at, SimTime{29'286'458} + std::chrono::seconds(3));
}

TEST(RunnerTimes, AConditionWithoutAResultFails) {
  const Failure failure = failing("  - wait: { until: 1 / feeder.STATUS == 1, within: 3s }\n");
  EXPECT_NE(failure.what.find("division by zero"), std::string::npos) << failure.what;
  EXPECT_EQ(failure.at, SimTime{0});
}

TEST(RunnerPolls, AskOverTheLineAtTheirTimes) {
  // Rounds start at 29.286458 ms and every 500 ms from then on; the move ends at 3075 ms, so the 8th round,
  // at 3529.286458 ms, sees it: 8 requests of 8 characters, 64 bytes.
  const ScenarioResult result =
      passing(kServoOn + kExampleMove +
              "  - wait: { until: feeder.STATUS.4 == 0 && feeder.STATUS.10 == 1, within: 4s, poll: 500ms }\n"
              "  - assert: rs485.bytes_in == 8 + 21 + 64\n");
  // The reply to the read of one register ends 9,343,749 ns after the start of the request.
  EXPECT_EQ(result.steps[2].end, SimTime{29'286'458} + std::chrono::milliseconds(3500) + SimTime{9'343'749});
}

TEST(RunnerPolls, TakesIsWhatTheHostSees) {
  // As above; the reply arrives in tick 3538, which is 3513 ms after tick 25.
  passing(kServoOn + kExampleMove +
          "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, poll: 500ms, takes: 3513ms }\n");
}

TEST(RunnerPolls, AreAsFastAsTheLineIfTheyAreToBeFaster) {
  // Each takes 9.34 ms and t3.5; 1 s contains 88 that start within it: ceil(1000 / 11.348958) = 89, the first
  // at 0.
  const ScenarioResult result = played("  - wait: { until: feeder.STATUS == 1, within: 1s, poll: 1ms }\n");
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->what, "'feeder.STATUS == 1' did not become true within 1s, polled every 1ms");
  EXPECT_EQ(result.failure->came, "feeder.STATUS == 1  (feeder.STATUS is 0)");
}

TEST(RunnerSpans, TheFirstTickThatBreaksThemFailsWithItsTime) {
  // 266 pulses have been sent at t = 50, 277 at t = 51.
  const ScenarioResult result = played("  - never: feeder.A.pulses > 266\n" + kServoOn + kExampleMove +
                                       "  - advance: 1s\n  - say: never said\n");
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->at, time_of(kExampleBegins + 51));
  EXPECT_EQ(result.failure->what, "never 'feeder.A.pulses > 266' (test.yaml:5) did not hold at 76ms");
  EXPECT_EQ(result.failure->came, "feeder.A.pulses > 266  (feeder.A.pulses is 277)");
  EXPECT_EQ(result.steps.size(), 4U);  // nothing runs after it
  EXPECT_EQ(result.steps.back().end, time_of(76));
  EXPECT_NE(result.failure->state[1].find("feeder.A: pulses 277"), std::string::npos)
      << result.failure->state[1];
}

TEST(RunnerSpans, AreWatchedWhileARequestIsOnTheLine) {
  // The servo is on from tick 6 on, while the reply is on the line until 9.9 ms.
  const Failure failure = failing("  - always: { what: feeder.STATUS.10 == 0, name: no servo }\n" + kServoOn);
  EXPECT_EQ(failure.at, time_of(6));
  EXPECT_EQ(failure.what, "always 'no servo' (test.yaml:5) did not hold at 6ms");
}

TEST(RunnerSpans, EndAWaitAtThatTick) {
  const ScenarioResult result = played("  - never: feeder.A.pulses > 266\n" + kServoOn + kExampleMove +
                                       "  - wait: { until: feeder.A.pulses > 266, within: 1s }\n");
  ASSERT_TRUE(result.failure);
  EXPECT_EQ(result.failure->what, "never 'feeder.A.pulses > 266' (test.yaml:5) did not hold at 76ms");
}

TEST(RunnerSpans, HoldUntilTheirEnd) {
  passing("  - always: { what: feeder.A.pulses == 0, name: still }\n" + kServoOn + "  - end: still\n" +
          kExampleMove + "  - advance: 100ms\n  - assert: feeder.A.pulses > 0\n");
  passing("  - never: feeder.A.pulses > 32000\n  - always: feeder.A.pulses >= 0\n" + kServoOn + kExampleMove +
          "  - advance: 4s\n");
}

TEST(RunnerSpans, AConditionWithoutAResultBreaksThem) {
  const Failure failure = failing("  - never: 10 / (time / 1ms - 20) > 10\n  - advance: 1s\n");
  EXPECT_EQ(failure.at, time_of(20));
  EXPECT_NE(failure.came.find("division by zero"), std::string::npos) << failure.came;
}

TEST(RunnerTruths, AreLookedAtWithoutTheLine) {
  passing(
      "  - assert: [ rs485.bytes_in == 0, feeder.HW_Code == 0xC001, time == 0 ]\n"
      "  - assert: rs485.bytes_in == 0 && time == 0\n");
  const Failure failure =
      failing("  - assert: [ feeder.power, feeder.STATUS == 1, time == 0, feeder.A.pulses > 5 ]\n");
  EXPECT_EQ(failure.what, "'feeder.STATUS == 1' does not hold");
  EXPECT_EQ(failure.came, "feeder.STATUS == 1  (feeder.STATUS is 0)");
  EXPECT_EQ(failure.details, std::vector<std::string>{"feeder.A.pulses > 5  (feeder.A.pulses is 0)"});
}

TEST(RunnerPeaks, AreThoseOfTheProfile) {
  // 200 RPM * 3200 / 60 = 10,666.67 pulses per second, reached in 50 ms: 213,333.33 more per second.
  passing(kServoOn + kExampleMove +
          "  - advance: 20ms\n"
          "  - assert: feeder.A.greatest_speed < 10000\n"
          "  - wait: { until: feeder.STATUS.4 == 0, within: 4s }\n"
          "  - assert: feeder.A.greatest_speed == 10666.6667 +- 0.001\n"
          "  - assert: feeder.A.greatest_acceleration == 213333.333 +- 0.1\n"
          "  - assert: feeder.B.greatest_speed == 0\n"
          "  - reset: peaks\n"
          "  - advance: 100ms\n"
          "  - assert: feeder.A.greatest_speed == 0 && feeder.A.greatest_acceleration == 0\n"
          "  - write: { feeder.Aaxis_Pulse: -32000, feeder.Aaxis_Speed: 100, feeder.Aaxis_AccTime: 10, "
          "feeder.Aaxis_DecTime: 10, feeder.Aaxis_Move_INC: 1 }\n"
          "  - advance: 1s\n"
          // Backwards, half as fast, in twice the time; as magnitudes.
          "  - assert: feeder.A.greatest_speed == 5333.3333 +- 0.001\n"
          "  - assert: feeder.A.greatest_acceleration == 53333.333 +- 0.1\n");
}

}  // namespace runner_time_test
}  // namespace understudy::emulator::play
