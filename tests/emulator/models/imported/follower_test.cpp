#include "emulator/models/imported/follower.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/emulator/models/imported/one_described.h"

namespace understudy::emulator::models::imported {
namespace follower_test {

TEST(Follower, GoesTheShareOfAnExponential) {
  for (const double time : {1e-3, 0.01, 0.1, 1.0, 60.0}) {
    for (const double constant : {1e-4, 0.003, 0.1, 0.5, 1.0, 30.0, 1e5, 1e9}) {
      const double expected = -std::expm1(-time / constant);
      EXPECT_NEAR(lag_fraction(time, constant), expected, 1e-14 * expected) << time << " " << constant;
    }
  }
  EXPECT_EQ(lag_fraction(0.1, 0), 1);
}

TEST(Follower, ComesNearerNoFasterThanItMay) {
  EXPECT_EQ(approach(0, 100, 1, 0), 100);
  EXPECT_EQ(approach(0, 100, 0.25, 0), 25);
  EXPECT_EQ(approach(0, 100, 0.25, 10), 10);
  EXPECT_EQ(approach(0, -100, 0.25, 10), -10);
  EXPECT_EQ(approach(99.99999999, 100, 0.25, 10), 100) << "a rest has an end";
}

/// At every update, whatever its period: goal + (start - goal) exp(-t / constant), rounded.
TEST(Following, IsTheClosedFormOfAFirstOrderLag) {
  for (const char* every : {"1ms", "10ms", "250ms"}) {
    std::string model = axis_model();
    const std::string usual = "every: 10ms";
    model.replace(model.find(usual), usual.size(), std::string("every: ") + every);
    OneDescribed one(model);
    one.write("SETPOINT", 1000);
    for (int second = 1; second <= 12; ++second) {
      one.advance(1000);
      EXPECT_EQ(one.read("VALUE"), std::lround(1000 * (1 - std::exp(-second / 2.0))))
          << every << " " << second;
      EXPECT_EQ(one.read("HIGH"), 1000 * (1 - std::exp(-second / 2.0)) > 500 ? 1 : 0)
          << every << " " << second;
    }
    one.advance(100'000);
    EXPECT_EQ(one.read("VALUE"), 1000);
    const auto skipped = one.world.ticks_skipped();
    one.advance(1'000'000);
    EXPECT_GE(one.world.ticks_skipped() - skipped, 999'000U) << "once there, it costs nothing";
  }
}

const std::string kThermostat =
    "table,address,name,access,type,min,max,unit,persistent,default\n"
    "holding,0,SETPOINT,R/W,s16,,,,0,300\n"
    "holding,1,ON,R/W,u16,,,,0,0\n"
    "input,0,TEMPERATURE,R,f32,,,,0,20.5\n"
    "input,2,ROOM,R,s16,,,,0,0\n"
    "discrete,0,HEATS,R,bit,,,,0,0\n";

/// A heater that its own temperature switches, between its two targets, at 10 per second. Unless the file
/// says otherwise, it starts at the register's default, even if that is a real number.
TEST(Following, RestsAtTheDefault) {
  const std::string list =
      "address,name,access,type,default\n0,GOAL,R/W,u16,0\n1,REAL,R,f32,1.5\n3,WHOLE,R,s16,-40\n";
  OneDescribed one(
      model_file::model_with(list,
                             "follows:\n"
                             "  REAL: { of: GOAL, while: GOAL == 7, time_constant: 100ms, every: 10ms }\n"
                             "  WHOLE: { of: GOAL, while: GOAL == 7, time_constant: 100ms, every: 10ms }\n"));
  for (const Value goal : {0, 7, 0}) {
    one.write("GOAL", goal);
    one.advance(5'000);
    EXPECT_NEAR(real_of(one.read("REAL")), goal == 7 ? 7.0F : 1.5F, 1e-6);
    EXPECT_EQ(one.read("WHOLE"), goal == 7 ? 7 : -40);
  }
}

TEST(Following, MayDependOnWhatItShows) {
  OneDescribed one(model_file::model_with(
      kThermostat,
      "inputs: { ROOM_SENSOR: ROOM }\n"
      "follows: { TEMPERATURE: { of: 1000, while: HEATS, rest: ROOM, rate: 10, every: 100ms } }\n"
      "shows: { HEATS: TEMPERATURE < SETPOINT }\n"));
  const auto temperature = [&] { return real_of(one.read("TEMPERATURE")); };
  EXPECT_EQ(temperature(), 20.5F);
  one.advance(1000);
  EXPECT_NEAR(temperature(), 30.5F, 1e-4);
  one.advance(27'000);
  EXPECT_NEAR(temperature(), 300, 1.01) << "at the setpoint it is switched";
  one.advance(100'000);
  EXPECT_NEAR(temperature(), 300, 1.01);
  one.write("SETPOINT", -50);
  one.world.set_external_input(0, 0, 100);
  one.advance(10'000);
  EXPECT_NEAR(temperature(), 200, 1.01);
  one.advance(60'000);
  EXPECT_EQ(temperature(), 100);
}

}  // namespace follower_test
}  // namespace understudy::emulator::models::imported
