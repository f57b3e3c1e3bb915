// Programs that run on the device: started, stopped and watched through its registers.
#include "emulator/models/simple2_r3/device.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace running_program_test {

using Words = std::vector<std::uint16_t>;

// Three pulses of DOUT_0, 100 ms on and 100 ms off.
const Words kBlinker{0x05, 0,   1, 1, 0x02, 100, 0, 0, 0x05, 0, 0, 0,
                     0x02, 100, 0, 0, 0x04, 1,   3, 0, 0xFF, 0, 0, 0};

TEST(RunningProgram, BlinksAsWorkedOutByHand) {
  OneSimple2 feeder;
  feeder.write(0x4000, kBlinker);
  feeder.run_to(10);
  feeder.set("PROG_MAIN_RunTime_START", 0);
  EXPECT_EQ(feeder.get("PROG_MAIN_RunTime_Status"), 1);
  // The first slot is at 12 ms; on from slot 0 to 102, 206 to 308, 412 to 514; END at 618.
  for (Tick t = 12; t <= 640; ++t) {
    feeder.run_to(t);
    const Tick slot = t - 12;
    const bool on = slot < 102 || (slot >= 206 && slot < 308) || (slot >= 412 && slot < 514);
    ASSERT_EQ(feeder.bit("DOUT_0"), on) << slot;
    ASSERT_EQ(feeder.bit("PROG_MAIN_RunTime_Status"), slot < 618) << slot;
  }
  EXPECT_EQ(feeder.get("PROG_MAIN_NowLine"), 5);
}

TEST(RunningProgram, MovesAndWaitsForTheEnd) {
  ReadySimple2 feeder;
  // Move_Speed_A MEM0; Move_AccDec_A MEM1 MEM1; Move_INC_A_Wait MEM2; Cord_B MEM2; END
  feeder.write(0x4000, {0x22, 0, 0, 0, 0x23, 1, 1, 0, 0x25, 2, 0, 0, 0x75, 2, 0, 0, 0xFF, 0, 0, 0});
  feeder.set("PROG_MEM0", 200);
  feeder.set("PROG_MEM1", 5);
  feeder.set("PROG_MEM2", 1600);
  feeder.set("PROG_MAIN_RunTime_START", 0);
  feeder.run(100);
  EXPECT_TRUE(feeder.moving('A'));
  EXPECT_EQ(feeder.coordinate('B'), 0);
  feeder.run(200);  // TT is 200 ms
  EXPECT_EQ(feeder.coordinate('A'), 1600);
  EXPECT_EQ(feeder.coordinate('B'), 1600);
  EXPECT_EQ(feeder.get("PROG_MAIN_RunTime_Status"), 0);
  EXPECT_EQ(feeder.get("Aaxis_Speed"), 200);
}

TEST(RunningProgram, ReachesRegistersByParameterNumber) {
  OneSimple2 feeder;
  // VAR_Direct 144, -5 (Home_Speed: from 0); VAR_Direct VAR32, 7; VAR_Copy VAR32, 171 (Counter1);
  // VAR_Direct 156, 9 (read-only); VAR_Direct 160, 9 (not there); Timer_Start 1; END
  feeder.write(0x4000, {0x6F, 144, 0xFB, 0,   0x6F, 32, 7,    0, 0x62, 32, 171,  0, 0x6F, 156,
                        9,    0,   0x6F, 160, 9,    0,  0x55, 1, 0,    0,  0xFF, 0, 0,    0});
  feeder.set("Aaxis_Home_Speed", 3);
  feeder.set("PROG_MAIN_RunTime_START", 0);
  feeder.run(14);
  EXPECT_EQ(feeder.get("Aaxis_Home_Speed"), 0);
  EXPECT_EQ(feeder.get("PROG_VAR0"), 7);
  EXPECT_EQ(feeder.get("Counter1_Value"), 7);
  EXPECT_EQ(feeder.get("PROG_MAIN_RunTime_Status"), 0);
  const Value timer = feeder.get("Timer1_Value");
  feeder.run(1000);
  EXPECT_EQ(feeder.get("Timer1_Value"), timer + 1000);  // goes on after the program
  feeder.set("Timer1_Value", 4294967290);
  feeder.run(10);
  EXPECT_EQ(feeder.get("Timer1_Value"), 4);
}

TEST(RunningProgram, StopsByRegisterEraseAndFactoryReset) {
  for (const char* how : {"PROG_MAIN_RunTime_END", "PROG_MAIN_Erase_ALL", "Factory_Reset"}) {
    OneSimple2 feeder;
    feeder.write(0x4000, {0x03, 1, 0, 1});  // jumps to itself
    feeder.set("PROG_MAIN_RunTime_START", 0);
    feeder.run(1000);
    EXPECT_EQ(feeder.get("PROG_MAIN_RunTime_Status"), 1) << how;
    feeder.set(how, 1);
    EXPECT_EQ(feeder.get("PROG_MAIN_RunTime_Status"), 0) << how;
  }
}

TEST(RunningProgram, BeginsByItselfAtPowerUpIfToldSo) {
  OneSimple2 feeder({.set = {{"AutoStart_MainProg", 1}, {"MAIN_LINE0_CMD", 0x06}, {"MAIN_LINE0_DATA1", 1}}});
  feeder.run(4);
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0x7F);
}

TEST(RunningProgram, SkipsManyTicksAtOnceToTheSameState) {
  const auto begin = [](OneSimple2& feeder) {
    feeder.write(0x4000, kBlinker);
    feeder.set("PROG_MAIN_RunTime_START", 0);
  };
  OneSimple2 stepped;
  OneSimple2 leaping;
  begin(stepped);
  begin(leaping);
  for (Tick t = 1; t <= 2000; ++t) stepped.run_to(t);
  leaping.run_to(2000);
  EXPECT_TRUE(same_state(stepped.device(), leaping.device()));
}

}  // namespace running_program_test
}  // namespace understudy::emulator::models::simple2_r3
