// One module: motor control and homing.
#include <gtest/gtest.h>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace servo_and_home_test {

OneChain jogging() {
  OneChain bench;
  bench.speeds(0, 10'000, 10'000);
  bench.jog_speed(0, 1000);
  return bench;
}

TEST(SlimServo, OffAtOnceDiscardsMotionAndFifo) {
  OneChain bench;
  bench.speeds(0, 1000, 10'000);
  bench.chain.move(0, true, 1000);
  bench.chain.set_output(0, 1, true);
  bench.steps(501);
  const std::int64_t at = bench.travel(0);
  ASSERT_EQ(bench.chain.set_servo_at_once(0, false), Error::none);
  EXPECT_TRUE(bench.all_done());
  EXPECT_EQ(bench.chain.move(0, true, 5), Error::servo_off);
  EXPECT_EQ(bench.chain.jog(0, 1), Error::servo_off);
  EXPECT_EQ(bench.chain.home(0), Error::servo_off);
  EXPECT_EQ(bench.chain.thrust(0, 1), Error::servo_off);
  bench.steps(100);
  EXPECT_EQ(bench.travel(0), at);
  EXPECT_FALSE(bench.chain.output(0, 1));
  EXPECT_EQ(bench.chain.set_servo_at_once(0, true), Error::none);
  bench.chain.move(0, true, 0);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 0);
}

TEST(SlimServo, InItsTurnItWaitsForTheMotionBeforeIt) {
  OneChain bench;
  bench.chain.move(0, true, 1000);
  ASSERT_EQ(bench.chain.set_servo(0, false), Error::none);
  EXPECT_EQ(bench.chain.move(0, true, 2000), Error::servo_off);  // it will be off by then
  ASSERT_EQ(bench.chain.set_servo(0, true), Error::none);
  ASSERT_EQ(bench.chain.move(0, true, 3000), Error::none);
  ASSERT_EQ(bench.chain.set_servo(0, false), Error::none);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 3000);
  EXPECT_FALSE(bench.chain.axis(0).servo_on);
}

TEST(SlimServo, OffEndsAJogAndWhatWaitsForItIsDroppedWithItsError) {
  OneChain bench = jogging();
  bench.chain.jog(0, +1);
  bench.steps(501);
  bench.chain.move(0, true, 5);
  bench.chain.jog(0, 0);
  bench.chain.jog(0, +1);
  const std::int64_t at = bench.travel(0);
  // After the waiting move: that never starts.
  bench.chain.set_servo(0, false);
  bench.step();
  EXPECT_TRUE(bench.chain.axis(0).servo_on);
  bench.chain.set_servo_at_once(0, false);
  bench.steps(100);
  EXPECT_LE(bench.travel(0), at + 1);
  EXPECT_FALSE(bench.chain.status(0).jog);
  EXPECT_EQ(bench.chain.module_at(0).fifo.size(), 0U);
}

TEST(SlimServo, OffOfOneStopsItsGroupAndItsCommandsOnly) {
  OneChain bench;
  bench.map({0, 1});
  bench.line({100, 100});
  bench.line({100, 100});
  bench.chain.move(0, true, 0);
  bench.chain.move(5, true, 100);
  bench.steps(300);
  const std::int64_t at = bench.travel(1);
  bench.chain.set_servo_at_once(1, false);
  EXPECT_EQ(bench.chain.groups_running(), 0);
  EXPECT_EQ(bench.line({1, 1}), Error::servo_off);
  bench.finish();
  EXPECT_EQ(bench.travel(1), at);
  EXPECT_EQ(bench.travel(0), 0);  // its own move was executed
  EXPECT_EQ(bench.travel(5), 100);
}

TEST(SlimServo, ResetClearsTheQueueAndKeepsTheCoordinate) {
  OneChain bench;
  bench.speeds(0, 1000, 10'000);
  bench.chain.set_coordinate(0, 50);
  bench.chain.move(0, false, 1000);
  bench.chain.set_servo(0, false);
  bench.steps(501);
  const double x = bench.chain.coordinate(0);
  ASSERT_GT(x, 100);
  EXPECT_EQ(bench.chain.reset(0), Error::none);
  bench.steps(500);
  EXPECT_EQ(bench.chain.coordinate(0), x);
  EXPECT_TRUE(bench.chain.axis(0).servo_on);
  EXPECT_TRUE(bench.all_done());
}

TEST(SlimServo, AtPowerUpByChoice) {
  ChainOptions options;
  options.choose(option("power_up_servo", "off"));
  OneChain bench(options);
  EXPECT_EQ(bench.chain.move(0, true, 1), Error::servo_off);
  EXPECT_EQ(bench.chain.set_servo(0, true), Error::none);
  EXPECT_EQ(bench.chain.move(0, true, 1), Error::none);
}

// ---- Homing

TEST(SlimHome, GoesAtMinusVjUntilHorgAndIsZeroWhereItStops) {
  OneChain bench = jogging();
  bench.chain.environment(0).add(motion::Signal::home, -5000, -2000);
  bench.chain.set_coordinate(0, 777);
  ASSERT_EQ(bench.chain.home(0), Error::none);
  bench.chain.move(0, true, 100);
  EXPECT_FALSE(bench.chain.status(0).homed);
  while (bench.chain.module_at(0).fifo.size() == 2) bench.step();
  // 2000 pulses to the edge, and 1000^2 / 20000 to stop.
  EXPECT_EQ(bench.travel(0), -2050);
  EXPECT_EQ(bench.chain.coordinate(0), 0);
  EXPECT_TRUE(bench.chain.status(0).homed);
  EXPECT_EQ(bench.tick - 1, 2050 + 100);  // 50 at the beginning, 1950 at speed, 50: 100 + 1950 + 100
  bench.finish();
  EXPECT_EQ(bench.travel(0), -1950);
  EXPECT_EQ(bench.chain.coordinate(0), 100);
}

TEST(SlimHome, OnHorgItIsThereAlready) {
  OneChain bench = jogging();
  bench.chain.move(0, true, 300);
  bench.finish();
  bench.chain.set_horg(0, true);
  ASSERT_EQ(bench.chain.home(0), Error::none);
  EXPECT_TRUE(bench.all_done());
  EXPECT_EQ(bench.chain.coordinate(0), 0);
  EXPECT_TRUE(bench.chain.status(0).homed);
}

TEST(SlimHome, ByAnInputAndWithANegativeVjTheOtherWay) {
  OneChain bench = jogging();
  bench.jog_speed(0, -1000);
  ASSERT_EQ(bench.chain.home(0), Error::none);
  bench.steps(1001);
  EXPECT_EQ(bench.travel(0), 950);
  bench.chain.set_horg(0, true);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 1000);
  EXPECT_EQ(bench.chain.coordinate(0), 0);
}

TEST(SlimHome, PausedItRestarts) {
  OneChain bench = jogging();
  bench.chain.environment(0).add(motion::Signal::home, -5000, -2000);
  bench.chain.home(0);
  bench.steps(501);
  bench.chain.pause();
  bench.steps(500);
  EXPECT_FALSE(bench.chain.moving(0));
  EXPECT_FALSE(bench.chain.status(0).homed);
  bench.chain.resume();
  bench.finish();
  EXPECT_EQ(bench.travel(0), -2050);
  EXPECT_TRUE(bench.chain.status(0).homed);
}

}  // namespace servo_and_home_test
}  // namespace understudy::emulator::models::slim
