// Position moves to the tick and to the pulse (manual, appendix A).
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace move_timing_test {

/// The manual's example, floor(s(t)) in whole numbers: V = 32/3 pulses/ms, ramps of 50 ms.
std::int64_t example_position(Tick t) {
  if (t >= 3050) return 32'000;
  if (t <= 50) return 8 * t * t / 75;
  if (t <= 3000) return 32 * (t - 25) / 3;
  const Tick u = 3050 - t;
  return 32'000 - (8 * u * u + 74) / 75;
}

TEST(MoveTiming, TheManualsExampleIsExactPerTickAndEndsAfter3050) {
  ReadySimple2 feeder;
  feeder.set_move('A', 32'000, 200, 5, 5);
  feeder.world().advance_to(std::chrono::microseconds(10'400));  // between ticks 10 and 11: k = 11
  feeder.set("Aaxis_Move_INC", 1);
  EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 1);
  EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB | kMovingA);
  for (Tick t = 0; t < 3050; ++t) {
    feeder.run_to(11 + t);
    ASSERT_EQ(feeder.coordinate('A'), example_position(t)) << t << " ms";
    ASSERT_TRUE(feeder.moving('A')) << t << " ms";
    ASSERT_EQ(feeder.get("Aaxis_Move_INC"), 1) << t << " ms";
    ASSERT_EQ(feeder.get("Aaxis_Move_ABS"), 0) << t << " ms";
  }
  feeder.run_to(11 + 3050);
  EXPECT_EQ(feeder.coordinate('A'), 32'000);
  EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 0);
  EXPECT_EQ(feeder.get("STATUS"), kServoA | kServoB);
  feeder.run(1000);
  EXPECT_EQ(feeder.coordinate('A'), 32'000);
  EXPECT_EQ(feeder.coordinate('B'), 0);
}

TEST(MoveTiming, TheWholeTablePositionsAreReachedInOneStepAsWell) {
  struct Case {
    Tick t;
    Value position;
  };
  const std::vector<Case> cases = {{1, 0},         {10, 10},       {25, 66},       {50, 266},
                                   {51, 277},      {100, 800},     {1000, 10'400}, {1525, 16'000},
                                   {3000, 31'733}, {3025, 31'933}, {3049, 31'999}, {3050, 32'000}};
  for (const auto& [t, position] : cases) {
    ReadySimple2 feeder;
    feeder.set_move('B', 32'000, 200, 5, 5);
    feeder.set("Baxis_Move_INC", 1);  // after tick 10: t = 0 in tick 11
    feeder.run_to(11 + t);
    EXPECT_EQ(feeder.coordinate('B'), position) << t << " ms";
  }
}

TEST(MoveTiming, CommandsAtEitherEndOfOneTickStartTogether) {
  for (const std::int64_t microseconds : {10'000, 10'001, 10'999}) {
    ReadySimple2 feeder;
    feeder.set_move('A', 32'000, 200, 5, 5);
    feeder.world().advance_to(std::chrono::microseconds(microseconds));
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run_to(11 + 25);
    EXPECT_EQ(feeder.coordinate('A'), 66) << microseconds;
    feeder.run_to(11 + 3049);
    EXPECT_TRUE(feeder.moving('A')) << microseconds;
    feeder.run_to(11 + 3050);
    EXPECT_FALSE(feeder.moving('A')) << microseconds;
  }
}

TEST(MoveTiming, TakesTheTimeOfTheConsistentFormula) {
  struct Case {
    Value pulses, speed, acc, dec, resolution;
    Tick ticks;  // ceil(TT), by hand: TA/2 + TD/2 + P/V, or TA + TD where that is shorter
  };
  const std::vector<Case> cases = {
      {32'000, 200, 5, 5, 3200, 3050},
      {1600, 200, 5, 5, 3200, 200},
      {533, 200, 5, 5, 3200, 100},
      {100, 200, 5, 5, 3200, 100},
      {3200, 3000, 1500, 1500, 3200, 30'000},
      {6400, 600, 20, 50, 3200, 700},
      {-6400, 600, 20, 50, 3200, 700},
      {1, 200, 0, 0, 3200, 20},           // times of 0 count as 10 ms
      {1, 200, 1, 1, 3200, 20},           // the same
      {1000, 20, 0, 7, 3000, 1040},       // 1000/1 + (10 + 70)/2
      {100'000, 1875, 1, 1, 3200, 1010},  // 100 kHz exactly
      {100'000, 1876, 1, 1, 3200, 1010},  // capped there
      {100'000, 32'768, 1, 1, 3200, 1010},
      {100'000, 1874, 1, 1, 3200, 1011},  // 99946.67 Hz: 1000.53 + 10
      {100'000, 1, 1, 1, 2'147'483'648, 1010},
      {7, 1, 1, 1, 60'000, 20},  // 1 pulse/ms, and 10 pulses fill the ramps: a triangle
      {7, 1, 1, 1, 30'000, 24},  // 0.5 pulses/ms: 14 + 10
  };
  for (const Case& c : cases) {
    ReadySimple2 feeder;
    feeder.set("Aaxis_Resoultion", c.resolution);
    feeder.set_move('A', c.pulses, c.speed, c.acc, c.dec);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run_to(11);  // t = 0
    EXPECT_EQ(feeder.run_while_moving('A'), c.ticks) << c.pulses << " at " << c.speed;
    EXPECT_EQ(feeder.coordinate('A'), c.pulses);
  }
}

TEST(MoveTiming, AboveTheCapPulsesComeAt100KilohertzAtMost) {
  ReadySimple2 feeder;
  feeder.set_move('A', 10'000, 3000, 1, 1);
  feeder.set("Aaxis_Move_INC", 1);
  Value max = 0;
  for (int i = 0; i < 200; ++i) {
    const Value before = feeder.coordinate('A');
    feeder.run(1);
    max = std::max(max, feeder.coordinate('A') - before);
  }
  EXPECT_EQ(max, 100);
  EXPECT_EQ(feeder.coordinate('A'), 10'000);
}

TEST(MoveTiming, SpeedTimesAndResolutionAreLatchedAtTheStart) {
  ReadySimple2 feeder;
  feeder.set_move('A', 32'000, 200, 5, 5);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run_to(11 + 500);
  feeder.set_move('A', 5, 3000, 3000, 3000);
  feeder.set("Aaxis_Resoultion", 10);
  feeder.run_to(11 + 1000);
  EXPECT_EQ(feeder.coordinate('A'), 10'400);
  feeder.run_to(11 + 3049);
  EXPECT_TRUE(feeder.moving('A'));
  feeder.run_to(11 + 3050);
  EXPECT_FALSE(feeder.moving('A'));
  EXPECT_EQ(feeder.coordinate('A'), 32'000);
}

TEST(MoveTiming, OneRequestSetsTheMoveAndStartsItWithTheNewValues) {
  ReadySimple2 feeder;
  feeder.write(0x1000, {32'000, 0, 200, 5, 5, 1});
  feeder.run_to(11 + 1000);
  EXPECT_EQ(feeder.coordinate('A'), 10'400);
}

TEST(MoveTiming, TriggersOfOneRequestActInAscendingOrder) {
  ReadySimple2 feeder;
  feeder.set_move('A', 32'000, 200, 5, 5);
  // Move_INC (0x1005) ... Aaxis_STOP (0x100E): started, then stopped.
  feeder.write(0x1005, {1, 0, 0, 0, 0, 0, 0, 0, 0, 1});
  EXPECT_FALSE(feeder.moving('A'));
  feeder.run(100);
  EXPECT_EQ(feeder.coordinate('A'), 0);
  // Aaxis_SVON (0x1014) comes after Move_INC: while it is off, the move is dropped.
  feeder.set("Aaxis_SVON", 0);
  feeder.write(0x1005, {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1});
  EXPECT_TRUE(feeder.bit("Aaxis_SVON"));
  EXPECT_FALSE(feeder.moving('A'));
}

TEST(MoveTiming, AHalfWrittenResolutionOfZeroCountsAsOne) {
  ReadySimple2 feeder;
  feeder.set("Aaxis_Resoultion_L", 0);  // 3200 is all in the low half
  EXPECT_EQ(feeder.get("Aaxis_Resoultion"), 0);
  feeder.set_move('A', 10, 200, 1, 1);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run_to(11);
  EXPECT_EQ(feeder.run_while_moving('A'), 3010);  // 10 / (200/60) + 0.01 s
  EXPECT_EQ(feeder.coordinate('A'), 10);
}

TEST(MoveTiming, AHalfWrittenExcessiveResolutionCountsAsTheMaximum) {
  ReadySimple2 feeder;
  feeder.set("Aaxis_Resoultion_H", 0xFFFF);
  EXPECT_EQ(feeder.get("Aaxis_Resoultion"), 0xFFFF'0C80);
  feeder.set_move('A', 1000, 1, 1, 1);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run_to(11);
  EXPECT_EQ(feeder.run_while_moving('A'), 20);  // 100 kHz: 1000 pulses fill the ramps
  EXPECT_EQ(feeder.try_set("Aaxis_Resoultion", 0), Refusal::bad_value);
  EXPECT_EQ(feeder.try_set("Aaxis_Resoultion", 0x8000'0001), Refusal::bad_value);
}

}  // namespace move_timing_test
}  // namespace understudy::emulator::models::simple2_r3
