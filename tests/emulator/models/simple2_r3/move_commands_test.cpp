// Which commands start, replace and end moves (manual: 運動相關, 預存位置表, appendix A).
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace move_commands_test {

struct AxisCase {
  char axis;
  Value moving_bit;
};
constexpr AxisCase kBothAxes[] = {{'A', kMovingA}, {'B', kMovingB}};

TEST(MoveCommands, IncrementalGoesByDistanceAndAbsoluteToTheTarget) {
  struct Case {
    Value start;
    std::string_view command;
    Value pulses, end;
  };
  const std::vector<Case> cases = {
      {0, "Move_INC", 300, 300},       {100, "Move_INC", 300, 400}, {100, "Move_INC", -300, -200},
      {0, "Move_ABS", 300, 300},       {100, "Move_ABS", 300, 300}, {100, "Move_ABS", -300, -300},
      {-1000, "Move_ABS", -999, -999},
  };
  for (const auto& [axis, moving_bit] : kBothAxes) {
    for (const Case& c : cases) {
      ReadySimple2 feeder;
      feeder.set_one_pulse_a_tick(axis, c.pulses);
      feeder.set(axis == 'A' ? "Cord_A" : "Cord_B", c.start);
      feeder.set(feeder.name(axis, c.command), 1);
      EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB | moving_bit);
      EXPECT_EQ(feeder.get(feeder.name(axis, c.command)), 1) << c.command;
      feeder.run_to(11);
      EXPECT_EQ(feeder.run_while_moving(axis), std::max<Tick>(20, std::abs(c.end - c.start) + 10))
          << c.command;
      EXPECT_EQ(feeder.coordinate(axis), c.end) << axis << " " << c.command << " " << c.pulses;
      EXPECT_EQ(feeder.get(feeder.name(axis, c.command)), 0) << c.command;
    }
  }
}

TEST(MoveCommands, TheManualsCoordinateExampleAddsUpTo1500) {
  ReadySimple2 feeder;
  feeder.set_move('A', 2000, 200, 5, 5);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(1000);
  EXPECT_EQ(feeder.coordinate('A'), 2000);
  feeder.set("Aaxis_Pulse", -500);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(1000);
  EXPECT_EQ(feeder.coordinate('A'), 1500);
}

TEST(MoveCommands, AZeroWrittenToATriggerDoesNothing) {
  ReadySimple2 feeder;
  feeder.set_one_pulse_a_tick('A', 1000);
  feeder.set_one_pulse_a_tick('B', 1000);
  for (const std::string_view command : {"Aaxis_Move_INC", "Aaxis_Move_ABS", "Baxis_Move_INC",
                                         "Baxis_Move_ABS", "ALL_Move_INC", "ALL_Move_ABS"}) {
    feeder.set(command, 0);
    EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB) << command;
  }
  feeder.set("ALL_Move_INC", 1);
  feeder.run_to(11 + 105);
  for (const std::string_view command :
       {"Aaxis_STOP", "Baxis_STOP", "ALL_STOP", "Aaxis_Move_INC", "Baxis_Move_INC", "ALL_Move_ABS"}) {
    feeder.set(command, 0);
  }
  feeder.run_to(11 + 205);
  EXPECT_EQ(feeder.coordinate('A'), 200);
  EXPECT_EQ(feeder.coordinate('B'), 200);
}

TEST(MoveCommands, AllStartsBothInTheSameTickEachWithItsOwnProfile) {
  for (const std::string_view command : {"ALL_Move_INC", "ALL_Move_ABS"}) {
    ReadySimple2 feeder;
    feeder.set_one_pulse_a_tick('A', 1000);
    feeder.set_move('B', -32'000, 200, 5, 5);
    feeder.set(command, 1);
    EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB | kMovingA | kMovingB);
    feeder.run_to(11 + 25);
    EXPECT_EQ(feeder.coordinate('A'), 20);
    EXPECT_EQ(feeder.coordinate('B'), -66);
    feeder.run_to(11 + 1009);
    EXPECT_TRUE(feeder.moving('A'));
    feeder.run_to(11 + 1010);
    EXPECT_FALSE(feeder.moving('A'));
    EXPECT_EQ(feeder.coordinate('A'), 1000);
    EXPECT_TRUE(feeder.moving('B'));
    feeder.run_to(11 + 3050);
    EXPECT_FALSE(feeder.moving('B'));
    EXPECT_EQ(feeder.coordinate('B'), -32'000);
  }
}

TEST(MoveCommands, AllStartsOnlyTheAxisWhoseServoIsOn) {
  ReadySimple2 feeder;
  feeder.set("Baxis_SVON", 0);
  feeder.set_one_pulse_a_tick('A', 1000);
  feeder.set_one_pulse_a_tick('B', 1000);
  feeder.set("ALL_Move_INC", 1);
  EXPECT_EQ(feeder.get("STATUS"), kServoA | kMovingA);
}

TEST(MoveCommands, BySetTheStoredSetMovesAndTheMotionBlockStaysAsItIs) {
  struct Case {
    std::uint16_t address;
    int set;
    Value a, b;  // where the axes end; they begin at 100
  };
  // Sets 1 and 16 hold 40 and -70 pulses.
  const std::vector<Case> cases = {
      {0x2100, 1, 140, 140}, {0x2101, 1, 140, 100},  {0x2102, 1, 100, 140},  {0x2106, 1, 40, 40},
      {0x2107, 1, 40, 100},  {0x2108, 1, 100, 40},   {0x2100, 16, 30, 30},   {0x2101, 16, 30, 100},
      {0x2102, 16, 100, 30}, {0x2106, 16, -70, -70}, {0x2107, 16, -70, 100}, {0x2108, 16, 100, -70},
  };
  for (const Case& c : cases) {
    ReadySimple2 feeder;
    feeder.write(0x2000, {40, 0, 20, 1, 1});
    feeder.write(0x204B, {static_cast<std::uint16_t>(-70), 0xFFFF, 20, 2, 4});
    feeder.set("ALL_SVON", 1);
    for (const char axis : {'A', 'B'}) {
      feeder.set_one_pulse_a_tick(axis, 12'345);
      feeder.set(axis == 'A' ? "Cord_A" : "Cord_B", 100);
    }
    feeder.write(c.address, {static_cast<std::uint16_t>(c.set)});
    EXPECT_EQ(feeder.moving('A'), c.a != 100) << std::hex << c.address;
    EXPECT_EQ(feeder.moving('B'), c.b != 100) << std::hex << c.address;
    const std::string kind = c.address < 0x2103 ? "Move_INC" : "Move_ABS";
    EXPECT_EQ(feeder.bit("Aaxis_" + kind), c.a != 100);
    EXPECT_EQ(feeder.bit("Baxis_" + kind), c.b != 100);
    feeder.run(1000);
    EXPECT_EQ(feeder.coordinate('A'), c.a) << std::hex << c.address << " set " << c.set;
    EXPECT_EQ(feeder.coordinate('B'), c.b) << std::hex << c.address << " set " << c.set;
    EXPECT_EQ(feeder.get("Aaxis_Pulse"), 12'345);
    EXPECT_EQ(feeder.get("Baxis_AccTime"), 1);
  }
}

TEST(MoveCommands, EverySetUsesItsOwnSpeedAndTimes) {
  ReadySimple2 feeder;
  feeder.set("Aaxis_Resoultion", 3000);
  for (Value n = 1; n <= 16; ++n) {
    const std::string number = std::to_string(n);
    feeder.set("Parms_Pulse" + number, 1000 * n);
    feeder.set("Parms_Speed" + number, 20 * n);  // n pulses/ms
    feeder.set("Parms_AccTime" + number, n);
    feeder.set("Parms_DecTime" + number, 17 - n);
  }
  for (Value n = 1; n <= 16; ++n) {
    const Value before = feeder.coordinate('A');
    feeder.set("Aaxis_ParmsMove_INC", n);
    feeder.run(1);
    EXPECT_EQ(feeder.run_while_moving('A'), 1000 + 17 * 10 / 2) << n;
    EXPECT_EQ(feeder.coordinate('A') - before, 1000 * n) << n;
  }
}

TEST(MoveCommands, BySetZeroDoesNothingAndSeventeenIsRefused) {
  ReadySimple2 feeder;
  for (std::uint16_t address : {0x2100, 0x2101, 0x2102, 0x2106, 0x2107, 0x2108}) {
    for (int n = 1; n <= 16; ++n) feeder.set("Parms_Pulse" + std::to_string(n), 100 * n);
    feeder.write(address, {0});
    EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB) << address;
    for (const std::uint16_t number : {17, 255, 65'535}) {
      const std::vector<std::uint16_t> words{number};
      EXPECT_EQ(write_words(*feeder.device().register_bank(), Table::holding, address, words),
                Refusal::bad_value)
          << address;
      EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB) << address;
    }
  }
}

TEST(MoveCommands, AtSpeedZeroAMoveHangsUntilSomethingEndsIt) {
  struct Case {
    std::string_view name;
    Value value;
    Value status_after;
  };
  const std::vector<Case> cases = {
      {"Aaxis_STOP", 1, kServoA | kServoB},
      {"ALL_STOP", 1, kServoA | kServoB},
      {"Aaxis_SVON", 0, kServoB},
      {"ALL_SVON", 0, 0},
      {"Aaxis_ParmsMove_INC", 3, kServoA | kServoB},  // a set of distance 0
  };
  for (const Case& c : cases) {
    ReadySimple2 feeder;
    feeder.set("Aaxis_Pulse", 1);  // Speed is 0 at power-up
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(100'000);
    EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB | kMovingA);
    EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 1);
    EXPECT_EQ(feeder.coordinate('A'), 0);
    feeder.set("Aaxis_Speed", 200);  // used by the next move only
    feeder.run(1000);
    EXPECT_EQ(feeder.coordinate('A'), 0);
    feeder.set(c.name, c.value);
    EXPECT_EQ(feeder.get("STATUS"), c.status_after) << c.name;
    EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 0) << c.name;
  }
}

TEST(MoveCommands, ANewCommandEndsAHangingMove) {
  ReadySimple2 feeder;
  feeder.set_one_pulse_a_tick('A', 50);
  feeder.set("Aaxis_Speed", 0);
  feeder.set("Aaxis_Move_ABS", 1);
  feeder.run(100);
  feeder.set("Aaxis_Speed", 20);
  feeder.set("Aaxis_Move_INC", 1);
  EXPECT_EQ(feeder.get("Aaxis_Move_ABS"), 0);
  EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 1);
  feeder.run(1);
  EXPECT_EQ(feeder.run_while_moving('A'), 60);
  EXPECT_EQ(feeder.coordinate('A'), 50);
}

TEST(MoveCommands, ADistanceOfZeroSetsNoBitAndCancelsTheCurrentMove) {
  struct Case {
    std::string_view name;
    Value pulses;
    Value speed;
  };
  // After 105 ms the coordinate is 100.
  for (const Case& c : std::vector<Case>{{"Aaxis_Move_INC", 0, 20},
                                         {"Aaxis_Move_INC", 0, 0},
                                         {"ALL_Move_INC", 0, 20},
                                         {"Aaxis_Move_ABS", 100, 20},
                                         {"Aaxis_Move_ABS", 100, 0},
                                         {"ALL_Move_ABS", 100, 20}}) {
    ReadySimple2 feeder;
    feeder.set_one_pulse_a_tick('A', 1000);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run_to(11 + 105);
    ASSERT_EQ(feeder.coordinate('A'), 100);
    ASSERT_TRUE(feeder.moving('A'));
    feeder.set_move('A', c.pulses, c.speed, 1, 1);
    for (int again = 0; again < 2; ++again) {  // in progress, then from rest
      feeder.set(c.name, 1);
      EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB) << c.name;
      EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 0) << c.name;
      EXPECT_EQ(feeder.get("Aaxis_Move_ABS"), 0) << c.name;
      feeder.run(100);
      EXPECT_EQ(feeder.coordinate('A'), 100) << c.name;
    }
  }
}

TEST(MoveCommands, ANewMoveReplacesTheOldOneFromStandstillWhereItIs) {
  struct Case {
    std::string_view command;
    Value end;
  };
  for (const auto& [command, end] : {Case{"Aaxis_Move_INC", 100 - 60}, Case{"Aaxis_Move_ABS", -60}}) {
    ReadySimple2 feeder;
    feeder.set_one_pulse_a_tick('A', 1000);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run_to(11 + 105);
    ASSERT_EQ(feeder.coordinate('A'), 100);
    feeder.set("Aaxis_Pulse", -60);
    feeder.set(command, 1);
    feeder.run(1);  // t = 0 of the new one: no pulse of either
    EXPECT_EQ(feeder.coordinate('A'), 100) << command;
    feeder.run(10);
    EXPECT_EQ(feeder.coordinate('A'), 95) << command;  // 10 * 10 / 20, from rest
    EXPECT_EQ(feeder.run_while_moving('A'), (100 - end) + 10 - 10) << command;
    EXPECT_EQ(feeder.coordinate('A'), end) << command;
  }
}

TEST(MoveCommands, StopStopsAtOnceAndOnlyItsAxis) {
  struct Case {
    std::string_view command;
    bool a, b;
  };
  for (const auto& [command, a, b] :
       {Case{"Aaxis_STOP", true, false}, Case{"Baxis_STOP", false, true}, Case{"ALL_STOP", true, true}}) {
    ReadySimple2 feeder;
    feeder.set_one_pulse_a_tick('A', 1000);
    feeder.set_one_pulse_a_tick('B', -1000);
    feeder.set("ALL_Move_INC", 1);
    feeder.run_to(11 + 505);
    feeder.set(command, 1);
    EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB | (a ? 0 : kMovingA) | (b ? 0 : kMovingB)) << command;
    EXPECT_EQ(feeder.bit("Aaxis_Move_INC"), !a) << command;
    EXPECT_EQ(feeder.bit("Baxis_Move_INC"), !b) << command;
    EXPECT_EQ(feeder.get("Aaxis_STOP"), 0);
    EXPECT_EQ(feeder.get("Baxis_STOP"), 0);
    feeder.run(1000);
    EXPECT_EQ(feeder.coordinate('A'), a ? 500 : 1000) << command;
    EXPECT_EQ(feeder.coordinate('B'), b ? -500 : -1000) << command;
  }
}

TEST(MoveCommands, AStopBeforeTheFirstTickLeavesNoPulse) {
  ReadySimple2 feeder;
  feeder.set_one_pulse_a_tick('A', 1000);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.set("Aaxis_STOP", 1);
  feeder.run(2000);
  EXPECT_EQ(feeder.coordinate('A'), 0);
}

TEST(MoveCommands, WhileTheServoIsOffCommandsAreDropped) {
  for (const std::string_view command : {"Aaxis_Move_INC", "Aaxis_Move_ABS", "ALL_Move_INC", "ALL_Move_ABS",
                                         "Aaxis_ParmsMove_INC", "ALL_ParmsMove_ABS"}) {
    OneSimple2 feeder;
    feeder.set_one_pulse_a_tick('A', 1000);
    feeder.write(0x2000, {40, 0, 20, 1, 1});
    feeder.set(command, 1);
    EXPECT_EQ(feeder.get("STATUS"), 0) << command;
    EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 0) << command;
    feeder.run(10);
    feeder.set("ALL_SVON", 1);  // a dropped command does not come back
    feeder.run(1000);
    EXPECT_EQ(feeder.coordinate('A'), 0) << command;
  }
}

TEST(MoveCommands, ServoOffStopsForGoodAndTheOtherAxisContinues) {
  struct Case {
    std::string_view command;
    bool a, b;
  };
  for (const auto& [command, a, b] :
       {Case{"Aaxis_SVON", true, false}, Case{"Baxis_SVON", false, true}, Case{"ALL_SVON", true, true}}) {
    ReadySimple2 feeder;
    feeder.set_one_pulse_a_tick('A', 1000);
    feeder.set_one_pulse_a_tick('B', 1000);
    feeder.set("ALL_Move_INC", 1);
    feeder.run_to(11 + 305);
    feeder.set(command, 0);
    EXPECT_EQ(feeder.get("STATUS"), (a ? 0 : kServoA | kMovingA) | (b ? 0 : kServoB | kMovingB)) << command;
    EXPECT_EQ(feeder.bit("Aaxis_SVON"), !a) << command;
    EXPECT_EQ(feeder.bit("Baxis_SVON"), !b) << command;
    feeder.set(command, 1);
    feeder.run(2000);
    EXPECT_EQ(feeder.coordinate('A'), a ? 300 : 1000) << command;
    EXPECT_EQ(feeder.coordinate('B'), b ? 300 : 1000) << command;
  }
}

TEST(MoveCommands, ServoOnWhileOnDisturbsNothing) {
  ReadySimple2 feeder;
  feeder.set_one_pulse_a_tick('A', 1000);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run_to(11 + 305);
  feeder.set("Aaxis_SVON", 1);
  feeder.run_to(11 + 1010);
  EXPECT_EQ(feeder.coordinate('A'), 1000);
  EXPECT_FALSE(feeder.moving('A'));
}

}  // namespace move_commands_test
}  // namespace understudy::emulator::models::simple2_r3
