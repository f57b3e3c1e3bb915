// Coordinates, directions and encoders (manual: 編碼器，座標，類比輸入相關, and the note 1.40 以前).
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace coordinate_test {

TEST(Coordinate, IsZeroAtPowerUpAndTakesAnyPreset) {
  OneSimple2 feeder;
  EXPECT_EQ(feeder.coordinate('A'), 0);
  for (const Value value : {Value{1}, Value{-1}, Value{INT32_MAX}, Value{INT32_MIN}, Value{0}}) {
    feeder.set("Cord_A", value);
    feeder.set("Cord_B", -1 - value);
    EXPECT_EQ(feeder.coordinate('A'), value);
    EXPECT_EQ(feeder.coordinate('B'), -1 - value);
  }
  feeder.set("Cord_A", 0x0001'0002);
  feeder.set("Cord_A_L", 7);
  EXPECT_EQ(feeder.coordinate('A'), 0x0001'0007);
  feeder.set("Cord_A_H", 0xFFFF);
  EXPECT_EQ(feeder.coordinate('A'), -0x1'0000 + 7);
}

TEST(Coordinate, WrapsAt32BitsInBothDirections) {
  struct Case {
    Value start, pulses, end;
  };
  for (const auto& [start, pulses, end] : std::vector<Case>{{INT32_MAX, 1, INT32_MIN},
                                                            {INT32_MIN, -1, INT32_MAX},
                                                            {INT32_MAX - 10, 100, Value{INT32_MIN} + 89},
                                                            {INT32_MIN + 10, -100, Value{INT32_MAX} - 89}}) {
    ReadySimple2 feeder;
    feeder.set_one_pulse_a_tick('A', pulses);
    feeder.set("Cord_A", start);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(200);
    EXPECT_EQ(feeder.coordinate('A'), end);
  }
}

TEST(Coordinate, PresetDuringAnAbsoluteMoveKeepsTheRemainingPulses) {
  ReadySimple2 feeder;
  feeder.set_one_pulse_a_tick('A', 1000);
  feeder.set("Aaxis_Move_ABS", 1);
  feeder.run_to(11 + 405);
  ASSERT_EQ(feeder.coordinate('A'), 400);
  feeder.set("Cord_A", -50'000);
  feeder.run_to(11 + 1010);
  EXPECT_FALSE(feeder.moving('A'));
  EXPECT_EQ(feeder.coordinate('A'), -50'000 + 600);
}

TEST(Coordinate, AnAbsoluteTargetMayBeTwiceTheCoordinateRangeAway) {
  struct Case {
    Value start, target;
    int sign;
  };
  // 100 pulses per millisecond: 2^32 - 1 of them take half a day, so only the beginning is checked.
  for (const auto& [start, target, sign] :
       {Case{INT32_MIN, INT32_MAX, +1}, Case{INT32_MAX, INT32_MIN, -1}, Case{-2, INT32_MAX, +1}}) {
    ReadySimple2 feeder;
    feeder.set_move('A', target, 1875, 100, 100);
    feeder.set("Cord_A", start);
    feeder.set("Aaxis_Move_ABS", 1);
    feeder.run_to(11 + 2000);
    EXPECT_TRUE(feeder.moving('A'));
    EXPECT_EQ(feeder.coordinate('A'), start + sign * 150'000) << start;  // 100 * (2000 - 500)
  }
}

TEST(Coordinate, AnIncrementOfTheLowest32BitsGoesDown) {
  ReadySimple2 feeder;
  feeder.set_move('A', INT32_MIN, 1875, 100, 100);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run_to(11 + 2000);
  EXPECT_TRUE(feeder.moving('A'));
  EXPECT_EQ(feeder.coordinate('A'), -150'000);
}

TEST(DirectionPolarity, From141OnTurnsTheMotorOnly) {
  for (const Firmware firmware : {141, 142, 150, 151, 152}) {
    for (const char axis : {'A', 'B'}) {
      ReadySimple2 feeder({.firmware = firmware});
      const int number = axis == 'A' ? 0 : 1;
      feeder.set(feeder.name(axis, "DIR_Polarity"), 1);
      feeder.set_one_pulse_a_tick(axis, 1000);
      feeder.set(feeder.name(axis, "Move_INC"), 1);
      feeder.run(1100);
      EXPECT_EQ(feeder.coordinate(axis), 1000) << firmware;
      EXPECT_EQ(feeder.world().plant(0, number).position_pulses(), -1000) << firmware;
      feeder.set(feeder.name(axis, "Pulse"), 400);
      feeder.set(feeder.name(axis, "Move_ABS"), 1);
      feeder.run(700);
      EXPECT_EQ(feeder.coordinate(axis), 400) << firmware;
      EXPECT_EQ(feeder.world().plant(0, number).position_pulses(), -400) << firmware;
    }
  }
}

TEST(DirectionPolarity, Until140CountsTheMotorsSenseSoAbsoluteMovesDiverge) {
  for (const Firmware firmware : {139, 140}) {
    ReadySimple2 feeder({.firmware = firmware});
    feeder.set("Aaxis_DIR_Polarity", 1);
    feeder.set_one_pulse_a_tick('A', 1000);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(1100);
    EXPECT_EQ(feeder.coordinate('A'), -1000) << firmware;
    EXPECT_EQ(feeder.world().plant(0, 0).position_pulses(), -1000) << firmware;
    feeder.set("Aaxis_Move_ABS", 1);  // +2000 commanded
    feeder.run(2100);
    EXPECT_EQ(feeder.coordinate('A'), -3000) << firmware;
    feeder.set("Aaxis_Move_ABS", 1);  // +4000 commanded
    feeder.run(4100);
    EXPECT_EQ(feeder.coordinate('A'), -7000) << firmware;
    EXPECT_EQ(feeder.world().plant(0, 0).position_pulses(), -7000) << firmware;
  }
}

TEST(DirectionPolarity, OfZeroIsTheSameForEveryFirmware) {
  for (const Firmware firmware : {139, 140, 141, 142, 150, 151, 152}) {
    ReadySimple2 feeder({.firmware = firmware});
    feeder.set_one_pulse_a_tick('A', 1000);
    feeder.set("Aaxis_Move_ABS", 1);
    feeder.run(1100);
    EXPECT_EQ(feeder.coordinate('A'), 1000) << firmware;
    EXPECT_EQ(feeder.world().plant(0, 0).position_pulses(), 1000) << firmware;
  }
}

world::PlantSetup with_encoder(int per_revolution) {
  world::PlantSetup plant;
  plant.encoder_counts_per_revolution = per_revolution;
  plant.pulses_per_revolution = 3200;
  return plant;
}

TEST(Encoder, FollowsThePlantOnItsOwnAxis) {
  ReadySimple2 feeder({.plant = {{0, with_encoder(4000)}, {1, with_encoder(800)}}});
  for (const char axis : {'A', 'B'}) feeder.set_one_pulse_a_tick(axis, 1000);
  feeder.set("Baxis_Pulse", -1000);
  feeder.set("ALL_Move_INC", 1);
  feeder.run_to(11 + 505);
  EXPECT_EQ(feeder.get("ENCA"), 625);   // 500 * 4000 / 3200, in the tick of the pulse
  EXPECT_EQ(feeder.get("ENCB"), -125);  // -500 * 800 / 3200
  feeder.run(1000);
  EXPECT_EQ(feeder.get("ENCA"), 1250);
  EXPECT_EQ(feeder.get("ENCB"), -250);
}

TEST(Encoder, CountsWhatThePlantTurnsNotWhatTheCoordinateSays) {
  world::PlantSetup stuck = with_encoder(3200);
  stuck.travel = world::PulseSpan{-10, 300};
  ReadySimple2 feeder({.plant = {{0, stuck}}});
  feeder.set_one_pulse_a_tick('A', 1000);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(1100);
  EXPECT_EQ(feeder.coordinate('A'), 1000);
  EXPECT_EQ(feeder.get("ENCA"), 300);
  feeder.set("Cord_A", 0);
  EXPECT_EQ(feeder.get("ENCA"), 300);
}

TEST(Encoder, AWriteSetsTheCountAndItContinuesFromThere) {
  ReadySimple2 feeder({.plant = {{0, with_encoder(3200)}}});
  feeder.set_one_pulse_a_tick('A', 100);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(200);
  for (const Value preset : {Value{-7}, Value{0}, Value{123'456}, Value{INT32_MIN}}) {
    feeder.set("ENCA", preset);
    EXPECT_EQ(feeder.get("ENCA"), preset);
    feeder.set("Aaxis_Move_INC", 1);
    feeder.run(200);
    EXPECT_EQ(feeder.get("ENCA"), preset + 100);
  }
  feeder.set("ENCA", INT32_MAX);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(200);
  EXPECT_EQ(feeder.get("ENCA"), Value{INT32_MIN} + 99);
  EXPECT_EQ(feeder.get("ENCB"), 0);
}

TEST(Encoder, PolarityTurnsTheSenseOfCounting) {
  ReadySimple2 feeder({.plant = {{0, with_encoder(3200)}, {1, with_encoder(3200)}}});
  feeder.set("Axis_ENC_Polarity", 1);
  for (const char axis : {'A', 'B'}) feeder.set_one_pulse_a_tick(axis, 100);
  feeder.set("ALL_Move_INC", 1);
  feeder.run(200);
  EXPECT_EQ(feeder.get("ENCA"), -100);
  EXPECT_EQ(feeder.get("ENCB"), 100);
  feeder.set("ENCA", 500);
  EXPECT_EQ(feeder.get("ENCA"), 500);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(200);
  EXPECT_EQ(feeder.get("ENCA"), 400);
}

TEST(Encoder, DirectionPolarityReachesTheEncoderThroughTheMotor) {
  ReadySimple2 feeder({.plant = {{0, with_encoder(3200)}}});
  feeder.set("Aaxis_DIR_Polarity", 1);
  feeder.set_one_pulse_a_tick('A', 100);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(200);
  EXPECT_EQ(feeder.coordinate('A'), 100);
  EXPECT_EQ(feeder.get("ENCA"), -100);
}

TEST(Encoder, WithoutOneReadsZeroAndKeepsAPreset) {
  ReadySimple2 feeder;
  feeder.set_one_pulse_a_tick('A', 100);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(200);
  EXPECT_EQ(feeder.get("ENCA"), 0);
  feeder.set("ENCA", 5);
  feeder.run(200);
  EXPECT_EQ(feeder.get("ENCA"), 5);
}

}  // namespace coordinate_test
}  // namespace understudy::emulator::models::simple2_r3
