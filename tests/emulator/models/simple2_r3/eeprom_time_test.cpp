// EEPROM_Writing over time, to the millisecond: 5 ms a word, one value after the other, an erasure 500 ms
// (choices eeprom_time, eeprom_erasure). A write after tick n begins with tick n + 1.
#include "emulator/device/memory/persistent_memory.h"
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace eeprom_time_test {

using Words = std::vector<std::uint16_t>;

struct Writer : OneSimple2 {
  using OneSimple2::OneSimple2;

  bool writing() const { return bit("EEPROM_Writing"); }
  /// What would be there if the power went now.
  Value kept(const std::string& name) {
    for (const auto& [kept_name, value] : device().memory()->nv_image().registers) {
      if (kept_name == name) return value;
    }
    const RegisterRow& row = *world::find_register(world().known(), name).place.place.row;
    return row.factory;
  }
  /// 1 from now on to `last`, 0 from the tick after it.
  void expect_writing_until(Tick last) {
    EXPECT_TRUE(writing()) << "at once";
    for (Tick tick = now() + 1; tick <= last + 20; ++tick) {
      run_to(tick);
      ASSERT_EQ(writing(), tick <= last) << "tick " << tick;
    }
  }
};

struct Case {
  const char* what;
  std::uint16_t first;
  Words words;
  Tick takes;  // ms
};

/// Words 1, 2, 3, ...: no factory value is among the first of them where they go.
Words count_up(std::uint16_t count) {
  Words words;
  for (std::uint16_t i = 1; i <= count; ++i) words.push_back(i);
  return words;
}

const std::vector<Case> kRequests = {
    {"a word", 0xF001, {9}, 5},
    {"a pair", 0x8000, {1, 1}, 10},
    {"the low half of a pair: it is written whole", 0x8000, {1}, 10},
    {"the high half", 0x8001, {1}, 10},
    {"a pair of which one half changes", 0xF002, {3200, 1}, 10},
    {"the cells of a line", 0x4000, {1, 2, 3, 4}, 20},
    {"two equal cells and two new ones", 0x4000, {0, 2, 0, 4}, 10},
    {"a cell whose low byte is as it was", 0x4000, {0xFF00, 7, 0, 0}, 5},
    {"a position set: a pair and three words", 0x2000, count_up(5), 25},
    {"all position sets: 16 * 25", 0x2000, count_up(80), 400},
    {"123 cells, which is a whole request", 0x4000, count_up(123), 615},
    {"all of MEM: 32 pairs", 0x8000, count_up(64), 320},
    {"assignments, of which the odd ones are 1", 0x0A00, {1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0}, 35},
};

TEST(EepromTime, IsFiveMillisecondsAWord) {
  for (const Case& c : kRequests) {
    for (const Tick start : {0, 7, 1000}) {
      SCOPED_TRACE(c.what);
      Writer feeder;
      feeder.run_to(start);
      feeder.write(c.first, c.words);
      feeder.expect_writing_until(start + 1 + c.takes - 1);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(EepromTime, IsNoneForWhatIsNotKeptOrIsThereAlready) {
  Writer feeder;
  for (const auto& [first, words] : std::vector<std::pair<std::uint16_t, Words>>{
           {0x1000, {1, 2, 3, 4, 5}},         // a move's parameters
           {0x8100, {1, 1}},                  // PROG_VAR0
           {0xF100, {5, 0}},                  // CalcREG
           {0x0E04, {5, 0}},                  // Cord_A
           {0xF006, {5, 0}},                  // DirectmRPM
           {0xFF07, {5}},                     // PWD_Input
           {0x3000, {0}},                     // start the program
           {0xF002, {3200, 0, 3200, 0}},      // as from the factory
           {0x4000, {0x0100, 0, 0xAB00}}}) {  // the low byte is 0 already
    feeder.write(first, words);
    EXPECT_FALSE(feeder.writing()) << first;
  }
}

TEST(EepromTime, IsNoneForARequestThatIsRefused) {
  Writer feeder;
  const Words wrong{1, 0, 3, 4, 3001};  // the last is out of range
  EXPECT_EQ(write_words(*feeder.device().register_bank(), Table::holding, 0x2000, wrong), Refusal::bad_value);
  EXPECT_FALSE(feeder.writing());
}

TEST(EepromTime, WritesWhileBusyShowAtOnceAndWaitTheirTurn) {
  Writer feeder;
  feeder.set("Parms_Speed1", 1);  // done in tick 6
  feeder.run_to(3);
  feeder.set("PROG_MEM5", -7);    // 16
  feeder.set("Parms_Speed2", 3);  // 21
  EXPECT_EQ(feeder.get("PROG_MEM5"), -7);
  EXPECT_EQ(feeder.get("Parms_Speed2"), 3);
  const auto kept = [&] {
    return std::array{feeder.kept("Parms_Speed1"), feeder.kept("PROG_MEM5"), feeder.kept("Parms_Speed2")};
  };
  struct Look {
    Tick tick;
    std::array<Value, 3> kept;
  };
  for (const Look& look : {Look{5, {0, 0, 0}}, Look{6, {1, 0, 0}}, Look{15, {1, 0, 0}}, Look{16, {1, -7, 0}},
                           Look{20, {1, -7, 0}}, Look{21, {1, -7, 3}}}) {
    feeder.run_to(look.tick);
    EXPECT_EQ(kept(), look.kept) << look.tick;
    EXPECT_EQ(feeder.writing(), look.tick < 21) << look.tick;
  }
}

TEST(EepromTime, RepeatedWritesOfAValueAreMergedWhileOneIsBusy) {
  // A host writes a register every millisecond: each job stores the latest value at its beginning.
  Writer feeder;
  for (Tick tick = 0; tick < 18; ++tick) {
    feeder.run_to(tick);
    feeder.set("Parms_Speed1", 100 + tick);
  }
  // Jobs: 1 to 6 with the value of tick 0, 6 to 11 with that of tick 5, 11 to 16 with that of tick 10.
  EXPECT_EQ(feeder.device().memory()->memory_revision(), 3u);
  EXPECT_EQ(feeder.kept("Parms_Speed1"), 110);
  feeder.run_to(21);
  EXPECT_EQ(feeder.kept("Parms_Speed1"), 115);
  EXPECT_TRUE(feeder.writing());
  feeder.run_to(26);
  EXPECT_EQ(feeder.kept("Parms_Speed1"), 117);
  EXPECT_FALSE(feeder.writing());
}

TEST(EepromTime, OfAProgramThatCountsInMemoryIsCoalesced) {
  Writer feeder;
  // VAR_Inc MEM0; Jump to itself: a count every 4 ms.
  feeder.write(0x4000, {0x6B, 0, 0, 1, 0x03, 1, 0, 0});
  feeder.run_to(100);
  ASSERT_FALSE(feeder.writing());
  const std::uint64_t before = feeder.device().memory()->memory_revision();
  feeder.set("PROG_MAIN_RunTime_START", 0);
  // Counts in ticks 102, 106, ... A line that runs in tick k begins to be written in it: 102 to 112 stores
  // the first count. Meanwhile the next one waits, so a job follows every 10 ms, with the count at its
  // beginning.
  for (Tick tick = 101; tick <= 1000; ++tick) {
    feeder.run_to(tick);
    const Value counted = tick < 102 ? 0 : (tick - 102) / 4 + 1;
    const Tick jobs = tick < 112 ? 0 : (tick - 112) / 10 + 1;
    ASSERT_EQ(feeder.get("PROG_MEM0"), counted) << tick;
    ASSERT_EQ(feeder.kept("PROG_MEM0"), jobs == 0 ? 0 : 10 * (jobs - 1) / 4 + 1) << tick;
    ASSERT_EQ(feeder.writing(), tick >= 102) << tick;
    ASSERT_EQ(feeder.device().memory()->memory_revision(), before + static_cast<std::uint64_t>(jobs)) << tick;
  }
}

TEST(EepromTime, OfAnErasureIsHalfASecond) {
  for (const char* how : {"PROG_MAIN_Erase_ALL", "Factory_Reset"}) {
    SCOPED_TRACE(how);
    Writer feeder;
    feeder.write(0x4000, count_up(123));
    feeder.run_to(1000);
    feeder.set(how, 1);
    EXPECT_EQ(feeder.get("MAIN_LINE0_DATA1"), 0) << "seen at once";
    EXPECT_EQ(feeder.kept("MAIN_LINE0_DATA1"), 2);
    feeder.expect_writing_until(1000 + 500);
    EXPECT_EQ(feeder.kept("MAIN_LINE0_DATA1"), 0);
  }
}

TEST(EepromTime, OfAnErasureCountsEvenWhereThereIsNothingToErase) {
  Writer feeder;
  feeder.set("PROG_MAIN_Erase_ALL", 1);
  feeder.expect_writing_until(500);
}

TEST(EepromTime, AnErasureTakesThePlaceOfWhatWaits) {
  Writer feeder;
  feeder.write(0x4000, count_up(123));  // would take until 615
  feeder.set("Parms_Speed1", 7);
  feeder.run_to(50);
  feeder.set("PROG_MAIN_Erase_ALL", 1);
  feeder.expect_writing_until(550);
  EXPECT_EQ(feeder.kept("Parms_Speed1"), 7) << "it is not lost";
  EXPECT_EQ(feeder.kept("MAIN_LINE0_CMD"), 0);
  EXPECT_EQ(feeder.kept("MAIN_LINE30_CMD"), 0);
}

TEST(EepromTime, ANewProgramWaitsForTheErasureOfTheOldOne) {
  Writer feeder;
  feeder.write(0x4000, {1, 2, 3, 4});
  feeder.run_to(100);
  feeder.set("PROG_MAIN_Erase_ALL", 1);  // done in tick 601
  feeder.run_to(200);
  feeder.write(0x4000, {9, 2});  // 606, 611
  EXPECT_EQ(feeder.get("MAIN_LINE0_CMD"), 9);
  struct Look {
    Tick tick;
    std::array<Value, 3> kept;  // CMD, DATA1, DATA2
  };
  for (const Look& look : {Look{600, {1, 2, 3}}, Look{601, {0, 0, 0}}, Look{605, {0, 0, 0}},
                           Look{606, {9, 0, 0}}, Look{610, {9, 0, 0}}, Look{611, {9, 2, 0}}}) {
    feeder.run_to(look.tick);
    const std::array kept{feeder.kept("MAIN_LINE0_CMD"), feeder.kept("MAIN_LINE0_DATA1"),
                          feeder.kept("MAIN_LINE0_DATA2")};
    EXPECT_EQ(kept, look.kept) << look.tick;
    EXPECT_EQ(feeder.writing(), look.tick < 611) << look.tick;
  }
}

TEST(EepromTime, AQuietDeviceWakesForItsEndOnly) {
  Writer feeder;
  feeder.run_to(10);
  feeder.write(0x4000, count_up(123));
  feeder.run(1);  // looks at what was written
  const std::uint64_t before = feeder.world().ticks_run();
  EXPECT_EQ(feeder.world().next_due(), time_of(16)) << "the first word";
  feeder.run_to(10'000);
  EXPECT_EQ(feeder.world().ticks_run() - before, 123u) << "once a word";
  EXPECT_EQ(feeder.world().next_due(), std::nullopt);
}

}  // namespace eeprom_time_test
}  // namespace understudy::emulator::models::simple2_r3
