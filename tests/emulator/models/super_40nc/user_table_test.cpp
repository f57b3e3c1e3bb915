// The user table and the direct command, which a bench must select. The manual only prints code 1, a line
// (《命令範例》 24), so the others are compared with the header of user_table.h.
#include "emulator/models/super_40nc/programs/user_table.h"

#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace user_table_test {

constexpr Value kUnset = INT32_MIN;

Given chosen(const std::string& program = "") {
  return {.set = {{"D9003", 4}, {"D9016", 0}}, .program = program, .choices = {{"user_table", "on"}}};
}

/// Missing data are unset.
void put_line(OneSuper40nc& one, int line, Value command, const std::vector<Value>& data) {
  one.set("USER" + std::to_string(10 * line), command);
  for (std::size_t i = 1; i < 10; ++i) {
    one.set("USER" + std::to_string(10 * line + static_cast<int>(i)),
            i <= data.size() ? data[i - 1] : kUnset);
  }
}

void order(OneSuper40nc& one, Value command, const std::vector<Value>& data) {
  for (std::size_t i = 1; i < 10; ++i) {
    one.set("D" + std::to_string(8020 + i), i <= data.size() ? data[i - 1] : kUnset);
  }
  one.set("D8020", 100 + command);
}

/// By their addresses on the wire, of which those of special contacts lie after a hole.
TEST(Super40ncUserTable, SwitchesEveryKindOfCoil) {
  OneSuper40nc one(chosen());
  order(one, 9, {3, 1005, 2010});
  one.run(5);
  for (const char* coil : {"Y3", "M5", "M8010"}) EXPECT_TRUE(one.on(coil)) << coil;
  order(one, 10, {3, 1005, 2010});
  one.run(5);
  for (const char* coil : {"Y3", "M5", "M8010"}) EXPECT_FALSE(one.on(coil)) << coil;
}

TEST(Super40ncUserTable, RunsItsLinesAndShowsWhich) {
  OneSuper40nc one(chosen());
  put_line(one, 0, 5, {20'000});                 // F
  put_line(one, 1, 1, {20'000});                 // LIN X
  put_line(one, 2, 2, {0, kUnset, -10'000, 0});  // CW, half a circle back
  put_line(one, 3, 9, {1005, 3});                // SET M5, Y3
  put_line(one, 4, 7, {200});                    // TMR
  put_line(one, 5, 10, {3});                     // RST Y3
  put_line(one, 6, 0, {});
  one.set("D8020", 100);
  EXPECT_EQ(one.get("D8020"), 0);
  EXPECT_TRUE(one.on("M8000"));
  one.run(500);
  EXPECT_EQ(one.get("D8019"), 1);
  EXPECT_GT(one.get("D8117"), 5000);
  // 20 mm at 20 mm/s, then 31.4 mm, with a ramp of 30 ms each.
  one.run(540);
  EXPECT_EQ(one.get("D8019"), 2);
  one.run(1610);
  EXPECT_EQ(one.get("D8019"), 4);
  EXPECT_EQ(one.get("D8117"), 0);
  EXPECT_TRUE(one.on("M5"));
  EXPECT_TRUE(one.output("Y3"));
  one.run(210);
  EXPECT_FALSE(one.on("M8000"));
  EXPECT_FALSE(one.output("Y3"));
  EXPECT_EQ(one.get("D8019"), 0);
  EXPECT_EQ(one.get("D8094"), 0);
}

TEST(Super40ncUserTable, CommandsReadTheirOwnDataAlone) {
  OneSuper40nc one(chosen());
  one.set("M9", 1);
  put_line(one, 0, 9, {1001, 1002, 1003, 1004, 1005, 1006});
  put_line(one, 1, 10, {1002, kUnset, kUnset, 1008, 1009});
  put_line(one, 2, 7, {5, 7000});
  one.set("D8020", 100);
  one.run(20);
  for (const char* const on : {"M1", "M3", "M4", "M9"}) EXPECT_TRUE(one.on(on)) << on;
  for (const char* const off : {"M2", "M5", "M6", "M8", "M8000"}) EXPECT_FALSE(one.on(off)) << off;
}

TEST(Super40ncUserTable, LeavesTheProgramOfCAsItWas) {
  OneSuper40nc one(chosen("AREA C\nSET M7\nEND\n"));
  put_line(one, 0, 9, {1005});
  one.set("D8020", 100);
  one.run(5);
  EXPECT_TRUE(one.on("M5"));
  EXPECT_FALSE(one.on("M7"));
  one.set("M8000", 1);
  one.run(5);
  EXPECT_TRUE(one.on("M7"));
}

TEST(Super40ncUserTable, ADirectCommandIsOneLine) {
  OneSuper40nc one(chosen());
  order(one, 6, {200, 100});  // RPM
  one.run(5);
  order(one, 4, {1000, 500});  // DRV
  EXPECT_EQ(one.get("D8020"), 0);
  one.run(10);
  EXPECT_TRUE(one.on("M8120"));
  EXPECT_TRUE(one.on("M8220"));
  EXPECT_EQ(one.get("D8019"), 0) << "no line of the table";
  EXPECT_LE(one.run_while("M8000"), 90) << "at 200 rpm";
  EXPECT_EQ(one.get("D8117"), 1000);
  EXPECT_EQ(one.get("D8217"), 500);
}

TEST(Super40ncUserTable, IsVoidWhileCRuns) {
  OneSuper40nc one(chosen("AREA C\nTMR K500\nEND\n"));
  one.set("M8000", 1);
  one.run(5);
  order(one, 9, {1005});
  EXPECT_EQ(one.get("D8020"), 0);
  EXPECT_EQ(one.get("D8094"), 21);
  one.run(600);
  EXPECT_FALSE(one.on("M5"));
  EXPECT_FALSE(one.on("M8000"));
}

TEST(Super40ncUserTable, StopsWithACodeAtWhatCannotBe) {
  const std::pair<Value, std::vector<Value>> kWrong[] = {
      {11, {1}}, {-1, {1}}, {5, {}}, {7, {}}, {9, {}}, {9, {40}}, {9, {1600}}, {10, {2700}}, {9, {-5}}};
  for (const auto& [command, data] : kWrong) {
    OneSuper40nc one(chosen());
    put_line(one, 0, 9, {1004});
    put_line(one, 1, command, data);
    put_line(one, 2, 9, {1005});
    one.set("D8020", 100);
    one.run(10);
    EXPECT_TRUE(one.on("M4")) << command;
    EXPECT_FALSE(one.on("M5")) << command;
    EXPECT_FALSE(one.on("M8000")) << command;
    EXPECT_EQ(one.get("D8094"), 1) << command;
  }
}

TEST(Super40ncUserTable, IsStoppedAndHeldAsC) {
  OneSuper40nc one(chosen());
  put_line(one, 0, 1, {50'000});
  one.set("D8020", 100);
  one.run(300);
  one.press("M8006");
  one.run(100);
  EXPECT_TRUE(one.on("M8022"));
  const Value held = one.get("D8117");
  one.run(100);
  EXPECT_EQ(one.get("D8117"), held);
  one.set("M8000", 1);
  one.run(100);
  EXPECT_GT(one.get("D8117"), held);
  one.press("M8596");
  EXPECT_FALSE(one.on("M8120"));
  // A new start runs C's own program, which is empty.
  one.set("M8000", 1);
  one.run(3);
  EXPECT_FALSE(one.on("M8000"));
}

TEST(Super40ncUserTable, ContinuesFromASnapshot) {
  OneSuper40nc one(chosen());
  put_line(one, 0, 1, {30'000});
  put_line(one, 1, 7, {100});
  put_line(one, 2, 1, {0});
  one.set("D8020", 100);
  one.run(400);
  const auto state = one.device().save_state();
  OneSuper40nc other(chosen());
  other.run(one.now());
  other.device().restore_state(state);
  for (int i = 0; i < 70; ++i) {
    one.run(97);
    other.run(97);
    ASSERT_EQ(one.device().state_hash(), other.device().state_hash()) << i;
  }
  EXPECT_FALSE(one.on("M8000"));
  EXPECT_EQ(one.get("D8117"), 0);
  EXPECT_TRUE(one.device().state_difference(one.device().save_state(), other.device().save_state()).empty());
}

TEST(Super40ncUserTable, AllItsLinesAreUsed) {
  OneSuper40nc one(chosen());
  for (int line = 0; line < kTableLines; ++line) put_line(one, line, 9, {1000 + line});
  one.set("D8020", 100);
  one.run(20);
  for (int line = 0; line < kTableLines; ++line) EXPECT_TRUE(one.on("M" + std::to_string(line))) << line;
  EXPECT_FALSE(one.on("M8000"));
}

}  // namespace user_table_test
}  // namespace understudy::emulator::models::super_40nc
