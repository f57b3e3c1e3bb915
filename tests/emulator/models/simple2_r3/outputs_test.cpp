// Outputs, and the functions that may take them over (manual: 輸入輸出功能指配相關, 輸入輸出相關).
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace outputs_test {

TEST(Outputs, AreDrivenAtOnceOneByOneAndTogether) {
  OneSimple2 feeder;
  for (int i = 0; i < 7; ++i) {
    feeder.set("DOUT_" + std::to_string(i), 1);
    EXPECT_EQ(feeder.get("DOUT_ALL"), 1 << i);
    for (int n = 0; n < 7; ++n) {
      EXPECT_EQ(feeder.output(n), n == i);
      EXPECT_EQ(feeder.get("DOUT_" + std::to_string(n)), n == i);
    }
    feeder.set("DOUT_" + std::to_string(i), 0);
    EXPECT_EQ(feeder.get("DOUT_ALL"), 0);
  }
  for (const int levels : {0x7F, 0x55, 0x2A, 0x01, 0x40, 0x00}) {
    feeder.set("DOUT_ALL", levels);
    EXPECT_EQ(feeder.get("DOUT_ALL"), levels);
    for (int n = 0; n < 7; ++n) EXPECT_EQ(feeder.output(n), ((levels >> n) & 1) != 0) << levels << " " << n;
  }
  EXPECT_EQ(feeder.try_set("DOUT_ALL", 0x80), Refusal::bad_value);
  EXPECT_EQ(feeder.try_set("DOUT_3", 2), Refusal::bad_value);
}

TEST(Outputs, AServoOutputIsOnWhenTheServoAgreesWithItsPolarity) {
  for (const bool is_a : {true, false}) {
    const int pin = is_a ? 0 : 2;
    for (const Value polarity : {0, 1}) {
      for (const Value servo : {0, 1}) {
        OneSimple2 feeder;
        feeder.set(is_a ? "DOUT0_Aaxis_SVON" : "DOUT2_Baxis_SVON", 1);
        feeder.set(is_a ? "Aaxis_SVON_Polarity" : "Baxis_SVON_Polarity", polarity);
        feeder.set(is_a ? "Aaxis_SVON" : "Baxis_SVON", servo);
        const bool on = servo == polarity;
        EXPECT_EQ(feeder.output(pin), on) << pin << polarity << servo;
        EXPECT_EQ(feeder.get("DOUT_ALL"), on ? 1 << pin : 0) << pin << polarity << servo;
        feeder.set(is_a ? "Aaxis_SVON_Polarity" : "Baxis_SVON_Polarity", 1 - polarity);  // re-drives the pin
        EXPECT_EQ(feeder.output(pin), !on) << pin << polarity << servo;
      }
    }
  }
}

TEST(Outputs, WithoutAssignmentTheServoDrivesNoPin) {
  OneSimple2 feeder;
  feeder.set("ALL_SVON", 1);
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0);
  feeder.set("ALL_SVON", 0);
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0);
}

TEST(Outputs, AnAssignedPinRemembersWritesUntilItIsFree) {
  struct Case {
    int pin;
    std::string_view assignment;
  };
  // With the servos off and no ACLR, the special functions keep all four pins off.
  for (const auto& [pin, assignment] : {Case{0, "DOUT0_Aaxis_SVON"}, Case{1, "DOUT1_Aaxis_ACLR"},
                                        Case{2, "DOUT2_Baxis_SVON"}, Case{3, "DOUT3_Baxis_ACLR"}}) {
    OneSimple2 feeder;
    const std::string output = "DOUT_" + std::to_string(pin);
    feeder.set(assignment, 1);
    feeder.set(output, 1);
    EXPECT_FALSE(feeder.output(pin)) << pin;
    EXPECT_EQ(feeder.get(output), 0) << pin;
    feeder.run(100);
    feeder.set(assignment, 0);
    EXPECT_TRUE(feeder.output(pin)) << pin;
    EXPECT_EQ(feeder.get("DOUT_ALL"), 1 << pin) << pin;

    feeder.set(assignment, 1);
    EXPECT_FALSE(feeder.output(pin)) << pin;
    feeder.set("DOUT_ALL", 0x70);
    EXPECT_EQ(feeder.get("DOUT_ALL"), 0x70) << pin;
    feeder.set(assignment, 0);
    EXPECT_FALSE(feeder.output(pin)) << pin;
    EXPECT_EQ(feeder.get("DOUT_ALL"), 0x70) << pin;
  }
}

TEST(Outputs, AWriteToAllRemembersTheBitsOfAssignedPinsToo) {
  OneSimple2 feeder;
  feeder.set("DOUT0_Aaxis_SVON", 1);
  feeder.set("DOUT3_Baxis_ACLR", 1);
  feeder.set("DOUT_ALL", 0x7F);
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0x7F - 1 - 8);
  feeder.set("DOUT0_Aaxis_SVON", 0);
  feeder.set("DOUT3_Baxis_ACLR", 0);
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0x7F);
}

TEST(Outputs, OneRequestOverAllRegistersWritesThemAll) {
  OneSimple2 feeder;
  feeder.write(0x0D00, {1, 0, 1, 0, 1, 0, 1});
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0x55);
}

}  // namespace outputs_test
}  // namespace understudy::emulator::models::simple2_r3
