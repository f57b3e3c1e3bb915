// One module: its moves, their speed, and which modules can be moved by number.
#include <gtest/gtest.h>

#include "tests/emulator/models/slim/one_chain.h"

namespace understudy::emulator::models::slim {
namespace module_moves_test {

TEST(SlimMove, TakesTheTimeOfATrapezoid) {
  struct Row {
    double distance, pps, pps2;
    Tick ms;
  };
  // L/v + v/a, or 2 sqrt(L/a) if L < v^2/a.
  for (const Row& row : {Row{10'000, 10'000, 100'000, 1100}, Row{-10'000, 10'000, 100'000, 1100},
                         Row{1000, 10'000, 100'000, 200}, Row{250, 10'000, 100'000, 100},
                         Row{1, 10'000, 100'000, 7}, Row{1'000'000, 500'000, 5'000'000, 2100}}) {
    OneChain bench;
    bench.speeds(3, row.pps, row.pps2);
    ASSERT_EQ(bench.chain.move(3, true, row.distance), Error::none);
    EXPECT_EQ(bench.chain.status(3).mode, Mode::position);
    EXPECT_EQ(bench.finish() - 1, row.ms) << row.distance;
    EXPECT_EQ(bench.travel(3), static_cast<std::int64_t>(row.distance));
    EXPECT_EQ(bench.sent[3], bench.travel(3));
    EXPECT_EQ(bench.chain.status(3).mode, Mode::idle);
  }
}

TEST(SlimMove, SpeedsAreRevolutionsByTheUnitThatFuGives) {
  // 1000 rpm at 10000 pulses per revolution is 166666.7 pps, and VA 10000 rpm/s is ten times that: 0.1 s of
  // ramp.
  OneChain bench;
  ASSERT_EQ(bench.chain.move(0, true, 1'000'000), Error::none);
  EXPECT_EQ(bench.finish() - 1, 6100);  // 6 s + 0.1 s
  bench.chain.settings().set_speed_unit(0, SpeedUnit::rps);
  bench.chain.settings().set_working_speed(0, 10);
  bench.chain.settings().set_acceleration(0, 100);
  const Tick began = bench.tick;
  bench.chain.move(0, true, 0);
  EXPECT_EQ(bench.finish() - began - 1, 10'100);
  bench.chain.settings().set_pulses_per_revolution(0, 20'000);
  const Tick again = bench.tick;
  bench.chain.move(0, false, 1'000'000);
  EXPECT_EQ(bench.finish() - again - 1, 5100);
}

TEST(SlimMove, QueuedRelativeMovesFollowOnWithoutALostTick) {
  OneChain bench;
  bench.speeds(0, 10'000, 100'000);
  bench.chain.move(0, false, 1000);
  bench.chain.move(0, false, 1000);
  bench.chain.move(0, true, 500);
  bench.chain.move(0, false, 500);
  EXPECT_EQ(bench.finish() - 1, 200 + 200 + 250 + 142);  // 1500/10000 + 0.1; 2 sqrt(500/100000) = 0.1414
  EXPECT_EQ(bench.travel(0), 1000);
}

TEST(SlimMove, UserUnitsAreByPn45AndPn46) {
  OneChain bench;
  ASSERT_EQ(bench.chain.settings().set_scale(0, 10'000, 360), Error::none);  // degrees
  for (int i = 0; i < 9; ++i) ASSERT_EQ(bench.chain.move(0, false, 40), Error::none);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 10'000);
  EXPECT_EQ(bench.chain.coordinate(0), 360);
  bench.chain.move(0, true, 1);
  bench.chain.set_coordinate(0, 100);
  EXPECT_EQ(bench.chain.settings().set_scale(0, 1, 1), Error::not_allowed);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 28);  // 27.8
  EXPECT_NEAR(bench.chain.coordinate(0), 100, 0.018);
  EXPECT_EQ(bench.chain.settings().set_scale(0, 0, 1), Error::range);
}

TEST(SlimMove, ACoordinateIsSetInItsTurn) {
  OneChain bench;
  bench.chain.move(0, true, 100);
  bench.chain.set_coordinate(0, 7);
  bench.chain.move(0, true, 10);
  bench.chain.move(0, false, 5);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 108);
  EXPECT_EQ(bench.chain.coordinate(0), 15);
}

TEST(SlimMove, AFullFifoRefusesAndLeavesThingsAsTheyAre) {
  OneChain bench;
  for (int i = 0; i < 32; ++i) {
    EXPECT_FALSE(bench.chain.full(0));
    ASSERT_EQ(bench.chain.move(0, false, 1000), Error::none) << i;
  }
  EXPECT_TRUE(bench.chain.full(0));
  const Chain before = bench.chain;
  EXPECT_EQ(bench.chain.move(0, false, 1), Error::buffer_full);
  EXPECT_EQ(bench.chain.set_output(0, 1, true), Error::buffer_full);
  EXPECT_EQ(bench.chain.set_servo(0, false), Error::buffer_full);
  EXPECT_EQ(bench.chain.home(0), Error::buffer_full);
  bench.map({1, 0});
  EXPECT_EQ(bench.line({1, 1}), Error::buffer_full);
  EXPECT_EQ(bench.chain.module_at(1).fifo.size(), 0U);
  bench.map({});
  EXPECT_EQ(bench.chain, before);
  // Commands that bypass it do so.
  EXPECT_EQ(bench.chain.set_output_at_once(0, 1, true), Error::none);
  EXPECT_TRUE(bench.chain.output(0, 1));
  bench.finish();
  EXPECT_EQ(bench.travel(0), 32'000);
}

TEST(SlimMove, VmWhileMovingByChoice) {
  for (const bool at_once : {false, true}) {
    ChainOptions options;
    if (at_once) options.choose(option("new_speed", "at_once"));
    OneChain bench(options);
    bench.speeds(0, 1000, 10'000);
    bench.chain.move(0, true, 2000);
    bench.steps(1 + 1000);  // 950 done
    bench.chain.settings().set_working_speed(0, 0.2);
    bench.finish();
    // 2000/1000 + 0.1; or 100 ms up to 2000 (150), 200 ms down (200), the 700 between at 2000.
    EXPECT_EQ(bench.tick - 1, at_once ? 1000 + 100 + 350 + 200 : 2100);
  }
}

// ---- Analog speed

TEST(SlimAvm, TheSpeedIsThatPartOfVmAtEveryMoment) {
  OneChain bench;
  bench.speeds(0, 1000, 10'000);
  bench.chain.set_analog(0, 500);
  ASSERT_EQ(bench.chain.set_analog_speed(0), Error::none);
  EXPECT_EQ(bench.chain.status(0).mode, Mode::analog);
  bench.chain.move(0, true, 1000);
  bench.steps(1 + 1000);  // at 500: 500 * 1 - 12.5 = 487.5 done
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), 500);
  bench.chain.set_analog(0, 0);
  bench.steps(200);  // 12.5 further, and stops
  EXPECT_EQ(bench.travel(0), 500);
  EXPECT_FALSE(bench.chain.moving(0));
  EXPECT_FALSE(bench.chain.done(0));
  EXPECT_EQ(bench.chain.next_active_tick(bench.tick), kNever);
  bench.chain.set_analog(0, 1000);
  const Tick again = bench.tick;
  bench.finish();
  EXPECT_EQ(bench.tick - again - 1, 600);  // 500/1000 + 0.1
}

TEST(SlimAvm, AndPauseTogether) {
  OneChain bench;
  bench.speeds(0, 1000, 1000);
  bench.chain.set_analog(0, 1000);
  bench.chain.set_analog_speed(0);
  bench.chain.move(0, true, 4000);
  bench.steps(2001);  // 1500 done, at 1000
  bench.chain.set_analog(0, 0);
  bench.steps(200);
  bench.chain.pause();
  bench.chain.set_analog(0, 500);
  bench.steps(200);  // decelerates all the time: 320 further, at 600
  bench.chain.resume();
  bench.steps(100);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), 500);
  bench.chain.set_analog(0, 800);
  bench.steps(300);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), 800);
  // Paused, and without a voltage when it continues: it stays.
  bench.chain.pause();
  bench.chain.set_analog(0, 0);
  bench.steps(100);
  bench.chain.resume();
  bench.steps(2000);
  EXPECT_FALSE(bench.chain.moving(0));
  EXPECT_FALSE(bench.chain.done(0));
  bench.chain.set_analog(0, 1000);
  bench.finish();
  EXPECT_EQ(bench.travel(0), 4000);
}

TEST(SlimAvm, AJogFollowsItAndVmEndsIt) {
  OneChain bench;
  bench.speeds(0, 1000, 10'000);
  bench.jog_speed(0, 1000);
  ASSERT_EQ(bench.chain.set_analog_speed(0), Error::none);
  ASSERT_EQ(bench.chain.jog(0, +1), Error::none);
  bench.steps(100);
  EXPECT_EQ(bench.travel(0), 0);
  bench.chain.set_analog(0, 250);
  bench.steps(200);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), 250);
  bench.chain.set_analog(0, 2000);  // as far as it can
  bench.steps(200);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), 1000);
  bench.chain.set_analog(0, 0);
  bench.steps(200);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), 0);
  EXPECT_EQ(bench.chain.settings().set_working_speed(0, 0.1), Error::none);
  EXPECT_FALSE(bench.chain.module_at(0).analog_speed);
  bench.steps(200);
  EXPECT_DOUBLE_EQ(bench.chain.speed_pps(0), 1000);
}

// ---- Mapped and unlinked modules

TEST(SlimMapped, AModuleWithALetterCannotBeMovedByNumberExceptByT0) {
  OneChain bench;
  bench.map({1, 0});
  EXPECT_EQ(bench.chain.move(1, true, 5), Error::axis);
  EXPECT_EQ(bench.chain.jog(1, +1), Error::axis);
  EXPECT_EQ(bench.chain.home(1), Error::axis);
  EXPECT_EQ(bench.chain.thrust(1, 5), Error::axis);
  EXPECT_EQ(bench.chain.jog(1, 0), Error::none);
  EXPECT_EQ(bench.chain.set_servo(1, true), Error::none);
  EXPECT_EQ(bench.chain.set_coordinate(1, 5), Error::none);
  EXPECT_EQ(bench.chain.set_output(1, 1, true), Error::none);
  EXPECT_EQ(bench.chain.move(0, true, 50), Error::none);
  EXPECT_EQ(bench.chain.move_axis(Letter::x, true, 15), Error::none);
  EXPECT_EQ(bench.chain.move_axis(Letter::z, true, 15), Error::axis);
  bench.finish();
  EXPECT_EQ(bench.chain.coordinate(1), 15);
  EXPECT_EQ(bench.travel(0), 50);
  bench.chain.assign(Letter::x, kUnassigned);
  EXPECT_EQ(bench.chain.move(1, true, 5), Error::none);
}

TEST(SlimMapped, OnlyModules0To5AndEachOnce) {
  OneChain bench;
  for (const int bad : {-1, 6, 7, 9, 100}) {
    EXPECT_EQ(bench.chain.assign(Letter::x, bad), Error::range) << bad;
  }
  EXPECT_EQ(bench.chain.assign(Letter::x, 5), Error::none);
  EXPECT_EQ(bench.chain.assign(Letter::y, 5), Error::range);
  EXPECT_EQ(bench.chain.assign(Letter::x, 5), Error::none);
  EXPECT_EQ(bench.chain.assigned(Letter::x), 5);
  EXPECT_EQ(bench.chain.assigned(Letter::y), kUnassigned);
}

TEST(SlimMapped, AnUnlinkedModuleTakesNothing) {
  Chain chain;  // only the host module
  EXPECT_EQ(chain.move(0, true, 1), Error::none);
  for (const int module : {1, 7, 8, -1}) {
    EXPECT_EQ(chain.move(module, true, 1), Error::not_linked);
    EXPECT_EQ(chain.jog(module, 0), Error::not_linked);
    EXPECT_EQ(chain.set_output(module, 1, true), Error::not_linked);
    EXPECT_EQ(chain.set_output_at_once(module, 1, true), Error::not_linked);
    EXPECT_EQ(chain.set_servo_at_once(module, false), Error::not_linked);
    EXPECT_EQ(chain.reset(module), Error::not_linked);
    EXPECT_EQ(chain.set_coordinate(module, 1), Error::not_linked);
    EXPECT_EQ(chain.arm(module, 1, 1, true, 1), Error::not_linked);
  }
}

}  // namespace module_moves_test
}  // namespace understudy::emulator::models::slim
