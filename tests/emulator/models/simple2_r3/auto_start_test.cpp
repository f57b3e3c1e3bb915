// AutoStart_MainProg: the program begins at line 0 after each power-up, in the first possible slot (slots are
// at even ticks; manual: 系統參數相關).
#include "tests/emulator/models/simple2_r3/switched_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace auto_start_test {

/// Out 3 ON; Counter_Increase 1; Delay 10 ms; Out 4 ON; Wait_IO DIN 0 ON; Jump to line 1
const std::vector<std::uint16_t> kProgram{0x05, 3, 1, 0, 0x51, 1, 0, 1, 0x02, 10, 0, 0,
                                          0x05, 4, 1, 0, 0x01, 0, 1, 0, 0x03, 1,  0, 0};

void prepare(Switched& feeder, Value auto_start) {
  feeder.run_to(10);  // what a bench sets with the power counts at once
  feeder.write(0x4000, kProgram);
  feeder.set("AutoStart_MainProg", auto_start);
  feeder.run_to(1000);
}

TEST(AutoStart, BeginsAtLine0InTheFirstSlotAfterEachPowerUp) {
  Switched feeder;
  prepare(feeder, 1);
  EXPECT_FALSE(feeder.bit("PROG_MAIN_RunTime_Status")) << "it is read at power-up";
  for (const Tick power_up : {2000, 3001, 4002, 5003}) {
    feeder.run_to(power_up - 5);
    feeder.power(false);
    feeder.run_to(power_up);
    feeder.power(true);
    EXPECT_FALSE(feeder.bit("PROG_MAIN_RunTime_Status")) << power_up;
    // Out 3 in the slot of tick s, Counter_Increase in s + 2, Delay from s + 4, Out 4 in s + 14.
    const Tick slot = power_up % 2 == 0 ? power_up + 2 : power_up + 1;
    for (Tick tick = power_up + 1; tick <= slot + 30; ++tick) {
      feeder.run_to(tick);
      ASSERT_TRUE(feeder.bit("PROG_MAIN_RunTime_Status")) << tick;
      ASSERT_EQ(feeder.bit("DOUT_3"), tick >= slot) << tick;
      ASSERT_EQ(feeder.get("Counter1_Value"), tick >= slot + 2) << tick;
      ASSERT_EQ(feeder.bit("DOUT_4"), tick >= slot + 14) << tick;
    }
    EXPECT_EQ(feeder.get("PROG_MAIN_NowLine"), 4)
        << "it waits there, and the next power-up starts at 0 again";
  }
}

TEST(AutoStart, IsOffFromTheFactoryAndAt0) {
  Switched feeder;
  prepare(feeder, 0);
  feeder.cycle();
  feeder.run(100);
  EXPECT_FALSE(feeder.bit("PROG_MAIN_RunTime_Status"));
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0);
}

TEST(AutoStart, WrittenTooShortlyBeforeThePowerGoesIsLost) {
  Switched feeder;
  feeder.write(0x4000, kProgram);
  feeder.run_to(1000);
  feeder.set("AutoStart_MainProg", 1);
  feeder.run_to(1005);  // it would be kept in tick 1006
  feeder.cycle();
  feeder.run(10);
  EXPECT_EQ(feeder.get("AutoStart_MainProg"), 0);
  EXPECT_FALSE(feeder.bit("PROG_MAIN_RunTime_Status"));
}

/// The EEPROM continues while the device boots: eight words take 40 ms, and the boot lasts for a second.
TEST(AutoStart, WhatIsWrittenWhileTheDeviceBootsIsKept) {
  Switched feeder({.choices = {{"boot_time", "1s"}}, .set = {{"AutoStart_MainProg", 1}}});
  feeder.write(0x4000, {0x05, 4, 1, 0, 0xFF, 0, 0, 0});  // Out 4 ON; END
  EXPECT_TRUE(feeder.bit("EEPROM_Writing"));
  feeder.run_to(600);
  EXPECT_FALSE(feeder.bit("EEPROM_Writing"));
  feeder.cycle();
  feeder.run(2000);
  EXPECT_TRUE(feeder.bit("DOUT_4"));
}

TEST(AutoStart, SetToZeroWhileItRunsCountsForTheNextPowerUp) {
  Switched feeder;
  prepare(feeder, 1);
  feeder.cycle();
  feeder.run(100);
  feeder.set("AutoStart_MainProg", 0);
  feeder.run(100);
  EXPECT_TRUE(feeder.bit("PROG_MAIN_RunTime_Status"));
  feeder.cycle();
  feeder.run(100);
  EXPECT_FALSE(feeder.bit("PROG_MAIN_RunTime_Status"));
}

TEST(AutoStart, BeginsThoughThousandsOfQuietTicksWereSkipped) {
  Switched feeder;
  prepare(feeder, 1);
  feeder.power(false);
  feeder.run(1'000'000);
  const std::uint64_t ticks = feeder.world().ticks_run();
  feeder.power(true);
  EXPECT_EQ(feeder.world().next_due(), time_of(feeder.now() + 1));
  feeder.run(100'000);
  EXPECT_TRUE(feeder.bit("DOUT_4"));
  EXPECT_LT(feeder.world().ticks_run() - ticks, 100'000u);
}

TEST(AutoStart, OfAnEmptyProgramRunsThroughItsLinesAndEnds) {
  Switched feeder;
  feeder.set("AutoStart_MainProg", 1);
  feeder.run_to(100);
  feeder.cycle();
  feeder.run_to(102 + 2 * 255);  // line n in tick 102 + 2 n
  EXPECT_EQ(feeder.get("PROG_MAIN_NowLine"), 255);
  feeder.run(2);
  EXPECT_FALSE(feeder.bit("PROG_MAIN_RunTime_Status"));
}

}  // namespace auto_start_test
}  // namespace understudy::emulator::models::simple2_r3
