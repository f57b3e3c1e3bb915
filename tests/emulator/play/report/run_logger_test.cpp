// A report on the manual's example move (played.h has its times).
#include "emulator/play/report/run_logger.h"

#include "tests/emulator/play/performing/played.h"

namespace understudy::emulator::play {
namespace run_logger_test {

RunOptions filmed(bool with_hash = false) {
  RunOptions options{.with_hash = with_hash};
  options.observers.push_back([](world::World& world) { return std::make_unique<RunLogger>(world); });
  return options;
}

const SeenSignal& signal_of(const Stretch& stretch, const std::string& name) {
  for (const SeenSignal& signal : stretch.signals) {
    if (signal.name == name) return signal;
  }
  throw std::runtime_error("no signal " + name);
}

const std::string kStands = "  - wait: { until: feeder.STATUS.4 == 0, within: 4s, poll: 37ms }\n";

TEST(RunLogger, ChangesNothing) {
  const std::string steps = kServoOn + kExampleMove + "  - inject: { lost_steps: feeder.A, one_in: 9 }\n" +
                            kStands + "  - power: { feeder: cycle }\n";
  const ScenarioResult without = played(steps, "", {.with_hash = true});
  const ScenarioResult with = played(steps, "", filmed(true));
  EXPECT_TRUE(has_passed(with)) << why(with);
  EXPECT_EQ(with.outcome_hash, without.outcome_hash);
  EXPECT_EQ(without.run_log, nullptr);
  EXPECT_NE(with.run_log, nullptr);
}

TEST(RunLogger, SeesPositionSpeedAndSwitches) {
  const ScenarioResult result =
      played(kServoOn + kExampleMove + kStands + "  - input: { feeder.DIN_10: on }\n  - advance: 10ms\n", "",
             filmed());
  ASSERT_EQ(result.run_log->stretches.size(), 1U);
  const Stretch& stretch = result.run_log->stretches[0];
  EXPECT_EQ(stretch.begin, SimTime{0});
  EXPECT_EQ(stretch.end, result.steps.back().end);
  const SeenSignal& position = signal_of(stretch, "feeder.A.position");
  EXPECT_EQ(position.min, 0);
  EXPECT_EQ(position.max, 32000);
  EXPECT_EQ(position.points.front().tick, 0);
  EXPECT_EQ(position.points.back().tick, tick_at(stretch.end));
  EXPECT_EQ(position.points.back().value, 32000);
  // 200 RPM at 3200 pulses; the plan reaches it after 50 ms and leaves it 50 ms before the end, at 3050 ms.
  const SeenSignal& speed = signal_of(stretch, "feeder.A.speed");
  EXPECT_NEAR(speed.max, 32000 / 3.0, 0.001);
  for (const SeenSignal::Point& point : speed.points) {
    const Tick since = point.tick - (kExampleBegins - 1);
    if (since > 50 && since < 3000) {
      EXPECT_NEAR(point.value, 32000 / 3.0, 0.001) << point.tick;
    }
    if (since <= 0 || since >= 3050) {
      EXPECT_EQ(point.value, 0) << point.tick;
    }
  }
  EXPECT_FALSE(signal_of(stretch, "feeder.B.position").varies());
  EXPECT_TRUE(signal_of(stretch, "feeder.DIN_10").varies());
  EXPECT_EQ(signal_of(stretch, "feeder.DIN_10").points.back().value, 1);
  EXPECT_FALSE(signal_of(stretch, "feeder.power").varies());
}

TEST(RunLogger, SeesVoltagesInVolts) {
  const ScenarioResult result = played("  - input: { feeder.AIN_A: 2.5V }\n  - advance: 5ms\n", "", filmed());
  EXPECT_EQ(signal_of(result.run_log->stretches[0], "feeder.AIN_A").max, 2.5);
}

TEST(RunLogger, ReadsTheFrames) {
  const ScenarioResult result =
      played(kServoOn + "  - send: { bytes: 01 03 00, reply: nothing, within: 20ms }\n", "", filmed());
  const auto& frames = result.run_log->stretches.at(0).frames;
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].time, SimTime{0});
  EXPECT_EQ(frames[0].line, "rs485");
  EXPECT_TRUE(frames[0].is_from_host);
  EXPECT_EQ(frames[0].text, "write 0x1014 feeder.Aaxis_SVON = 1");
  EXPECT_EQ(frames[0].bytes, "01 06 10 14 00 01 0C CE");
  // 8 characters of 11 bits at 19200, and 0.75 ms.
  EXPECT_EQ(frames[1].time, SimTime{5'333'333});
  EXPECT_FALSE(frames[1].is_from_host);
  EXPECT_EQ(frames[1].text, "done");
  EXPECT_EQ(frames[2].text, "01 03 00");
  EXPECT_EQ(frames[2].remark, "dropped: incomplete");
}

TEST(RunLogger, BeginsAnotherSceneWhereTimeGoesBack) {
  const ScenarioResult result =
      played("  - snapshot: begin\n" + kServoOn + "  - advance: 100ms\n  - restore: begin\n" + kServoOn +
                 "  - advance: 50ms\n",
             "", filmed());
  ASSERT_TRUE(has_passed(result)) << why(result);
  const auto& stretches = result.run_log->stretches;
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_EQ(stretches[0].first_step, 0U);
  EXPECT_EQ(stretches[0].end, time_of(tick_at(result.steps[2].end)));  // the last tick before
  EXPECT_EQ(stretches[1].first_step, 4U);
  EXPECT_EQ(stretches[1].begin, SimTime{0});
  EXPECT_EQ(stretches[1].frames.size(), 2U);
  EXPECT_EQ(stretches[1].end, result.steps[5].end);
}

TEST(RunLogger, ABranchHasASceneOfItsOwn) {
  const Scenario scenario =
      scenario_of(kServoOn + "  - fork: { a: [ advance: 5ms ], b: [ advance: 7ms ] }\n");
  const auto results = run_scenario(scenario, filmed());
  ASSERT_EQ(results.size(), 3U);
  for (const std::size_t branch : {1U, 2U}) {
    ASSERT_EQ(results[branch].run_log->stretches.size(), 1U);
    const Stretch& stretch = results[branch].run_log->stretches[0];
    EXPECT_EQ(stretch.begin, results[0].steps[0].end);
    EXPECT_EQ(stretch.end - stretch.begin, std::chrono::milliseconds(branch == 1 ? 5 : 7));
    EXPECT_TRUE(stretch.frames.empty());
  }
}

TEST(RunLogger, OfManyFramesKeepsTheFirstAndTheLast) {
  const ScenarioResult result =
      played("  - repeat: { times: 2000, as: n, steps: [ write: { feeder.Aaxis_Pulse: \"${n}\" } ] }\n", "",
             filmed());
  const Stretch& stretch = result.run_log->stretches.at(0);
  EXPECT_EQ(stretch.frames.size(), 600U);
  EXPECT_EQ(stretch.frames.size() + stretch.frames_left_out, 4000U);
  EXPECT_EQ(stretch.left_out_at, 300U);
  EXPECT_EQ(stretch.frames[298].text, "write 0x1000 feeder.Aaxis_Pulse = 150");
  EXPECT_EQ(stretch.frames[300].text, "write 0x1000 feeder.Aaxis_Pulse = 1851");
  EXPECT_EQ(stretch.frames[598].text, "write 0x1000 feeder.Aaxis_Pulse = 2000");
}

TEST(RunLogger, SeesWhatFaultsDidToFrames) {
  const ScenarioResult result = played(
      "  - inject: { drop: feeder, nth: 1 }\n"
      "  - send: { bytes: 01 03 00 01 00 01 +crc, reply: nothing, within: 20ms }\n"
      "  - expect: { feeder.HW_Code: 49153 }\n",
      "", filmed());
  const auto& frames = result.run_log->stretches.at(0).frames;
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_FALSE(frames[0].is_struck);
  EXPECT_TRUE(frames[1].is_struck);
  EXPECT_FALSE(frames[1].is_from_host);
  EXPECT_EQ(frames[1].text, "");
  EXPECT_EQ(frames[1].remark, "fault 1 drop: not sent");
  EXPECT_EQ(frames[3].text, "feeder.HW_Code = 49153") << "read by the request before it";
}

}  // namespace run_logger_test
}  // namespace understudy::emulator::play
