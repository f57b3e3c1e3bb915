// What a power cut leaves in the EEPROM: completed writes, and the previous values of all others (choice
// power_cut).
#include "tests/emulator/models/simple2_r3/switched_simple2.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::models::simple2_r3 {
namespace power_cut_test {

// -----------------------------------------------------------------------------------------

TEST(PowerCut, KeepsExactlyWhatTheEepromHadDoneAndNeverHalfAPair) {
  // Three position sets in one request: of each the pair takes 10 ms and the words 5 each, one after another
  // from tick 1 on. So set n (from 0) has its pair at 11 + 25 n, then Speed, AccTime and DecTime 5 ms apart.
  for (Tick cut = 0; cut <= 80; ++cut) {
    Switched feeder;
    world::Words words;
    for (std::uint16_t n = 1; n <= 3; ++n) {
      words.insert(words.end(),
                   {static_cast<std::uint16_t>(0x1110 * n), static_cast<std::uint16_t>(0x0101 * n), n, n, n});
    }
    feeder.write(0x2000, words);
    feeder.run_to(cut);
    feeder.cycle(cut % 3);
    EXPECT_FALSE(feeder.bit("EEPROM_Writing"));
    for (Tick n = 0; n < 3; ++n) {
      const auto kept = [&](Tick done, Value value) { return cut >= done ? value : 0; };
      const std::string number = std::to_string(n + 1);
      const Tick pair = 11 + 25 * n;
      ASSERT_EQ(feeder.get("Parms_Pulse" + number), kept(pair, 0x0101'1110 * (n + 1))) << cut;
      ASSERT_EQ(feeder.get("Parms_Speed" + number), kept(pair + 5, n + 1)) << cut;
      ASSERT_EQ(feeder.get("Parms_AccTime" + number), kept(pair + 10, n + 1)) << cut;
      ASSERT_EQ(feeder.get("Parms_DecTime" + number), kept(pair + 15, n + 1)) << cut;
    }
    // What was lost is not written later either.
    feeder.run(200);
    ASSERT_EQ(feeder.get("Parms_DecTime3"), cut >= 76 ? 3 : 0) << cut;
    // But it can be written again.
    feeder.set("Parms_DecTime3", 3);
    feeder.run(10);
    feeder.cycle();
    ASSERT_EQ(feeder.get("Parms_DecTime3"), 3) << cut;
  }
}

TEST(PowerCut, DuringAnErasureLeavesEverythingAsItWas) {
  for (const char* how : {"PROG_MAIN_Erase_ALL", "Factory_Reset"}) {
    for (const Tick cut : {0, 1, 250, 500, 501, 502}) {
      SCOPED_TRACE(std::string(how) + " " + std::to_string(cut));
      Switched feeder;
      feeder.write(0x4000, {0x05, 4, 1, 0, 0xFF, 0, 0, 0});
      feeder.set("Parms_Speed1", 77);
      feeder.set("AutoStart_MainProg", 1);
      feeder.set("ADC_1V_A", 401);
      feeder.run_to(1000);
      feeder.set(how, 1);
      feeder.run(cut);
      feeder.cycle();
      const bool erased = cut >= 501;  // begins with tick 1, takes 500
      const bool reset = erased && std::string_view(how) == "Factory_Reset";
      EXPECT_EQ(feeder.get("MAIN_LINE0_CMD"), erased ? 0 : 0x05);
      EXPECT_EQ(feeder.get("MAIN_LINE1_CMD"), erased ? 0 : 0xFF);
      EXPECT_EQ(feeder.get("Parms_Speed1"), reset ? 0 : 77);
      EXPECT_EQ(feeder.get("AutoStart_MainProg"), reset ? 0 : 1);
      EXPECT_EQ(feeder.get("ADC_1V_A"), 401);
      feeder.run(10);
      EXPECT_EQ(feeder.bit("DOUT_4"), !erased) << "the present program runs";
    }
  }
}

TEST(PowerCut, AfterAnErasureAHalfKeptProgramStandsInEmptyLines) {
  Switched feeder;
  feeder.write(0x4000, {0x05, 1, 1, 1, 0x05, 2, 1, 2});
  feeder.run_to(100);
  feeder.set("PROG_MAIN_Erase_ALL", 1);                  // kept in tick 601
  feeder.write(0x4000, {0x06, 1, 0, 0, 0xFF, 0, 0, 0});  // 606, 611, and 616 for the END
  feeder.run_to(613);
  feeder.cycle();
  EXPECT_EQ(world::read(feeder.device(), 0x4000, 8), (world::Words{0x06, 1, 0, 0, 0, 0, 0, 0}));
}

TEST(PowerCut, AtTheSameInstantMayComeAgainAndAgain) {
  Switched feeder;
  feeder.set("Parms_Speed1", 5);
  feeder.run_to(6);
  for (int i = 0; i < 100; ++i) feeder.cycle(i % 2);
  EXPECT_EQ(feeder.get("Parms_Speed1"), 5);
  feeder.power(true);  // is on already: nothing
  feeder.set("Aaxis_Speed", 7);
  feeder.power(true);
  EXPECT_EQ(feeder.get("Aaxis_Speed"), 7);
}

}  // namespace power_cut_test
}  // namespace understudy::emulator::models::simple2_r3
