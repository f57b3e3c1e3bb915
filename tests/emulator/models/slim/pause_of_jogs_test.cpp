// TAPZ and TAREDO with jogs and thrust: stopped motion continues after the pause.
#include <gtest/gtest.h>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace pause_of_jogs_test {

/// At 1000 pulses per second, reached within 0.1 s and 50 pulses.
OneChain at_jog(const ChainOptions& options = {}) {
  OneChain bench(options);
  bench.speeds(6, 10'000, 10'000);
  bench.jog_speed(6, 1000);
  bench.chain.jog(6, +1);
  bench.steps(1001);
  EXPECT_EQ(bench.travel(6), 950);
  return bench;
}

TEST(SlimPauseTable, AJogContinuesAfterThePause) {
  OneChain bench = at_jog();
  bench.chain.pause();
  EXPECT_EQ(bench.chain.move(6, false, 5), Error::paused);
  bench.steps(1000);
  EXPECT_EQ(bench.travel(6), 1000);
  EXPECT_FALSE(bench.chain.moving(6));
  EXPECT_TRUE(bench.chain.busy(6));
  // A buffered command does not run in between.
  EXPECT_EQ(bench.chain.set_coordinate(6, 7), Error::none);
  EXPECT_EQ(bench.chain.coordinate(6), 1000);
  bench.chain.resume();
  bench.steps(1001);
  EXPECT_EQ(bench.travel(6), 1950);
  EXPECT_EQ(bench.chain.status(6).mode, Mode::jog);
  bench.chain.jog(6, 0);
  bench.finish();
  EXPECT_EQ(bench.travel(6), 2000);
  EXPECT_EQ(bench.chain.coordinate(6), 7);
  EXPECT_FALSE(bench.chain.busy(6));
}

TEST(SlimPauseTable, AJogContinuesBeforeItStands) {
  OneChain bench = at_jog();
  bench.chain.pause();
  bench.steps(50);
  bench.chain.resume();
  bench.steps(50);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(6), 1000);
  EXPECT_EQ(bench.travel(6), 950 + 75);
}

TEST(SlimPauseTable, AMoveBehindAJogStillWaitsAfterThePause) {
  OneChain bench = at_jog();
  EXPECT_EQ(bench.chain.move(6, false, 500), Error::none);
  bench.chain.pause();
  bench.steps(200);
  bench.chain.resume();
  bench.steps(1001);
  EXPECT_EQ(bench.travel(6), 1950);
  bench.chain.jog(6, 0);
  bench.finish();
  EXPECT_EQ(bench.travel(6), 2500);
}

TEST(SlimPauseTable, WhatAJogWasAboutToBeContinues) {
  // The pause comes while the axis reverses, and while it is being stopped.
  OneChain turning = at_jog();
  turning.chain.jog(6, -1);
  turning.steps(50);
  turning.chain.pause();
  turning.steps(200);
  EXPECT_EQ(turning.travel(6), 1000);
  turning.chain.pause_queues();  // another pause changes nothing
  turning.chain.resume_queues();
  turning.chain.resume();
  turning.steps(1001);
  EXPECT_EQ(turning.travel(6), 50);

  for (const bool before : {false, true}) {  // JG0 before the pause, and during it
    OneChain stopping = at_jog();
    if (before) stopping.chain.jog(6, 0);
    stopping.steps(50);
    stopping.chain.pause();
    if (!before) stopping.chain.jog(6, 0);
    stopping.steps(200);
    stopping.chain.resume();
    stopping.steps(200);
    EXPECT_FALSE(stopping.chain.busy(6));
    EXPECT_EQ(stopping.travel(6), before ? 1000 : 1050);
  }
}

TEST(SlimPauseTable, AJogIsGivenUpAndStoppedLikeAnything) {
  for (int how = 0; how < 5; ++how) {
    OneChain bench = at_jog();
    bench.chain.pause();
    bench.steps(how == 0 ? 50 : 200);
    switch (how) {
      case 0:
      case 1: bench.chain.discard(); break;
      case 2: bench.chain.emergency_stop(); break;
      case 3: bench.chain.clear_queues(); break;
      default: bench.chain.reset(6); break;
    }
    bench.chain.resume();
    bench.steps(300);
    EXPECT_FALSE(bench.chain.busy(6)) << how;
    EXPECT_EQ(bench.travel(6), 1000) << how;
  }
}

TEST(SlimPauseTable, AThrustContinuesAfterThePause) {
  for (const bool runs : {false, true}) {
    for (const Tick wait : {30, 300}) {  // while it decelerates, and at rest
      ChainOptions options;
      if (runs) options.choose(option("thrust", "runs_at_vj"));
      OneChain bench(options);
      bench.speeds(6, 10'000, 10'000);
      bench.jog_speed(6, 1000);
      bench.chain.thrust(6, 500);
      bench.steps(1001);
      bench.chain.pause();
      bench.steps(wait);
      bench.chain.resume();
      bench.steps(300);
      EXPECT_EQ(bench.chain.status(6).mode, Mode::torque);
      EXPECT_EQ(bench.chain.module_at(6).thrust, 500);
      EXPECT_EQ(bench.chain.speed_pps(6), runs ? 1000 : 0);
    }
  }
}

}  // namespace pause_of_jogs_test
}  // namespace understudy::emulator::models::slim
