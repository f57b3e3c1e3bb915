// Factory reset, the program's memory, and firmware versions (manual: 程式控制, 附錄 C).
#include "emulator/device/register_map/register_bank.h"
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace memory_test {

struct Written {
  std::string_view name;
  Value value, factory;
};
// One of each kind, and what it has from the factory.
const std::vector<Written> kPersistent = {
    {"DIN0_Aaxis_Alarm", 1, 0},
    {"DOUT3_Baxis_ACLR", 1, 0},
    {"ENCA_Resoultion", 77, 3200},
    {"Parms_Pulse1", -5, 0},
    {"Parms_Speed16", 9, 0},
    {"Parms_AccTime7", 3000, 0},
    {"Parms_mRPM16", -123'456, 0},
    {"MAIN_LINE0_CMD", 1, 0},
    {"MAIN_LINE255_JMP", 64, 0},
    {"PROG_MEM31", INT32_MIN, 0},
    {"Aaxis_Home_Speed", 60, 0},
    {"Baxis_Resoultion", 1, 3200},
    {"Aaxis_SVON_Polarity", 0, 1},
    {"Baxis_ALM_Polarity", 1, 0},
    {"Aaxis_DIR_Polarity", 1, 0},
    {"Axis_ENC_Polarity", 1, 0},
    {"Axis_VelMode_ACC", 32'768, 1000},
    {"AutoStart_MainProg", 1, 0},
    {"Axis_EncSync_NUM", 0, 1},
    {"Baxis_EncSync_DEN", 65'535, 1},
    {"Axis_SyncSlope", 255, 0},
    {"Baxis_SyncRPM", 1, 3000},
};
const std::vector<Written> kVolatile = {
    {"Aaxis_Pulse", 100, 0},    {"Baxis_Speed", 200, 0},
    {"Aaxis_AccTime", 5, 0},    {"PROG_VAR0", -1, 0},
    {"PROG_VAR31", 1, 0},       {"CalcREG", 42, 0},
    {"Counter1_Value", 3, 0},   {"Timer2_Value", 4'000'000'000, 0},
    {"Aaxis_DirectmRPM", 5, 0}, {"Baxis_DirectPWM", 100, 0},
};
const std::vector<Written> kCalibration = {
    {"ADC_10V_A", 3999, 4000}, {"ADC_10V_B", 4001, 4000}, {"ADC_1V_A", 399, 400}, {"ADC_1V_B", 401, 400}};

void write_all(OneSimple2& feeder, const std::vector<Written>& registers) {
  for (const Written& r : registers) {
    EXPECT_EQ(feeder.get(r.name), r.factory) << r.name;
    feeder.set(r.name, r.value);
    EXPECT_EQ(feeder.get(r.name), r.value) << r.name;
  }
}

TEST(FactoryReset, ResetsEverythingButTheCalibration) {
  OneSimple2 feeder;
  write_all(feeder, kPersistent);
  write_all(feeder, kVolatile);
  write_all(feeder, kCalibration);
  feeder.set("Factory_Reset", 0);
  EXPECT_EQ(feeder.get("Parms_Pulse1"), -5) << "0 does nothing";
  feeder.set("Factory_Reset", 1);
  for (const Written& r : kPersistent) EXPECT_EQ(feeder.get(r.name), r.factory) << r.name;
  for (const Written& r : kVolatile) EXPECT_EQ(feeder.get(r.name), r.factory) << r.name;
  for (const Written& r : kCalibration) EXPECT_EQ(feeder.get(r.name), r.value) << r.name;
  EXPECT_EQ(feeder.get("HW_Code"), 0xC001);
  EXPECT_EQ(feeder.get("Version"), 152);
}

TEST(FactoryReset, StopsTheAxesAndSwitchesTheServosOff) {
  ReadySimple2 feeder;
  feeder.set_one_pulse_a_tick('A', 1000);
  feeder.set_move('B', 1, 0, 0, 0);  // hangs
  feeder.set("ALL_Move_INC", 1);
  feeder.run_to(11 + 305);
  feeder.set("Factory_Reset", 1);
  EXPECT_EQ(feeder.get("STATUS"), 0);
  EXPECT_EQ(feeder.get("Aaxis_Move_INC"), 0);
  EXPECT_EQ(feeder.get("Baxis_Move_INC"), 0);
  feeder.run(1000);
  EXPECT_EQ(feeder.coordinate('A'), 300);
}

TEST(FactoryReset, SwitchesTheOutputsOffLikeEveryOtherRegister) {
  OneSimple2 feeder;
  feeder.set("DOUT_ALL", 0x7F);
  feeder.set("Factory_Reset", 1);
  feeder.run(1);
  EXPECT_EQ(feeder.get("DOUT_ALL"), 0);
  for (int n = 0; n < 7; ++n) EXPECT_FALSE(feeder.output(n)) << n;
}

TEST(FactoryReset, LeavesTheDeviceFitForWork) {
  ReadySimple2 feeder;
  feeder.set("Factory_Reset", 1);
  feeder.set("Aaxis_SVON", 1);
  feeder.set_move('A', 32'000, 200, 5, 5);
  feeder.set("Aaxis_Move_INC", 1);
  feeder.run(3051);
  EXPECT_EQ(feeder.coordinate('A'), 32'000);
}

TEST(ProgramMemory, KeepsTheLowByteOfEachCell) {
  OneSimple2 feeder;
  struct Case {
    std::uint16_t written, kept;
  };
  for (const auto& [written, kept] :
       {Case{0xFFFB, 0x00FB}, Case{0x0100, 0}, Case{0x00FF, 0xFF}, Case{0x1234, 0x34}}) {
    for (const std::uint16_t address : {0x4000, 0x4001, 0x4002, 0x4003, 0x4204, 0x43FC, 0x43FF}) {
      feeder.write(address, {written});
      std::uint16_t read = 0;
      EXPECT_EQ(read_words(*feeder.device().register_bank(), Table::holding, address, std::span(&read, 1)),
                Refusal::none);
      EXPECT_EQ(read, kept) << address;
    }
  }
}

TEST(ProgramMemory, CellsDoNotTouchEachOther) {
  OneSimple2 feeder;
  for (int line = 0; line < 256; ++line) {
    std::vector<std::uint16_t> words;
    for (int cell = 0; cell < 4; ++cell)
      words.push_back(static_cast<std::uint16_t>((line * 7 + cell * 31) % 256));
    feeder.write(static_cast<std::uint16_t>(0x4000 + 4 * line), words);
  }
  constexpr std::string_view kCells[] = {"_CMD", "_DATA1", "_DATA2", "_JMP"};
  for (int line = 0; line < 256; ++line) {
    for (int cell = 0; cell < 4; ++cell) {
      const std::string name = "MAIN_LINE" + std::to_string(line) + std::string(kCells[cell]);
      ASSERT_EQ(feeder.get(name), (line * 7 + cell * 31) % 256) << name;
    }
  }
}

TEST(ProgramMemory, EraseFillsEveryLineWithZeroAndNothingElse) {
  OneSimple2 feeder;
  write_all(feeder, kPersistent);
  write_all(feeder, kCalibration);
  for (std::uint16_t address = 0x4000; address <= 0x43FF; ++address) feeder.write(address, {0xAB});
  feeder.set("PROG_MAIN_Erase_ALL", 0);
  EXPECT_EQ(feeder.get("MAIN_LINE128_DATA1"), 0xAB) << "0 does nothing";
  feeder.set("PROG_MAIN_Erase_ALL", 1);
  for (std::uint16_t address = 0x4000; address <= 0x43FF; ++address) {
    std::uint16_t word = 1;
    EXPECT_EQ(read_words(*feeder.device().register_bank(), Table::holding, address, std::span(&word, 1)),
              Refusal::none);
    ASSERT_EQ(word, 0) << address;
  }
  for (const Written& r : kPersistent) {
    EXPECT_EQ(feeder.get(r.name), r.name.starts_with("MAIN_LINE") ? 0 : r.value) << r.name;
  }
}

TEST(Firmware, ShowsItsVersionAndHasThePasswordFrom151On) {
  for (const Firmware firmware : {139, 140, 141, 142, 150, 151, 152}) {
    OneSimple2 feeder({.firmware = firmware});
    EXPECT_EQ(feeder.get("Version"), firmware);
    EXPECT_EQ(feeder.get("HW_Code"), 0xC001);
    const Refusal expected = firmware >= 151 ? Refusal::none : Refusal::no_register;
    for (const std::uint16_t address : {0xFF07, 0xFF08, 0xFF09}) {
      EXPECT_EQ(feeder.try_read(address), expected) << firmware << " " << address;
    }
    for (const std::uint16_t address : {0xFF07, 0xFF09}) {
      const std::vector<std::uint16_t> words{0};
      EXPECT_EQ(write_words(*feeder.device().register_bank(), Table::holding, address, words), expected)
          << firmware;
    }
    EXPECT_EQ(feeder.device().register_bank()->find("PWD_Input").has_value(), firmware >= 151);
    EXPECT_EQ(feeder.try_read(0xFF05), Refusal::none);
    EXPECT_EQ(feeder.try_read(0xFF0A), Refusal::no_register);
  }
}

TEST(Firmware, ARequestReachingThePasswordOf150IsRefusedWhole) {
  OneSimple2 feeder({.firmware = 150});
  const std::vector<std::uint16_t> words{1, 2, 3, 4, 0, 0};
  EXPECT_EQ(write_words(*feeder.device().register_bank(), Table::holding, 0xFF02, words),
            Refusal::no_register);
  EXPECT_EQ(feeder.get("ADC_10V_A"), 4000);
}

}  // namespace memory_test
}  // namespace understudy::emulator::models::simple2_r3
