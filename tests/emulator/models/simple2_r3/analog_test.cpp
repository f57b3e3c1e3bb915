// Analog inputs: ADC_A and ADC_B have 12 bits, 400 a volt; Analog_A and Analog_B are the line through the two
// points of the calibration, 200 at 1 V and 2000 at 10 V (choices adc_width, analog_scaling).
#include "tests/emulator/models/simple2_r3/switched_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace analog_test {

struct Measuring : Switched {
  using Switched::Switched;
  void voltage(const char* input, std::int32_t millivolts) {
    world().set_external_input(0, find_terminal(model(), input), millivolts);
  }
  /// Sets the input and lets a tick look at it.
  void apply(std::int32_t millivolts) {
    voltage("AIN_A", millivolts);
    run(1);
  }
};

struct Point {
  std::int32_t millivolts;
  Value adc, analog;
};

TEST(Analog, IsExactAtTheScalesPointsWithTheFactorysCalibration) {
  // 0 V to 10 V is 0 to 2000 (manual: 編碼器，座標，類比輸入相關): 200 a volt.
  Measuring feeder;
  for (std::int32_t volts = 0; volts <= 10; ++volts) {
    feeder.apply(1000 * volts);
    EXPECT_EQ(feeder.get("ADC_A"), 400 * volts) << volts;
    EXPECT_EQ(feeder.get("Analog_A"), 200 * volts) << volts;
  }
}

TEST(Analog, TheConverterRoundsDownAndTheScaleTowardsOneVolt) {
  // The converter's step is 2.5 mV. Analog = 200 + (ADC - 400) / 2, towards 200.
  const Point points[] = {
      {1, 0, 0},         // 0.4; 200 - 200
      {2, 0, 0},         //
      {3, 1, 1},         // 1.2; 200 - 399 / 2 = 200 - 199
      {5, 2, 1},         // 200 - 199
      {997, 398, 199},   // 398.8; 200 - 1
      {998, 399, 200},   // 399.2; 200 - 0
      {1002, 400, 200},  // 400.8
      {1003, 401, 200},  // 401.2; 200 + 0
      {1005, 402, 201},  //
      {5003, 2001, 1000}, {9997, 3998, 1999}, {9999, 3999, 1999},
  };
  Measuring feeder;
  for (const Point& p : points) {
    feeder.apply(p.millivolts);
    EXPECT_EQ(feeder.get("ADC_A"), p.adc) << p.millivolts << " mV";
    EXPECT_EQ(feeder.get("Analog_A"), p.analog) << p.millivolts << " mV";
  }
}

TEST(Analog, BeyondTenVoltsContinuesUntilTheConverterIsFull) {
  const Point points[] = {
      {10'005, 4002, 2001}, {10'200, 4080, 2040},
      {10'237, 4094, 2047}, {10'238, 4095, 2047},  // 4095.2; 200 + 3695 / 2
      {10'240, 4095, 2047}, {12'000, 4095, 2047},
  };
  Measuring feeder;
  for (const Point& p : points) {
    feeder.apply(p.millivolts);
    EXPECT_EQ(feeder.get("ADC_A"), p.adc) << p.millivolts << " mV";
    EXPECT_EQ(feeder.get("Analog_A"), p.analog) << p.millivolts << " mV";
  }
}

TEST(Analog, HasTwoInputsThatDoNotTouchEachOther) {
  Measuring feeder;
  feeder.voltage("AIN_A", 2500);
  feeder.voltage("AIN_B", 7500);
  feeder.run(1);
  EXPECT_EQ(feeder.get("ADC_A"), 1000);
  EXPECT_EQ(feeder.get("ADC_B"), 3000);
  EXPECT_EQ(feeder.get("Analog_A"), 500);
  EXPECT_EQ(feeder.get("Analog_B"), 1500);
  feeder.set("ADC_10V_B", 2000);
  feeder.set("ADC_1V_B", 200);
  EXPECT_EQ(feeder.get("Analog_A"), 500);
  EXPECT_EQ(feeder.get("Analog_B"), 3000) << "200 + 2800 * 1800 / 1800";
}

struct Calibrated {
  Value at_10v, at_1v;
  std::int32_t millivolts;
  Value analog;  // 200 + (ADC - at_1v) * 1800 / (at_10v - at_1v), within 0 to 65535
};

TEST(Analog, FollowsItsCalibration) {
  const Calibrated cases[] = {
      {4000, 400, 5000, 1000},
      {3600, 400, 3600, 785},   // 1440: 200 + 1040 * 1800 / 3200
      {4000, 1000, 2500, 200},  // on the point itself
      {4000, 1000, 10'000, 2000},
      {4000, 1000, 0, 0},        // 200 - 600, which is below 0
      {4000, 1000, 1700, 8},     // 680: 200 - 192
      {4000, 1000, 1660, 0},     // 664: 200 - 201.6
      {400, 4000, 10'000, 200},  // the points exchanged: a line that falls
      {400, 4000, 1000, 2000},
      {400, 4000, 5000, 1200},  // 2000: 200 + 2000 * 1800 / 3600
      {2000, 2000, 5000, 0},    // both points one: there is no line
      {0, 0, 0, 0},
      {2001, 2000, 5000, 200},       // steep, on the point
      {2001, 2000, 5003, 2000},      // 2001
      {2001, 2000, 4998, 0},         // 1999: 200 - 1800
      {2001, 2000, 10'000, 65'535},  // 200 + 2000 * 1800 is beyond 16 bits
      {65'535, 0, 10'000, 309},      // 200 + 4000 * 1800 / 65535 = 200 + 109.8
      {0, 65'535, 0, 2000},          // 200 + 65535 * 1800 / 65535
      {65'535, 65'534, 0, 0},        // far below
      {65'534, 65'535, 0, 65'535},   // far above
  };
  for (const Calibrated& c : cases) {
    Measuring feeder;
    feeder.set("ADC_10V_A", c.at_10v);
    feeder.set("ADC_1V_A", c.at_1v);
    feeder.apply(c.millivolts);
    EXPECT_EQ(feeder.get("Analog_A"), c.analog)
        << c.at_10v << " " << c.at_1v << " at " << c.millivolts << " mV";
  }
}

TEST(Analog, ARealCalibrationMakesACrookedInputRight) {
  // An amplifier that gives 0.3 V too much and 5 % too little gain: what a technician does with a voltmeter.
  const auto crooked = [](std::int32_t millivolts) { return 300 + millivolts * 95 / 100; };
  Measuring feeder;
  feeder.apply(crooked(1000));
  feeder.set("ADC_1V_A", feeder.get("ADC_A"));
  feeder.apply(crooked(10'000));
  feeder.set("ADC_10V_A", feeder.get("ADC_A"));
  for (std::int32_t millivolts = 0; millivolts <= 10'000; millivolts += 50) {
    feeder.apply(crooked(millivolts));
    EXPECT_NEAR(static_cast<double>(feeder.get("Analog_A")), millivolts / 5.0, 1.5) << millivolts;
  }
}

TEST(Analog, TakesEffectOfACalibrationAtOnce) {
  Measuring feeder;
  feeder.apply(5000);
  feeder.set("ADC_10V_A", 2000);
  EXPECT_EQ(feeder.get("Analog_A"), 2000) << "without a tick: the measured value is interpreted anew";
}

TEST(Analog, CalibrationOutlivesThePowerAndTheFactorysReset) {
  Measuring feeder;
  const std::vector<std::pair<const char*, Value>> calibration = {
      {"ADC_10V_A", 3901}, {"ADC_10V_B", 3902}, {"ADC_1V_A", 391}, {"ADC_1V_B", 392}};
  for (const auto& [name, value] : calibration) feeder.set(name, value);
  feeder.run(100);
  feeder.cycle();
  for (const auto& [name, value] : calibration) EXPECT_EQ(feeder.get(name), value) << name;
  feeder.set("Factory_Reset", 1);
  for (const auto& [name, value] : calibration) EXPECT_EQ(feeder.get(name), value) << name;
  feeder.run(1000);
  feeder.cycle();
  for (const auto& [name, value] : calibration) EXPECT_EQ(feeder.get(name), value) << name;
}

TEST(Analog, AFactoryResetKeepsCalibrationWrittenJustBefore) {
  Measuring feeder;
  feeder.set("ADC_1V_A", 391);
  feeder.set("Factory_Reset", 1);
  feeder.run(501);
  feeder.cycle();
  EXPECT_EQ(feeder.get("ADC_1V_A"), 391);
}

// --- by tick ---------------------------------------------------------------------------------------------

TEST(Analog, IsLookedAtOnceATick) {
  Measuring feeder;
  feeder.run_to(10);
  feeder.voltage("AIN_A", 5000);
  EXPECT_EQ(feeder.get("Analog_A"), 0) << "the value that the previous tick read";
  feeder.world().advance_to(time_of(11) - SimTime{1});
  EXPECT_EQ(feeder.get("Analog_A"), 0);
  feeder.run_to(11);
  EXPECT_EQ(feeder.get("Analog_A"), 1000);
}

TEST(Analog, AQuietDeviceNoticesAChangeAndNothingElse) {
  Measuring feeder;
  feeder.apply(5000);
  feeder.run(1000);
  EXPECT_EQ(feeder.world().next_due(), std::nullopt);
  const std::uint64_t ticks = feeder.world().ticks_run();
  feeder.voltage("AIN_A", 5001);  // within the same step of the converter
  EXPECT_EQ(feeder.world().next_due(), std::nullopt);
  feeder.voltage("AIN_A", 5003);
  EXPECT_EQ(feeder.world().next_due(), time_of(feeder.now() + 1));
  feeder.run(1000);
  EXPECT_EQ(feeder.get("ADC_A"), 2001);
  EXPECT_EQ(feeder.world().ticks_run(), ticks + 1);
}

TEST(Analog, SteersAProgram) {
  // VAR_DirectGT 156, 100: above 0.5 V Out 1, else skip; Jump. Looked at every three slots at most.
  Measuring feeder;
  feeder.write(0x4000, {0x91, 156, 100, 1, 0x05, 1, 1, 0, 0x03, 1, 0, 0});
  feeder.set("PROG_MAIN_RunTime_START", 0);
  feeder.apply(500);  // 100: not above it
  feeder.run(100);
  EXPECT_FALSE(feeder.bit("DOUT_1"));
  feeder.apply(505);
  feeder.run(6);
  EXPECT_TRUE(feeder.bit("DOUT_1"));
}

TEST(Analog, ComesBackWithThePower) {
  Measuring feeder;
  feeder.apply(5000);
  feeder.power(false);
  feeder.voltage("AIN_A", 7000);
  feeder.run(10);
  feeder.power(true);
  feeder.run(1);
  EXPECT_EQ(feeder.get("Analog_A"), 1400);
}

}  // namespace analog_test
}  // namespace understudy::emulator::models::simple2_r3
