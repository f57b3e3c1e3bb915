// Corner cases: levels that are ON at a start, numbers beyond the capacity of the chip or the controller, and
// the line that an error names.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "emulator/device/program_language.h"
#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace corners_test {

/// 65,535 steps of the chip's largest multiplier, 100 (printed as 6.55 Mpps).
TEST(Super40ncCorners, NoMotionIsFasterThanTheChip) {
  OneSuper40nc one({.set = {{"D9003", 1}}, .program = "AREA C\nF K9999999\nLIN K90000000\nEND"});
  one.set("D9170", 131072);
  one.set("D9175", 10000);
  one.set("D9196", 9999);
  one.set("D8022", 2);
  one.set("M8103", 1);
  one.run(1000);
  EXPECT_DOUBLE_EQ(one.device().axes()->speed_pps(0), 6553500);
  EXPECT_EQ(one.get("D8170"), 65535);
  one.press("M8102");
  one.set("D8117", 0);
  one.press("M8000");
  one.run(1000);
  EXPECT_LE(one.device().axes()->speed_pps(0), 6553500);
}

TEST(Super40ncCorners, TheStationIsOneOfSixteen) {
  OneSuper40nc one({.set = {{"D9000", 0x1005}}});
  EXPECT_EQ(one.ask(OneSuper40nc::kRs232, "05 01 00 00 00 01"), "");
  EXPECT_EQ(one.ask(OneSuper40nc::kRs232, "0F 01 00 00 00 01"), "0F 01 01 00");
}

TEST(Super40ncCorners, AFileHasTheRoomOfD9042) {
  const std::string file = "FILE 1\nLIN K1\nLIN K2\nEND\n";  // 9 steps
  OneSuper40nc one({.program = file});
  const auto text = [&] { return one.device().user_program()->program_text(); };
  one.set("D9045", 8);
  EXPECT_EQ(one.get("D9042"), 8);
  one.set("D9001", 1);
  EXPECT_EQ(one.get("D8094"), 10);
  EXPECT_EQ(text().find("AREA C"), std::string::npos);
  one.set("D9001", 0);
  EXPECT_NE(text().find("FILE 1"), std::string::npos);  // it is unchanged
  EXPECT_THROW(one.device().user_program()->load_program(file), ProgramError);
  EXPECT_EQ(one.get("D8094"), 10);
  one.set("D9045", 9);
  EXPECT_NO_THROW(one.device().user_program()->load_program(file));
  one.set("D9001", 1);
  EXPECT_NE(text().find("AREA C"), std::string::npos);
}

/// 5.1: a start first completes what a pause holds, whatever program the file now has.
TEST(Super40ncCorners, APausedLineIsCompletedWhenItsFileHasBecomeEmpty) {
  for (const auto& [file, code] : {std::pair{0, 0}, {1, 1}, {2, 1}}) {
    OneSuper40nc one(
        {.set = {{"D9003", 2}}, .program = "AREA C\nF K20000\nLIN K20000 K10000\nEND\nFILE 2\nEND\n"});
    one.set("M8000", 1);
    one.run(400);
    one.press("M8006");
    one.run(300);
    ASSERT_LT(one.get("D8117"), 20000);
    one.set("D9001", file);
    one.set("M8000", 1);
    one.run(3000);
    EXPECT_EQ(one.get("D8117"), 20000) << file;
    EXPECT_EQ(one.get("D8217"), 10000) << file;
    EXPECT_FALSE(one.on("M8120")) << file;
    EXPECT_EQ(one.get("D8094"), code) << file;
    EXPECT_FALSE(one.on("M8000")) << file;
  }
}

/// Table D8x: 14 is "waiting for INP".
TEST(Super40ncCorners, AnAxisThatWaitsForInpSaysSo) {
  OneSuper40nc one({.program = "AREA X\nDRV K1000\nEND\n", .choices = {{"inp_wait", "single_axes_wait"}}});
  one.set("M8100", 1);
  one.run(3000);
  EXPECT_EQ(one.get("D8117"), 1000);
  EXPECT_TRUE(one.on("M8120"));
  EXPECT_EQ(one.get("D8164"), 14);
}

/// The mark of MRK is no limit while MRK looks for it, whatever X33 and X34 say.
TEST(Super40ncCorners, MrkBeginsOnItsMark) {
  for (const int is_limit : {0, 1}) {
    OneSuper40nc one({.set = {{"D9163", is_limit}, {"D9190", 500}},
                      .program = "AREA X\nMRK K1000\nEND\n",
                      .choices = {{"limits_blocking", "both_ways_blocked"}}});
    one.input("X1", 1);
    one.set("M8100", 1);
    one.run(5000);
    EXPECT_EQ(one.get("D8117"), 1000) << is_limit;
    EXPECT_EQ(one.get("D8094"), 0) << is_limit;
  }
}

/// M8x24 lasts one scan of the PLC, in whatever order a scan works.
TEST(Super40ncCorners, ThePlcSeesAnErrorOfOneScan) {
  for (const char* const order :
       {"wire_plc_keys_contacts_programs_motion_status", "contacts_before_the_plc"}) {
    OneSuper40nc one({.set = {{"D9185", 3000}},
                      .program = "AREA X\nDRV K5000\nEND\nAREA PLC\nLD M8124\nSET M50\nEND\n",
                      .choices = {{"serr_clears", "one_scan"}, {"scan_order", order}}});
    one.set("M8100", 1);
    one.run(3000);
    EXPECT_EQ(one.get("D8094"), 13) << order;
    EXPECT_TRUE(one.on("M50")) << order;
    EXPECT_FALSE(one.on("M8124")) << order;
  }
}

/// A listing is checked by a controller without power.
TEST(Super40ncCorners, AListingIsCheckedAgainstTheFactorysRoom) {
  std::string text = "AREA C\n";
  for (int i = 0; i < 374; ++i) text += "LIN K1\n";
  EXPECT_TRUE(model().language->check(text + "END\n", {}).empty());
  EXPECT_FALSE(model().language->check(text + "LIN K1\nEND\n", {}).empty());
}

/// By EA/EB, the factory setting: the pulses of a tick are counted in that tick.
TEST(Super40ncCorners, AnEncoderIsNotBehind) {
  world::PlantSetup plant;
  plant.encoder_counts_per_revolution = 4000;
  plant.pulses_per_revolution = 4000;
  OneSuper40nc one({.plant = {{0, plant}}});
  one.set("D9125", 1);  // COUNTER4 as well
  one.set("M8103", 1);
  for (int i = 0; i < 40; ++i) {
    one.run(1);
    ASSERT_EQ(one.get("D8141"), one.get("D8140"));
    ASSERT_EQ(one.get("D8142"), 0);
    ASSERT_EQ(one.get("D8143"), one.get("D8140"));
  }
}

/// As a single axis.
TEST(Super40ncCorners, APathDoesNotBeginIntoALimit) {
  struct Case {
    const char* line;
    const char* input;
    const char* soft;  // D8x44, D8x45
    Value code;        // 0: it starts
  };
  for (const auto& [line, input, soft, code] :
       {Case{"LIN K1000 K1000", "X1", "", 11}, Case{"LIN K1000 K1000", "X5", "", 0},
        Case{"LIN K1000 K-1000", "X5", "", 12}, Case{"LIN K-1000 K1000", "X1", "", 0},
        Case{"CW K2000 K0 K1000 K0", "X4", "", 11}, Case{"CCW K2000 K0 K1000 K0", "X4", "", 0},
        Case{"LIN K1000 K1000", "", "D8144", 13}, Case{"LIN K-1000 K1000", "", "D8144", 0}}) {
    OneSuper40nc one(
        {.set = {{"D9003", 2}, {"D9016", 0}}, .program = std::string("AREA C\nNOP\n") + line + "\nEND"});
    if (*input != 0) one.input(input, 1);
    if (*soft != 0) one.set(soft, -1);
    one.run(2);
    one.set("M8000", 1);
    one.run(2);
    EXPECT_EQ(one.on("M8120"), code == 0) << line << ' ' << input;
    EXPECT_EQ(one.on("M8000"), code == 0) << line << ' ' << input;
    EXPECT_EQ(one.get("D8094"), code) << line << ' ' << input;
    EXPECT_EQ(one.get("D8095"), code == 0 ? 0 : 1) << line << ' ' << input;
    if (code == 0) continue;
    one.run(100);
    EXPECT_EQ(one.get("D8140"), 0);
    EXPECT_EQ(one.get("D8240"), 0);
  }
}

/// "The signal resets the program": X33 and X34 are 0, as MRK wants them.
TEST(Super40ncCorners, MrkWithoutADistanceMeetsItsSignal) {
  for (const auto& [input, code] : {std::pair{"X1", 11}, std::pair{"X2", 0}}) {
    OneSuper40nc one({.set = {{"D9163", 0}, {"D9164", 0}}, .program = "AREA X\nMRK K100000\nEND"});
    one.set("M8100", 1);
    one.run(50);
    one.input(input, 1);
    one.run(2);
    EXPECT_EQ(one.get("D8094"), code) << input;
    EXPECT_EQ(one.on("M8100"), code == 0) << input;
    one.press("M8102");
    one.input(input, 1);
    one.set("M8103", 1);  // and is not one again
    one.run(5);
    EXPECT_TRUE(one.on("M8120")) << input;
  }
}

TEST(Super40ncCorners, NothingRunsBehindAnEmergencyStop) {
  for (const auto& [area, contact, start] :
       {std::array{"C", "M8002", "M8000"}, std::array{"X", "M8002", "M8100"},
        std::array{"X", "M8102", "M8100"}}) {
    OneSuper40nc one(
        {.program = std::string("AREA ") + area + "\nSET Y10\nSET " + contact + "\nSET Y11\nEND"});
    one.set(start, 1);
    one.run(5);
    EXPECT_TRUE(one.output("Y10"));
    EXPECT_FALSE(one.output("Y11")) << area << ' ' << contact;
    EXPECT_FALSE(one.on(start));
    EXPECT_EQ(one.get("D8000"), 0);
    EXPECT_EQ(one.get("D8100"), 0);
  }
}

TEST(Super40ncCorners, AJogOfThePlcReportsItsLine) {
  for (const auto& [input, line, code] : {std::tuple{"X1", 3501, 11}, std::tuple{"X2", 3506, 12}}) {
    OneSuper40nc one({.program = "AREA PLC\nLD M1\nPJG K1\nLD M2\nMJG K1\nEND"});
    one.input(input, 1);
    one.run(2);
    one.set(code == 11 ? "M1" : "M2", 1);
    one.run(3);
    EXPECT_EQ(one.get("D8094"), code);
    EXPECT_EQ(one.get("D8095"), line);
  }
}

/// Only the start of a program, or of a manual motion, clears it.
TEST(Super40ncCorners, ALineLeavesTheErrorOfAnother) {
  OneSuper40nc one({.program = "AREA X\nDIV K1 K0 D0\nDRV K100\nEND"});
  one.set("M8100", 1);
  one.run(10);
  EXPECT_TRUE(one.on("M8120"));
  EXPECT_EQ(one.get("D8094"), 8);
  EXPECT_EQ(one.get("D8095"), 1500);
  one.run(500);
  one.press("M8103");
  EXPECT_EQ(one.get("D8094"), 0);
}

/// By values that the chip's comparators do not watch: at the end of the tick in which they change.
TEST(Super40ncCorners, ComparatorsSeeEveryNumber) {
  struct Case {
    Value source;
    Value method;
    const char* contact;  // of the jog
    Value value;
    bool stops;
  };
  for (const auto& [source, method, contact, value, stops] :
       {Case{1, 1, "M8103", 500, true}, Case{1, 2, "M8103", 500, true}, Case{1, 3, "M8103", 500, false},
        Case{1, 3, "M8104", -500, true}, Case{1, 2, "M8104", -500, false}, Case{1, 5, "M8103", 500, true},
        Case{1, 4, "M8104", -500, true}, Case{3, 1, "M8103", 500, true}, Case{0, 2, "M8103", 500, true},
        Case{0, 3, "M8103", 500, false}, Case{0, 3, "M8104", -500, true}}) {
    OneSuper40nc one({.set = {{"D9123", 1},  // COUNTER2: pulses
                              {"D9139", source},
                              {"D9140", method},
                              {"D9141", 1},
                              {"D8146", value}}});
    one.set("D8146", value);
    one.set(contact, 1);
    one.run(1000);
    const std::string where = std::to_string(source) + " by " + std::to_string(method);
    EXPECT_EQ(one.on("M8120"), !stops) << where;
    EXPECT_EQ(one.get("D8094"), stops ? 23 : 0) << where;
    const Value kPulsesOfATick = source == 0 ? -1 : 4;  // 50 rpm; by the chip, exact to the pulse
    if (stops) {
      EXPECT_LE(std::abs(one.get("D8140") - value), kPulsesOfATick + 1) << where;
    }
  }
}

TEST(Super40ncCorners, EachSoftLimitStopsInItsOwnWay) {
  OneSuper40nc one({.set = {{"D9185", 500}, {"D9186", -500}, {"D9133", 1}, {"D9137", 2}}});
  one.set("D9196", 3000);
  one.set("D8022", 2);
  one.set("M8103", 1);
  one.run(2000);
  EXPECT_EQ(one.get("D8140"), 501);
  one.set("M8103", 0);
  one.run(1);
  one.set("M8104", 1);
  one.run(2000);
  EXPECT_LT(one.get("D8140"), -600);
  EXPECT_EQ(one.get("D8094"), 14);
}

TEST(Super40ncCorners, WhatIsOnAtPowerUpIsNoEdge) {
  world::PlantSetup plant;
  plant.home = world::PulseSpan{-50, 50};
  OneSuper40nc one({.plant = {{0, plant}},
                    .program = "AREA PLC\nLDP X0\nSET Y10\nLDP M8142\nSET Y11\nLD M8142\nOUT Y12\nEND"});
  for (const bool again : {false, true}) {
    if (again) one.world().switch_power(0, false);
    if (again) one.run(5);
    if (again) one.world().switch_power(0, true);
    one.run(10);
    EXPECT_FALSE(one.output("Y10")) << again;
    EXPECT_FALSE(one.output("Y11")) << again;
    EXPECT_TRUE(one.output("Y12")) << again;
  }
}

/// M8514 acts like the HOME key with that digit.
TEST(Super40ncCorners, TheOriginKeyObeysItsLock) {
  for (const auto& [mask, homes] : {std::pair{0, true}, std::pair{100000, false}, std::pair{1000, true}}) {
    OneSuper40nc one({.set = {{"D9199", 1}, {"D9025", mask}}, .choices = {{"m8514_meaning", "home"}}});
    one.press("M8514");
    EXPECT_EQ(one.on("M8197"), homes) << mask;
  }
}

/// Lock (D9198) and X52 (D9197) apply when a key is pressed: the axis stops with the key, whatever they are
/// by then.
TEST(Super40ncCorners, AJogKeyThatIsLetGoAlwaysStops) {
  for (const auto& [parameter, value] : {std::pair{"D9197", 1}, std::pair{"D9198", 11000000}}) {
    for (const char* key : {"M8560", "M8561", "M8519"}) {
      OneSuper40nc one;
      one.set(key, 1);
      one.run(100);
      const bool is_back = key == std::string("M8561");
      one.set(parameter, value);
      one.run(100);
      EXPECT_TRUE(one.on("M8120")) << key << " " << parameter;
      EXPECT_EQ(one.on("M8144"), is_back) << key << " " << parameter;
      one.set(key, 0);
      one.run(100);
      EXPECT_FALSE(one.on("M8120")) << key << " " << parameter;
      EXPECT_FALSE(one.on("M8103") || one.on("M8104")) << key << " " << parameter;
      one.set(key, 1);
      one.run(100);
      const bool is_locked = parameter == std::string("D9198");
      EXPECT_EQ(one.on("M8120"), !is_locked) << key;
      EXPECT_EQ(one.on("M8144"), is_locked ? is_back : !is_back) << key;
    }
  }
  // The other key of the axis continues with its own jog.
  OneSuper40nc one;
  one.set("M8560", 1);
  one.run(100);
  one.set("D9197", 1);
  one.set("M8561", 1);  // now jogs + as well
  one.run(10);
  one.set("M8560", 0);
  one.run(100);
  EXPECT_TRUE(one.on("M8120"));
  one.set("M8561", 0);
  one.run(100);
  EXPECT_FALSE(one.on("M8120"));
}

/// A loaded program replaces only that of its own area: motion of other programs continues.
TEST(Super40ncCorners, LoadingStopsWhatThatAreaMovesAlone) {
  OneSuper40nc one({.set = {{"D9003", 1}},
                    .program =
                        "AREA C\nF K20000\nLIN K40000\nEND\nAREA X\nWAT M1\nEND\nAREA Y\nRPM K100\nDRV "
                        "K90000\nEND\nAREA Z\nVDRV K100\nEND\n"});
  one.set("M8000", 1);
  one.set("M8100", 1);
  one.set("M8200", 1);
  one.set("M8300", 1);
  one.run(100);
  one.it().load_program("AREA X\nSET M7\nEND\n");
  one.run(100);
  EXPECT_TRUE(one.on("M8000") && one.on("M8120") && one.on("M8200") && one.on("M8220"));
  EXPECT_FALSE(one.on("M8100"));
  one.it().load_program("AREA Y\nEND\nAREA Z\nEND\n");
  one.run(3);
  EXPECT_TRUE(one.on("M8000") && one.on("M8120"));
  EXPECT_FALSE(one.on("M8200") || one.on("M8220") || one.on("M8320"));
  one.set("M8403", 1);
  one.run(20);
  one.it().load_program("AREA C\nEND\nAREA U\nEND\n");
  one.run(3);
  EXPECT_FALSE(one.on("M8000") || one.on("M8120"));
  EXPECT_TRUE(one.on("M8420")) << "a jog by hand";
}

TEST(Super40ncCorners, AJogOfThePlcEndsWithItsProgram) {
  for (const char* next : {"AREA PLC\n", "AREA PLC\nEND\n", "AREA PLC\nLD M9\nOUT Y0\nEND\n"}) {
    OneSuper40nc one({.program = "AREA PLC\nLD M8003\nPJG K1\nEND\n"});
    one.run(100);
    EXPECT_TRUE(one.on("M8120"));
    one.it().load_program(next);
    one.run(100);
    EXPECT_FALSE(one.on("M8120")) << next;
  }
}

}  // namespace corners_test
}  // namespace understudy::emulator::models::super_40nc
