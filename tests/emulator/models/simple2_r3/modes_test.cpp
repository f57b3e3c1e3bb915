// Velocity, PWM and encoder-synchronous mode, homing, and how one mode replaces another.
#include "emulator/device/axes.h"
#include "emulator/models/simple2_r3/device.h"
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace modes_test {

const Simple2R3& inside(OneSimple2& feeder) { return static_cast<const Simple2R3&>(feeder.device()); }

std::int64_t speed_urpm(OneSimple2& feeder) { return inside(feeder).state().axes[0].speed_urpm; }

TEST(VelocityMode, RampsAndCountsAsWorkedOutByHand) {
  // 65.536 RPM at 32768 uRPM each half millisecond, 3200 pulses per revolution.
  ReadySimple2 feeder;
  feeder.set("Axis_VelMode_ACC", 32768);
  const Tick begin = feeder.now();
  feeder.set("Aaxis_DirectmRPM", 65536);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 1);
  EXPECT_TRUE(feeder.moving('A'));
  feeder.run_to(begin + 100);
  EXPECT_EQ(speed_urpm(feeder), 6'553'600);
  EXPECT_EQ(feeder.coordinate('A'), 17);  // 17.56
  feeder.run_to(begin + 1000);
  EXPECT_EQ(speed_urpm(feeder), 65'536'000);
  EXPECT_EQ(feeder.coordinate('A'), 1748);  // 1748.50
  feeder.run_to(begin + 2000);
  EXPECT_EQ(feeder.coordinate('A'), 5243);  // 5243.75

  feeder.set("Aaxis_DirectmRPM", 0);  // ramps down, and stays in the mode
  feeder.run_to(begin + 2999);
  EXPECT_TRUE(feeder.moving('A'));
  feeder.run_to(begin + 3000);
  EXPECT_FALSE(feeder.moving('A'));
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 1);
}

TEST(VelocityMode, TakesASpeedSetAndBothAxes) {
  ReadySimple2 feeder;
  feeder.set("Axis_VelMode_ACC", 32768);
  feeder.set("Baxis_VelMode_ACC", 32768);
  feeder.set("Parms_mRPM16", -65536);
  feeder.set("ALL_ParmsDirectmRPM", 16);
  EXPECT_EQ(feeder.get("Baxis_DirectmRPM"), -65536);
  feeder.run(1000);
  // -1748.50: the pulse that is being made is not sent yet, either way.
  EXPECT_EQ(feeder.coordinate('A'), -1748);
  EXPECT_EQ(feeder.coordinate('B'), -1748);
}

TEST(VelocityMode, IsDroppedWithTheServoOffAndItsValueKept) {
  OneSimple2 feeder;
  feeder.set("Aaxis_DirectmRPM", 5000);
  feeder.run(100);
  EXPECT_EQ(feeder.get("Aaxis_DirectmRPM"), 5000);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 0);
  EXPECT_EQ(feeder.coordinate('A'), 0);
}

TEST(VelocityMode, KeepsThePulseLimit) {
  ReadySimple2 feeder;
  feeder.set("Axis_VelMode_ACC", 32768);
  feeder.set("Aaxis_Resoultion", 6'000'000);  // 100 kHz is 1 RPM
  feeder.set("Aaxis_DirectmRPM", 5000);
  feeder.run(1000);
  const Value before = feeder.coordinate('A');
  feeder.run(1000);
  EXPECT_EQ(feeder.coordinate('A') - before, 100'000);
}

TEST(VelocityMode, ALimitStopsItAndTheOtherWayIsFree) {
  ReadySimple2 feeder;
  feeder.set("DIN2_Aaxis_UP_Limit", 1);
  feeder.set("Axis_VelMode_ACC", 32768);
  feeder.set("Aaxis_DirectmRPM", 65536);
  feeder.run(500);
  feeder.input(2, true);
  feeder.run(5);
  const Value stopped_at = feeder.coordinate('A');
  EXPECT_FALSE(feeder.moving('A'));
  feeder.run(50);
  EXPECT_EQ(feeder.coordinate('A'), stopped_at);
  feeder.set("Aaxis_DirectmRPM", 65536);  // into the limit: dropped
  feeder.run(50);
  EXPECT_EQ(feeder.coordinate('A'), stopped_at);
  feeder.set("Aaxis_DirectmRPM", -65536);
  feeder.run(500);
  EXPECT_LT(feeder.coordinate('A'), stopped_at);
}

TEST(PwmMode, IsEnteredAtOnceAndLeftByStop) {
  ReadySimple2 feeder;
  feeder.set("Aaxis_DirectPWM", 40);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 2);
  EXPECT_EQ(inside(feeder).state().axes[0].pwm_percent, 40);
  EXPECT_TRUE(feeder.moving('A'));
  feeder.run(100);
  EXPECT_EQ(feeder.coordinate('A'), 0);
  EXPECT_EQ(feeder.try_set("Aaxis_DirectPWM", 101), Refusal::bad_value);
  feeder.set("Aaxis_STOP", 1);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 0);
  EXPECT_EQ(inside(feeder).state().axes[0].pwm_percent, 0);
  EXPECT_EQ(feeder.get("Aaxis_DirectPWM"), 40);
}

TEST(SyncMode, FollowsItsEncoderByTheRatioAndKeepsTheRemainder) {
  ReadySimple2 feeder;
  feeder.set("Axis_EncSync_NUM", 2);
  feeder.set("Axis_EncSync_DEN", 3);
  feeder.set("Aaxis_SyncMode", 1);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 3);
  for (int counts = 1; counts <= 1000; ++counts) {
    feeder.device().axes()->set_encoder(0, counts);
    feeder.run(1);
  }
  feeder.run(20);
  EXPECT_EQ(feeder.coordinate('A'), 666);
  for (int counts = 999; counts >= 0; --counts) {
    feeder.device().axes()->set_encoder(0, counts);
    feeder.run(1);
  }
  feeder.run(20);
  EXPECT_EQ(feeder.coordinate('A'), 0) << "nothing is lost on the way back";
  feeder.set("ALL_STOP", 1);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 0);
  feeder.device().axes()->set_encoder(0, 500);
  feeder.run(50);
  EXPECT_EQ(feeder.coordinate('A'), 0);
}

TEST(SyncMode, IsDroppedInAnAlarmThatWasAssignedJustNow) {
  ReadySimple2 feeder;
  feeder.input(0, true);
  feeder.run(10);
  feeder.set("DIN0_Aaxis_Alarm", 1);
  feeder.set("Aaxis_SyncMode", 1);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 0);
  feeder.set("DIN0_Aaxis_Alarm", 0);
  feeder.set("Aaxis_SyncMode", 1);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 3);
}

TEST(SyncMode, IsNoFasterThanItsTopSpeed) {
  ReadySimple2 feeder;
  feeder.set("Aaxis_Resoultion", 6000);
  feeder.set("Axis_SyncRPM", 10);  // 1000 pulses per second
  feeder.set("Aaxis_SyncMode", 1);
  feeder.device().axes()->set_encoder(0, 100'000);
  feeder.run(1000);
  EXPECT_EQ(feeder.coordinate('A'), 5) << "one period at 1000 pulses a second; the rest is forgotten";
}

TEST(EncoderSpeed, IsTheCountsOfTheLast100Milliseconds) {
  OneSimple2 feeder;
  feeder.set("ENCA_Resoultion", 6000);
  for (int i = 1; i <= 300; ++i) {
    feeder.device().axes()->set_encoder(0, 10 * i);  // 10,000 a second: 100 RPM
    feeder.run(1);
  }
  EXPECT_EQ(feeder.get("ENCA_RPM"), 100);
  feeder.set("Axis_ENC_Polarity", 1);
  EXPECT_EQ(feeder.get("ENCA_RPM"), 100) << "counted pulses stay counted";
  for (int i = 301; i <= 400; ++i) {
    feeder.device().axes()->set_encoder(0, 10 * i);
    feeder.run(1);
  }
  EXPECT_EQ(feeder.get("ENCA_RPM"), -100);
  feeder.run(300);
  EXPECT_EQ(feeder.get("ENCA_RPM"), 0);
}

TEST(EncoderSpeed, OfAMachineThatTheAxisMovesIsTheAxisSpeed) {
  world::PlantSetup plant;
  plant.encoder_counts_per_revolution = 6000;
  plant.pulses_per_revolution = 3200;
  ReadySimple2 feeder({.plant = {{0, plant}}});
  feeder.set("ENCA_Resoultion", 6000);
  feeder.set_move('A', 100'000, 100, 1, 1);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(200);  // at 5333.3 pulses or 10,000 counts per second since 10 ms
  EXPECT_EQ(feeder.get("ENCA_RPM"), 100);
}

/// Homing at one pulse a millisecond with ramps of 10 ms (5 pulses).
struct HomingSimple2 : ReadySimple2 {
  explicit HomingSimple2(int direction, const Given& given = {}) : ReadySimple2(given) {
    set("Aaxis_Resoultion", 3000);
    set("Aaxis_Home_Speed", 20);
    set("Aaxis_Home_AccTime", 1);
    set("Axis_GoHome_DIR", direction);
    set("DIN4_Aaxis_Home", 1);
    set("DIN2_Aaxis_UP_Limit", 1);
    set("DIN3_Aaxis_DN_Limit", 1);
  }
};

TEST(Homing, EndsOnTheEdgeAndMakesItZero) {
  HomingSimple2 feeder(1);
  feeder.set("Aaxis_GoHome", 1);
  EXPECT_EQ(feeder.get("Aaxis_GoHome"), 1);
  EXPECT_TRUE(feeder.bit("STATUS.6"));
  EXPECT_TRUE(feeder.moving('A'));
  feeder.run(205);  // 200 pulses on, less those of the ramp
  const Value edge = feeder.coordinate('A');
  feeder.input(4, true);
  std::int64_t travel = 0;
  while (feeder.bit("STATUS.6")) {
    feeder.run(1);
    travel += feeder.device().axes()->pulses_this_tick(0);
    ASSERT_LT(feeder.now(), 2000);
  }
  EXPECT_GT(edge, 150);
  EXPECT_EQ(travel, 0) << "past the edge by the ramp, and back to it";
  EXPECT_EQ(feeder.coordinate('A'), 0);
  EXPECT_TRUE(feeder.bit("STATUS.8"));
  EXPECT_FALSE(feeder.moving('A'));
  EXPECT_EQ(feeder.get("Aaxis_GoHome"), 0);
}

TEST(Homing, TurnsRoundAtTheLimitAndGivesUpAtTheSecond) {
  HomingSimple2 feeder(0);
  feeder.set("Aaxis_GoHome", 1);
  feeder.run(100);
  EXPECT_LT(feeder.coordinate('A'), 0);
  feeder.input(3, true);
  feeder.run(20);
  feeder.input(3, false);
  const Value turned = feeder.coordinate('A');
  feeder.run(100);
  EXPECT_GT(feeder.coordinate('A'), turned) << "searches in the other direction";
  feeder.input(2, true);
  feeder.run(50);
  EXPECT_FALSE(feeder.bit("STATUS.6"));
  EXPECT_FALSE(feeder.bit("STATUS.8"));
}

TEST(Homing, AtSpeed0HangsUntilStop) {
  HomingSimple2 feeder(1);
  feeder.set("Aaxis_Home_Speed", 0);
  feeder.set("Aaxis_GoHome", 1);
  feeder.run(5000);
  EXPECT_TRUE(feeder.bit("STATUS.6"));
  EXPECT_TRUE(feeder.moving('A'));
  EXPECT_EQ(feeder.coordinate('A'), 0);
  feeder.set("Aaxis_STOP", 1);
  EXPECT_FALSE(feeder.bit("STATUS.6"));
}

TEST(Homing, WithTheServoOffIsDropped) {
  HomingSimple2 feeder(1);
  feeder.set("Aaxis_SVON", 0);
  feeder.set("Aaxis_GoHome", 1);
  EXPECT_FALSE(feeder.bit("STATUS.6"));
}

TEST(Modes, TheLastCommandWins) {
  ReadySimple2 feeder;
  feeder.set("Axis_VelMode_ACC", 32768);
  feeder.set_one_pulse_a_tick('A', 1000);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(100);
  feeder.set("Aaxis_DirectmRPM", 1000);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 1);
  EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 0);
  feeder.set("Aaxis_SyncMode", 1);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 3);
  feeder.set("Aaxis_DirectPWM", 10);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 2);
  feeder.set("Aaxis_Move_INC", 1);
  EXPECT_EQ(feeder.get("Aaxis_Mode"), 0);
  const Value here = feeder.coordinate('A');
  feeder.run_while_moving('A');
  EXPECT_EQ(feeder.coordinate('A'), here + 1000);
}

}  // namespace modes_test
}  // namespace understudy::emulator::models::simple2_r3
