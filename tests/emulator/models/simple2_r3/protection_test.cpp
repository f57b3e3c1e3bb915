// The effect of limit switches and alarms on motion (choices limit_reaction, alarm_reaction, aclr_output).
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace protection_test {

struct Limit {
  char axis;
  std::string_view assignment;
  int input;
  int blocked_sign;
};
constexpr Limit kLimits[] = {{'A', "DIN2_Aaxis_UP_Limit", 2, +1},
                             {'A', "DIN3_Aaxis_DN_Limit", 3, -1},
                             {'B', "DIN7_Baxis_UP_Limit", 7, +1},
                             {'B', "DIN8_Baxis_DN_Limit", 8, -1}};

/// At 300 pulses of 1000.
void go(ReadySimple2& feeder, char axis, int sign) {
  feeder.set_one_pulse_a_tick(axis, sign * 1000);
  feeder.set(feeder.name(axis, "Move_INC"), 1);
  feeder.run_to(11 + 305);
  ASSERT_EQ(feeder.coordinate(axis), sign * 300);
}

TEST(LimitSwitch, AssignedStopsItsDirectionAtOnceAndNotTheOther) {
  for (const Limit& limit : kLimits) {
    for (const int sign : {+1, -1}) {
      ReadySimple2 feeder;
      feeder.set(limit.assignment, 1);
      go(feeder, limit.axis, sign);
      feeder.input(limit.input, true);
      feeder.run(1);
      const bool blocked = sign == limit.blocked_sign;
      EXPECT_EQ(feeder.moving(limit.axis), !blocked) << limit.assignment << sign;
      EXPECT_EQ(feeder.bit(feeder.name(limit.axis, "Move_INC")), !blocked) << limit.assignment << sign;
      feeder.run(1000);
      EXPECT_EQ(feeder.coordinate(limit.axis), sign * (blocked ? 300 : 1000)) << limit.assignment << sign;
      EXPECT_TRUE(feeder.bit(feeder.name(limit.axis, "SVON")));
    }
  }
}

TEST(LimitSwitch, UnassignedStopsNothing) {
  for (const int sign : {+1, -1}) {
    ReadySimple2 feeder;
    for (const Limit& limit : kLimits) feeder.input(limit.input, true);
    go(feeder, 'A', sign);
    feeder.run(1000);
    EXPECT_EQ(feeder.coordinate('A'), sign * 1000);
  }
}

TEST(LimitSwitch, OfOneAxisLeavesTheOtherAlone) {
  for (const Limit& limit : kLimits) {
    const char other = limit.axis == 'A' ? 'B' : 'A';
    for (const int sign : {+1, -1}) {
      ReadySimple2 feeder;
      feeder.set(limit.assignment, 1);
      feeder.input(limit.input, true);
      go(feeder, other, sign);
      feeder.run(1000);
      EXPECT_EQ(feeder.coordinate(other), sign * 1000) << limit.assignment;
    }
  }
}

TEST(LimitSwitch, WhileOnRefusesMovesTowardsItAndLetsMovesAwayPass) {
  for (const Limit& limit : kLimits) {
    ReadySimple2 feeder;
    feeder.set(limit.assignment, 1);
    feeder.input(limit.input, true);
    feeder.run(1);
    const std::string trigger = feeder.name(limit.axis, "Move_INC");
    feeder.set_one_pulse_a_tick(limit.axis, limit.blocked_sign * 100);
    feeder.set(trigger, 1);
    EXPECT_FALSE(feeder.moving(limit.axis)) << limit.assignment;
    EXPECT_EQ(feeder.get(trigger), 0) << limit.assignment;
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate(limit.axis), 0) << limit.assignment;

    feeder.set(feeder.name(limit.axis, "Pulse"), -limit.blocked_sign * 100);
    feeder.set(trigger, 1);
    EXPECT_TRUE(feeder.moving(limit.axis)) << limit.assignment;
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate(limit.axis), -limit.blocked_sign * 100) << limit.assignment;

    feeder.input(limit.input, false);
    feeder.run(1);
    feeder.set(feeder.name(limit.axis, "Pulse"), limit.blocked_sign * 100);
    feeder.set(trigger, 1);
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate(limit.axis), 0) << limit.assignment;
  }
}

TEST(LimitSwitch, EndsAHangingMoveInItsDirection) {
  for (const Limit& limit : kLimits) {
    ReadySimple2 feeder;
    feeder.set(limit.assignment, 1);
    feeder.set_move(limit.axis, limit.blocked_sign, 0, 0, 0);
    feeder.set(feeder.name(limit.axis, "Move_INC"), 1);
    feeder.run(10);
    EXPECT_TRUE(feeder.moving(limit.axis));
    feeder.input(limit.input, true);
    feeder.run(1);
    EXPECT_FALSE(feeder.moving(limit.axis)) << limit.assignment;
  }
}

TEST(LimitSwitch, MeansTheCommandedSenseWhateverTheDirectionPolarity) {
  for (const Firmware firmware : {140, 152}) {
    for (const int sign : {+1, -1}) {
      ReadySimple2 feeder({.firmware = firmware});
      feeder.set("Aaxis_DIR_Polarity", 1);
      feeder.set("DIN2_Aaxis_UP_Limit", 1);
      feeder.input(2, true);
      feeder.run(1);
      feeder.set_one_pulse_a_tick('A', sign * 100);
      feeder.set("Aaxis_Move_INC", 1);
      EXPECT_EQ(feeder.moving('A'), sign < 0) << firmware;
    }
  }
}

TEST(LimitSwitch, OfThePlantClosesAtItsPulseAndStopsTheNextTick) {
  world::PlantSetup plant;
  plant.lower_limit = -123;
  plant.upper_limit = 456;
  for (const int sign : {+1, -1}) {
    for (const bool is_a : {true, false}) {
      const char axis = is_a ? 'A' : 'B';
      const Value edge = sign > 0 ? 456 : 123;
      const std::string input = sign > 0 ? (is_a ? "DIN_2" : "DIN_7") : (is_a ? "DIN_3" : "DIN_8");
      ReadySimple2 feeder({.plant = {{is_a ? 0 : 1, plant}}});
      for (const Limit& limit : kLimits) feeder.set(limit.assignment, 1);
      feeder.set_one_pulse_a_tick(axis, sign * 1000);
      feeder.set(feeder.name(axis, "Move_INC"), 1);
      feeder.run_to(11 + edge + 4);
      EXPECT_EQ(feeder.coordinate(axis), sign * (edge - 1));
      EXPECT_EQ(feeder.get(input), 0);
      feeder.run(1);
      EXPECT_EQ(feeder.coordinate(axis), sign * edge);
      EXPECT_TRUE(feeder.moving(axis));
      feeder.run(1);
      EXPECT_EQ(feeder.get(input), 1);
      EXPECT_FALSE(feeder.moving(axis));
      feeder.run(1000);
      EXPECT_EQ(feeder.coordinate(axis), sign * edge);  // one pulse a tick: not one too many
      // Away from it the way is free, and the switch opens again.
      feeder.set(feeder.name(axis, "Pulse"), -sign * 50);
      feeder.set(feeder.name(axis, "Move_INC"), 1);
      feeder.run(200);
      EXPECT_EQ(feeder.coordinate(axis), sign * (edge - 50));
      EXPECT_EQ(feeder.get(input), 0);
    }
  }
}

TEST(LimitSwitch, OfThePlantIsPassedByWhatATickBrings) {
  world::PlantSetup plant;
  plant.upper_limit = 1000;
  ReadySimple2 feeder({.plant = {{0, plant}}});
  feeder.set("DIN2_Aaxis_UP_Limit", 1);
  feeder.set_move('A', 32'000, 200, 5, 5);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(2000);
  // floor(32 (t - 25) / 3) reaches 1000 at t = 119: 1002.67.
  EXPECT_EQ(feeder.coordinate('A'), 1002);
  EXPECT_FALSE(feeder.moving('A'));
}

TEST(Alarm, StopsItsAxisAndDropsCommandsButKeepsTheServoOn) {
  for (const bool is_a : {true, false}) {
    for (const Value polarity : {0, 1}) {
      const char axis = is_a ? 'A' : 'B';
      const char other = is_a ? 'B' : 'A';
      const int input = is_a ? 0 : 5;
      const bool alarm_level = polarity == 0;
      ReadySimple2 feeder;
      feeder.input(input, !alarm_level);
      feeder.run_to(11);
      feeder.set(is_a ? "DIN0_Aaxis_Alarm" : "DIN5_Baxis_Alarm", 1);
      feeder.set(feeder.name(axis, "ALM_Polarity"), polarity);
      feeder.set_one_pulse_a_tick('A', 1000);
      feeder.set_one_pulse_a_tick('B', 1000);
      feeder.set("ALL_Move_INC", 1);
      feeder.run_to(12 + 305);
      ASSERT_EQ(feeder.coordinate(axis), 300);
      feeder.input(input, alarm_level);
      feeder.run(1);
      EXPECT_FALSE(feeder.moving(axis)) << axis << polarity;
      EXPECT_TRUE(feeder.moving(other)) << axis << polarity;
      EXPECT_EQ(feeder.get(feeder.name(axis, "SVON")), 1);
      for (const std::string_view command : {"Move_INC", "Move_ABS", "ParmsMove_INC"}) {
        feeder.set("Parms_Pulse1", 10);
        feeder.set(feeder.name(axis, command), 1);
        EXPECT_FALSE(feeder.moving(axis)) << axis << polarity << command;
      }
      feeder.run(1000);
      EXPECT_EQ(feeder.coordinate(axis), 300);
      EXPECT_EQ(feeder.coordinate(other), 1000);
      feeder.input(input, !alarm_level);
      feeder.run(100);
      EXPECT_EQ(feeder.coordinate(axis), 300) << "a dropped command does not come back";
      feeder.set(feeder.name(axis, "Move_INC"), 1);
      feeder.run(2000);
      EXPECT_EQ(feeder.coordinate(axis), 1300);
    }
  }
}

TEST(Alarm, EndsAHangingMove) {
  ReadySimple2 feeder;
  feeder.set("DIN0_Aaxis_Alarm", 1);
  feeder.set("Aaxis_Pulse", 5);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(10);
  feeder.input(0, true);
  feeder.run(1);
  EXPECT_FALSE(feeder.moving('A'));
  EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 0);
}

TEST(Alarm, ByAssignmentOrPolarityAloneStopsInTheNextTick) {
  struct Case {
    std::string_view first, second;
  };
  for (const auto& [first, second] :
       {Case{"DIN0_Aaxis_Alarm", "Aaxis_ALM_Polarity"}, Case{"Aaxis_ALM_Polarity", "DIN0_Aaxis_Alarm"}}) {
    ReadySimple2 feeder;
    feeder.set(first, 1);
    go(feeder, 'A', +1);
    feeder.set(second, 1);  // the input is off: an alarm now
    feeder.run(1000);
    EXPECT_EQ(feeder.coordinate('A'), 300);
    EXPECT_EQ(feeder.get("STATUS.0"), 1);
  }
}

TEST(AlarmClear, ReadsOneFor200MillisecondsAndDrivesItsOutput) {
  struct Case {
    std::string_view command;
    bool a, b;
  };
  for (const auto& [command, a, b] :
       {Case{"Aaxis_ACLR", true, false}, Case{"Baxis_ACLR", false, true}, Case{"ALL_ACLR", true, true}}) {
    OneSimple2 feeder;
    feeder.set("DOUT1_Aaxis_ACLR", 1);
    feeder.set("DOUT3_Baxis_ACLR", 1);
    feeder.world().advance_to(std::chrono::microseconds(50'300));
    feeder.set(command, 0);
    EXPECT_EQ(feeder.get("DOUT_ALL"), 0) << command;
    feeder.set(command, 1);  // in tick 51, for 200 ticks
    for (const Tick tick : {50, 51, 52, 150, 249, 250, 251, 252, 400}) {
      feeder.run_to(tick);
      const bool on = tick < 251;
      EXPECT_EQ(feeder.bit("Aaxis_ACLR"), on && a) << command << tick;
      EXPECT_EQ(feeder.bit("Baxis_ACLR"), on && b) << command << tick;
      EXPECT_EQ(feeder.output(1), on && a) << command << tick;
      EXPECT_EQ(feeder.output(3), on && b) << command << tick;
      EXPECT_EQ(feeder.get("DOUT_ALL"), on ? (a ? 2 : 0) | (b ? 8 : 0) : 0) << command << tick;
    }
  }
}

TEST(AlarmClear, WithoutAnAssignedOutputReadsAlikeButDrivesNothing) {
  OneSimple2 feeder;
  feeder.run_to(50);
  feeder.set("ALL_ACLR", 1);
  feeder.run_to(250);
  EXPECT_EQ(feeder.get("Aaxis_ACLR"), 1);
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0);
  feeder.run_to(251);
  EXPECT_EQ(feeder.get("Aaxis_ACLR"), 0);
}

TEST(AlarmClear, ClearsNoAlarmByItselfAndStopsNoMotion) {
  ReadySimple2 feeder;
  feeder.set("DIN0_Aaxis_Alarm", 1);
  go(feeder, 'A', +1);
  feeder.set("Aaxis_ACLR", 1);
  feeder.run(1000);
  EXPECT_EQ(feeder.coordinate('A'), 1000);
  feeder.input(0, true);
  feeder.run(1);
  feeder.set("Aaxis_ACLR", 1);
  feeder.run(100);
  EXPECT_EQ(feeder.get("STATUS.0"), 1);
}

}  // namespace protection_test
}  // namespace understudy::emulator::models::simple2_r3
