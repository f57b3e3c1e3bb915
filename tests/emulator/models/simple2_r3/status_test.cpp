// STATUS, bit by bit, and the inputs behind it (manual: 狀態相關, 輸入輸出功能指配相關).
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace status_test {

struct InputCase {
  int input;
  std::string_view assignment;
  int status_bit;  // -1: homing only, no bit of its own
};
// DIN0 to DIN4 belong to A, DIN5 to DIN9 to B.
const std::vector<InputCase> kInputs = {
    {0, "DIN0_Aaxis_Alarm", 0},
    {5, "DIN5_Baxis_Alarm", 1},
    {1, "DIN1_Aaxis_Ready", 2},
    {6, "DIN6_Baxis_Ready", 3},
    {2, "DIN2_Aaxis_UP_Limit", 12},
    {7, "DIN7_Baxis_UP_Limit", 13},
    {3, "DIN3_Aaxis_DN_Limit", 14},
    {8, "DIN8_Baxis_DN_Limit", 15},
    {4, "DIN4_Aaxis_Home", -1},
    {9, "DIN9_Baxis_Home", -1},
    {10, "", -1},
};

TEST(Status, IsZeroAtPowerUp) {
  OneSimple2 feeder;
  EXPECT_EQ(feeder.get("STATUS"), 0);
  feeder.run(1000);
  EXPECT_EQ(feeder.get("STATUS"), 0);
}

TEST(Status, AnAssignedInputLightsItsBitAloneOneTickLater) {
  for (const auto& [input, assignment, bit] : kInputs) {
    OneSimple2 feeder;
    if (!assignment.empty()) feeder.set(assignment, 1);
    feeder.run(5);
    EXPECT_EQ(feeder.get("STATUS"), 0) << input;
    feeder.input(input, true);
    EXPECT_EQ(feeder.get("STATUS"), 0) << input << " before the tick that reads it";
    feeder.run(1);
    EXPECT_EQ(feeder.get("STATUS"), bit < 0 ? 0 : Value{1} << bit) << input;
    feeder.input(input, false);
    feeder.run(1);
    EXPECT_EQ(feeder.get("STATUS"), 0) << input;
  }
}

TEST(Status, AnUnassignedInputLightsNothing) {
  OneSimple2 feeder;
  for (const InputCase& c : kInputs) feeder.input(c.input, true);
  feeder.run(5);
  EXPECT_EQ(feeder.get("DIN_ALL"), 0x7FF);
  EXPECT_EQ(feeder.get("STATUS"), 0);
}

TEST(Status, AnAssignmentIsHeededAtOnceAndTakenBackAtOnce) {
  for (const auto& [input, assignment, bit] : kInputs) {
    if (bit < 0) continue;
    OneSimple2 feeder;
    for (const InputCase& c : kInputs) feeder.input(c.input, true);
    feeder.run(5);
    feeder.set(assignment, 1);
    EXPECT_EQ(feeder.get("STATUS"), Value{1} << bit) << assignment;
    feeder.set(assignment, 0);
    EXPECT_EQ(feeder.get("STATUS"), 0) << assignment;
  }
}

TEST(Status, TheAlarmIsAMatterOfPolarityAndALevel) {
  struct Case {
    Value assigned, polarity;
    bool input, alarm;
  };
  const std::vector<Case> cases = {
      {0, 0, false, false}, {0, 0, true, false}, {0, 1, false, false}, {0, 1, true, false},
      {1, 0, false, false}, {1, 0, true, true},  {1, 1, false, true},  {1, 1, true, false},
  };
  for (const Case& c : cases) {
    for (const bool is_a : {true, false}) {
      OneSimple2 feeder;
      feeder.set(is_a ? "DIN0_Aaxis_Alarm" : "DIN5_Baxis_Alarm", c.assigned);
      feeder.set(is_a ? "Aaxis_ALM_Polarity" : "Baxis_ALM_Polarity", c.polarity);
      feeder.input(is_a ? 0 : 5, c.input);
      feeder.run(1);
      EXPECT_EQ(feeder.get("STATUS"), c.alarm ? (is_a ? 1 : 2) : 0) << c.assigned << c.polarity << c.input;
      feeder.input(is_a ? 0 : 5, !c.input);  // not latched
      feeder.run(1);
      EXPECT_EQ(feeder.get("STATUS"), c.assigned == 1 && !c.alarm ? (is_a ? 1 : 2) : 0)
          << c.assigned << c.polarity << c.input;
    }
  }
}

TEST(Status, TheServoBitsFollowTheServos) {
  struct Case {
    std::string_view name;
    Value value, status;
  };
  OneSimple2 feeder;
  for (const Case& c : std::vector<Case>{{"Aaxis_SVON", 1, kServoA},
                                         {"Baxis_SVON", 1, kServoA | kServoB},
                                         {"Aaxis_SVON", 0, kServoB},
                                         {"ALL_SVON", 1, kServoA | kServoB},
                                         {"ALL_SVON", 0, 0},
                                         {"Baxis_SVON", 1, kServoB}}) {
    feeder.set(c.name, c.value);
    EXPECT_EQ(feeder.get("STATUS"), c.status) << c.name << c.value;
    EXPECT_EQ(feeder.get("Aaxis_SVON"), (c.status & kServoA) != 0);
    EXPECT_EQ(feeder.get("Baxis_SVON"), (c.status & kServoB) != 0);
  }
}

TEST(Status, ReadyGatesNothing) {
  ReadySimple2 feeder;
  feeder.set("DIN1_Aaxis_Ready", 1);
  feeder.set_one_pulse_a_tick('A', 100);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(50);
  feeder.input(1, true);
  feeder.run(10);
  feeder.input(1, false);
  feeder.run(100);
  EXPECT_EQ(feeder.coordinate('A'), 100);
}

TEST(Inputs, ReadRawOneByOneAndTogetherAlsoWhenAssigned) {
  OneSimple2 feeder;
  for (const InputCase& c : kInputs) {
    if (!c.assignment.empty()) feeder.set(c.assignment, 1);
  }
  feeder.set("Aaxis_ALM_Polarity", 1);
  for (int lit = 0; lit < 11; ++lit) {
    for (int i = 0; i < 11; ++i) feeder.input(i, i == lit);
    feeder.run(1);
    EXPECT_EQ(feeder.get("DIN_ALL"), 1 << lit);
    for (int i = 0; i < 11; ++i) EXPECT_EQ(feeder.get("DIN_" + std::to_string(i)), i == lit) << i;
  }
}

TEST(Inputs, AreLookedAtInTicksSoAShorterPulseIsNotSeen) {
  OneSimple2 feeder;
  feeder.run_to(10);
  feeder.input(10, true);
  feeder.world().advance_to(std::chrono::microseconds(10'900));
  feeder.input(10, false);
  feeder.run_to(20);
  EXPECT_EQ(feeder.get("DIN_10"), 0);
}

}  // namespace status_test
}  // namespace understudy::emulator::models::simple2_r3
