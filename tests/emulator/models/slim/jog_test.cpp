// One module: jogs and thrust.
#include <gtest/gtest.h>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace jog_test {

OneChain jogging() {
  OneChain bench;
  bench.speeds(0, 10'000, 10'000);
  bench.jog_speed(0, 1000);
  return bench;
}

TEST(SlimJog, RunsAtVjAndStopsWithItsRamp) {
  OneChain bench = jogging();
  ASSERT_EQ(bench.chain.jog(0, +1), Error::none);
  bench.steps(1 + 1000);
  EXPECT_EQ(bench.travel(0), 950);   // 0.1 s of ramp
  EXPECT_TRUE(bench.chain.done(0));  // it is not queued
  EXPECT_TRUE(bench.chain.status(0).jog);
  EXPECT_EQ(bench.chain.status(0).mode, Mode::jog);
  bench.chain.jog(0, 0);
  EXPECT_FALSE(bench.chain.done(0));
  bench.steps(100);
  EXPECT_EQ(bench.travel(0), 1000);
  EXPECT_FALSE(bench.chain.moving(0));
  EXPECT_FALSE(bench.chain.status(0).jog);
}

TEST(SlimJog, TheOtherWayReplacesItAfterItHasStopped) {
  OneChain bench = jogging();
  bench.chain.jog(0, +1);
  bench.steps(1 + 1000);
  bench.chain.jog(0, -1);
  bench.steps(100 + 1000);
  EXPECT_EQ(bench.travel(0), 1000 - 950);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), -1000);
}

TEST(SlimJog, TheSameWayWhileItStopsSpeedsUpAgain) {
  OneChain bench = jogging();
  bench.chain.jog(0, +1);
  bench.steps(1001);
  bench.chain.jog(0, 0);
  bench.steps(50);
  bench.chain.jog(0, +1);
  bench.steps(50);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), 1000);
  EXPECT_EQ(bench.travel(0), 950 + 75);
}

TEST(SlimJog, ANegativeVjSwapsTheWaysAndZeroOnlySeemsToMove) {
  OneChain bench = jogging();
  bench.jog_speed(0, -1000);
  bench.chain.jog(0, +1);
  bench.steps(1001);
  EXPECT_EQ(bench.travel(0), -950);
  bench.chain.emergency_stop();
  bench.jog_speed(0, 0);
  bench.chain.jog(0, +1);
  bench.steps(100);
  EXPECT_EQ(bench.travel(0), -950);
  EXPECT_TRUE(bench.chain.moving(0));
  EXPECT_EQ(bench.chain.next_active_tick(bench.tick), kNever);
  bench.chain.jog(0, 0);
  EXPECT_FALSE(bench.chain.moving(0));
}

TEST(SlimJog, IsRefusedWhileAQueuedMoveRuns) {
  OneChain bench = jogging();
  bench.chain.move(0, true, 1000);
  EXPECT_EQ(bench.chain.jog(0, +1), Error::not_allowed);
  EXPECT_EQ(bench.chain.thrust(0, 1), Error::not_allowed);
  EXPECT_EQ(bench.chain.jog(0, 0), Error::none);  // no jog to stop
  bench.finish();
  EXPECT_EQ(bench.travel(0), 1000);
}

TEST(SlimJog, AMoveGivenMeanwhileWaitsAndOutputsDoNot) {
  OneChain bench = jogging();
  bench.chain.jog(0, +1);
  bench.steps(1001);
  EXPECT_EQ(bench.chain.set_output(0, 1, true), Error::none);
  EXPECT_TRUE(bench.chain.output(0, 1));
  EXPECT_EQ(bench.chain.move(0, false, 500), Error::none);
  EXPECT_EQ(bench.chain.set_output(0, 2, true), Error::none);
  bench.steps(1000);
  EXPECT_EQ(bench.chain.module_at(0).fifo.size(), 2U);
  EXPECT_FALSE(bench.chain.output(0, 2));
  bench.chain.jog(0, 0);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 2000 + 500);
  EXPECT_TRUE(bench.chain.output(0, 2));
}

TEST(SlimThrust, PushesUntilItIsStopped) {
  OneChain bench = jogging();
  EXPECT_EQ(bench.chain.thrust(0, 0), Error::range);
  EXPECT_EQ(bench.chain.thrust(0, 20'001), Error::range);
  ASSERT_EQ(bench.chain.thrust(0, 20'000), Error::none);
  bench.steps(10);
  EXPECT_EQ(bench.chain.status(0).mode, Mode::torque);
  EXPECT_EQ(bench.chain.module_at(0).thrust, 20'000);
  bench.chain.move(0, false, 100);
  bench.steps(100);
  EXPECT_EQ(bench.travel(0), 0);
  bench.chain.thrust(0, 5);
  EXPECT_EQ(bench.chain.module_at(0).thrust, 5);
  bench.chain.jog(0, 0);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 100);
  EXPECT_EQ(bench.chain.module_at(0).thrust, 0);
  // From a jog: after that has stopped.
  bench.chain.jog(0, +1);
  bench.steps(1001);
  bench.chain.thrust(0, 9);
  bench.steps(100);
  EXPECT_EQ(bench.travel(0), 100 + 1000);
  EXPECT_EQ(bench.chain.status(0).mode, Mode::torque);
  // And a jog after that.
  bench.chain.jog(0, -1);
  bench.steps(1001);
  EXPECT_EQ(bench.travel(0), 1100 - 950);
}

TEST(SlimThrust, MayRunByChoice) {
  ChainOptions options;
  options.choose(option("thrust", "runs_at_vj"));
  OneChain bench(options);
  bench.speeds(0, 10'000, 10'000);
  bench.jog_speed(0, 1000);
  bench.chain.thrust(0, 9);
  bench.steps(1001);
  EXPECT_EQ(bench.travel(0), 950);
  EXPECT_EQ(bench.chain.status(0).mode, Mode::torque);
  bench.chain.jog(0, 0);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 1000);
  EXPECT_EQ(bench.chain.module_at(0).thrust, 0);
}

// A command that is only queued already decides what is within reach.
TEST(SlimMove, IsRefusedAtOnceWhereItWouldLeadTooFar) {
  OneChain bench;
  EXPECT_EQ(bench.chain.move(0, true, 1e13), Error::range);
  EXPECT_EQ(bench.chain.move(0, true, 9e11), Error::none);
  EXPECT_EQ(bench.chain.move(0, false, 2e11), Error::range);  // from where the other one will end
  EXPECT_EQ(bench.chain.move(0, false, -2e11), Error::none);
  EXPECT_EQ(bench.chain.module_at(0).fifo.size(), 2U);
}

TEST(SlimMove, IsOutOfItsBufferInTheTickOfItsArrival) {
  for (const bool pauses : {true, false}) {
    OneChain bench;
    bench.speeds(0, 1000, 10'000);
    bench.chain.move(0, true, 100);  // 0.2 s
    bench.steps(200);
    EXPECT_EQ(bench.chain.module_at(0).fifo.size(), 1U);
    bench.step();
    EXPECT_EQ(bench.travel(0), 100);
    EXPECT_EQ(bench.chain.module_at(0).fifo.size(), 0U);
    // And nothing remains to be continued, whatever arrives in that tick.
    if (pauses) {
      bench.chain.pause();
    } else {
      bench.chain.set_servo_at_once(0, false);
    }
    EXPECT_EQ(bench.chain.module_at(0).fifo.size(), 0U);
    EXPECT_TRUE(bench.chain.done(0));
    EXPECT_FALSE(bench.chain.busy(0));
  }
}

TEST(SlimJog, VjOfZeroIsOfTheNextJogAlsoWhereSpeedsCountAtOnce) {
  ChainOptions options;
  options.choose(option("new_speed", "at_once"));
  OneChain bench(options);
  bench.speeds(0, 10'000, 10'000);
  bench.jog_speed(0, 1000);
  bench.chain.jog(0, +1);
  bench.steps(1000);
  bench.chain.settings().set_jog_speed(0, 0);
  bench.steps(1000);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), 1000);
}

}  // namespace jog_test
}  // namespace understudy::emulator::models::slim
