// SUPER-40NC's programs on the machine: pauses during moves, which events reset which programs, files, power,
// and the contents of a snapshot.
#include <gtest/gtest.h>

#include <cmath>

#include "emulator/device/user_program.h"
#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace programs_test {

using Set = std::vector<std::pair<std::string, Value>>;

const Set kOfC{{"D9003", 4}};

TEST(Super40ncPrograms, ARefusedListingShowsItsCodeAndStep) {
  OneSuper40nc one({.program = "AREA X\nDRV K1\nEND\n"});
  const std::string before = one.it().program_text();
  EXPECT_THROW(one.it().load_program("AREA X\nLIN K1\nEND\n"), ProgramError);
  EXPECT_EQ(one.get("D8094"), 2);
  EXPECT_EQ(one.get("D8095"), 1500);
  EXPECT_THROW(one.it().load_program("AREA X\nDRV K1\n"), ProgramError);
  EXPECT_EQ(one.get("D8094"), 6);
  EXPECT_EQ(one.it().program_text(), before);
}

TEST(Super40ncPrograms, APauseHoldsTheMoveAndAStartFinishesIt) {
  struct Case {
    const char* program;
    const char* run;
    const char* pause;
    std::array<Value, 2> end;
  };
  for (const Case& each :
       {Case{"AREA C\nF K20000\nLIN K20000 K10000\nEND\n", "M8000", "M8006", {20000, 10000}},
        Case{"AREA C\nF K20000\nXYP\nCCW K20000 K0 K10000 K0\nEND\n", "M8000", "M8597", {20000, 0}},
        Case{"AREA C\nINCC\nDRV K20000 K10000\nEND\n", "M8000", "M8006", {20000, 10000}},
        Case{"AREA X\nDRV K20000\nEND\n", "M8100", "M8588", {20000, 0}}}) {
    const bool is_of_c = std::string(each.run) == "M8000";
    OneSuper40nc one({.set = is_of_c ? kOfC : Set{}, .program = each.program});
    one.set(each.run, 1);
    one.run(400);
    one.press(each.pause);
    one.run(300);
    EXPECT_FALSE(one.on(each.run)) << each.program;
    EXPECT_EQ(one.on("M8022"), is_of_c);
    const Value stands = one.get("D8117");
    EXPECT_GT(stands, 0);
    EXPECT_LT(stands, 20000);
    EXPECT_FALSE(one.on("M8121"));
    EXPECT_TRUE(one.on("M8120"));
    EXPECT_EQ(one.get("D8170"), 0);
    EXPECT_GT(one.get("D8169"), 0);
    one.run(500);
    EXPECT_EQ(one.get("D8117"), stands);
    one.press("M8103");  // a held axis is taken
    EXPECT_EQ(one.get("D8094"), 21);
    one.set(each.run, 1);
    one.run(1);
    EXPECT_FALSE(one.on("M8022"));
    one.run_while(each.run);
    EXPECT_EQ(one.get("D8117"), each.end[0]) << each.program;
    EXPECT_EQ(one.get("D8217"), each.end[1]) << each.program;
  }
}

TEST(Super40ncPrograms, AClearedContactLetsTheMoveEnd) {
  OneSuper40nc one({.program = "AREA X\nDRV K5000\nDRV K0\nEND\n"});
  one.set("M8100", 1);
  one.run(100);
  one.set("M8100", 0);
  one.run(2000);
  EXPECT_EQ(one.get("D8117"), 5000);
  EXPECT_EQ(one.get("D8100"), 4);
  one.set("M8100", 1);
  one.run(1);
  one.run_while("M8100");
  EXPECT_EQ(one.get("D8117"), 0);
}

TEST(Super40ncPrograms, StopsGiveUpMotionAndPointer) {
  for (const char* stop : {"M8102", "M8584", "M8002"}) {
    OneSuper40nc one({.program = "AREA X\nDRV K500\nDRV K50000\nEND\n"});
    one.set("M8100", 1);
    one.run(600);
    EXPECT_EQ(one.get("D8100"), 4);
    const Value before = one.get("D8117");
    one.set(stop, 1);
    one.run(1);
    EXPECT_EQ(one.get("D8117"), before) << stop;
    EXPECT_FALSE(one.on("M8100"));
    EXPECT_EQ(one.get("D8100"), 0);
    one.set("M8100", 1);
    one.run(2);
    EXPECT_EQ(one.on("M8100"), std::string(stop) == "M8584") << stop;  // a key ends after its edge
  }
}

TEST(Super40ncPrograms, ALimitResetsItsProgramAndItsAxes) {
  OneSuper40nc one({.set = Set{{"D9003", 4}, {"D9185", 3000}},
                    .program = "AREA C\nF K20000\nLIN K10000 K10000\nEND\nAREA U\nTMR K9000\nEND\n"});
  one.set("M8400", 1);
  one.set("M8000", 1);
  one.run(1);
  one.run_while("M8000");
  EXPECT_EQ(one.get("D8140"), 3001);
  EXPECT_NEAR(static_cast<double>(one.get("D8240")), 3001, 15);  // the pulses of a tick
  EXPECT_TRUE(one.on("M8124"));
  EXPECT_EQ(one.get("D8094"), 13);
  EXPECT_EQ(one.get("D8095"), 1);
  EXPECT_EQ(one.get("D8000"), 0);
  EXPECT_FALSE(one.on("M8120") || one.on("M8220"));
  EXPECT_TRUE(one.on("M8400"));  // of another axis
}

TEST(Super40ncPrograms, OverrideActsOnThePathAtOnce) {
  OneSuper40nc one({.set = kOfC, .program = "AREA C\nF K20000\nLIN K90000\nEND\n"});
  one.set("M8000", 1);
  one.run(1000);
  for (const auto& [percent, speed] :
       {std::pair{100, 20000}, std::pair{50, 10000}, std::pair{0, 0}, std::pair{300, 40000}}) {
    one.set("D8005", percent);
    one.run(300);
    EXPECT_NEAR(one.device().axes()->speed_pps(0), speed, 1) << percent;
    EXPECT_FALSE(one.on("M8022"));
  }
  one.run_while("M8000");
  EXPECT_EQ(one.get("D8117"), 90000);
}

TEST(Super40ncPrograms, NoAxisOfAPathPassesItsHighestSpeed) {
  OneSuper40nc one(
      {.set = Set{{"D9003", 4}, {"D9275", 60}}, .program = "AREA C\nF K100000\nLIN K30000 K10000\nEND\n"});
  one.set("M8000", 1);
  one.run(1500);
  EXPECT_NEAR(one.device().axes()->speed_pps(1), 4000, 1);  // 60 rpm
  EXPECT_NEAR(one.device().axes()->speed_pps(0), 12000, 1);
}

TEST(Super40ncPrograms, ProgramsWaitForAnAxisAndThePlcDoesNot) {
  OneSuper40nc one({.program = "AREA X\nDRV K1000\nEND\nAREA PLC\nLD M0\nDRV K500\nEND\n"});
  one.set("M8103", 1);
  one.run(200);
  one.set("M8100", 1);
  one.run(2);
  one.set("M0", 1);
  one.run(5);
  EXPECT_EQ(one.get("D8094"), 21);  // of the PLC's
  EXPECT_TRUE(one.on("M8100"));
  one.set("M8103", 0);
  one.run(1);
  one.run_while("M8100");
  EXPECT_EQ(one.get("D8117"), 1000);
}

TEST(Super40ncPrograms, AStartThatIsRefusedReportsItsLine) {
  struct Case {
    const char* program;
    const char* start;
    Value step;
  };
  for (const auto& [program, start, step] :
       {Case{"AREA X\nRPM K100\nDRV K1000\nEND", "M8100", 1504},
        Case{"AREA X\nVDRV K100\nEND", "M8100", 1500}, Case{"AREA X\nNOP\nMRK K1000\nEND", "M8100", 1501},
        Case{"AREA C\nF K20000\nLIN K1000\nEND", "M8000", 1}}) {
    OneSuper40nc one(
        {.set = {{"D9003", std::string(start) == "M8000" ? 1 : 0}, {"D9190", -100}}, .program = program});
    one.input("X1", 1);
    one.run(2);
    one.set(start, 1);
    one.run(5);
    EXPECT_EQ(one.get("D8094"), 11) << program;
    EXPECT_EQ(one.get("D8095"), step) << program;
    EXPECT_FALSE(one.on(start)) << program;
  }
}

TEST(Super40ncPrograms, AStartOfThePlcThatIsRefusedReportsItsLine) {
  for (const auto& [line, code] : {std::pair{"DRV K1000", 11}, std::pair{"HOM K1", 15}}) {
    OneSuper40nc one({.program = std::string("AREA PLC\nLD M1\n") + line + "\nEND"});
    one.input("X1", 1);
    one.run(2);
    one.set("M1", 1);
    one.run(5);
    EXPECT_EQ(one.get("D8094"), code) << line;
    EXPECT_EQ(one.get("D8095"), 3501) << line;
  }
  OneSuper40nc taken({.program = "AREA PLC\nLD M1\nDRV K1000\nEND"});
  taken.set("M8103", 1);
  taken.run(50);
  taken.set("M1", 1);
  taken.run(5);
  EXPECT_EQ(taken.get("D8094"), 21);
  EXPECT_EQ(taken.get("D8095"), 3501);
}

TEST(Super40ncPrograms, WhatIsOnAtPowerUpIsNoEdge) {
  OneSuper40nc one({.program = "AREA PLC\nLDP X12\nINC D1\nLD X12\nOUT C0 K10\nEND"});
  one.input("X12", 1);
  one.run(5);
  EXPECT_EQ(one.get("D1"), 0);
  EXPECT_EQ(one.get("holding.C0"), 0);
  one.input("X12", 0);
  one.run(5);
  one.input("X12", 1);
  one.run(5);
  EXPECT_EQ(one.get("D1"), 1);
  EXPECT_EQ(one.get("holding.C0"), 1);
}

TEST(Super40ncPrograms, PathFilesAreChangedByD9001) {
  OneSuper40nc one({.set = kOfC, .program = "AREA C\nMOV K1 D0\nEND\nFILE 3\nMOV K3 D0\nEND\n"});
  const auto play = [&] {
    one.set("M8000", 1);
    one.run(3);
    return one.get("D0");
  };
  EXPECT_EQ(play(), 1);
  one.set("D9001", 3);
  one.run(1);
  EXPECT_TRUE(one.on("M8023"));
  one.run(1);
  EXPECT_FALSE(one.on("M8023"));
  EXPECT_EQ(play(), 3);
  one.set("D8002", 0);  // another name of the same
  one.run(2);
  EXPECT_EQ(one.get("D9001"), 0);
  EXPECT_EQ(play(), 1);
  one.set("D9001", 20);
  EXPECT_EQ(one.get("D9001"), 0);
  EXPECT_EQ(one.get("D8094"), 20);
}

TEST(Super40ncPrograms, RecipesAreChangedByD9002) {
  OneSuper40nc one;
  one.set("D500", 5);
  one.set("D999", -7);
  one.set("D9002", 42);
  EXPECT_EQ(one.get("D500"), 0);
  one.set("D900", 9);
  one.set("D9002", 0);
  EXPECT_EQ(one.get("D500"), 5);
  EXPECT_EQ(one.get("D999"), -7);
  EXPECT_EQ(one.get("D900"), 0);
  one.set("D9002", 42);
  EXPECT_EQ(one.get("D900"), 9);
  one.set("D9002", 100);
  EXPECT_EQ(one.get("D9002"), 42);
  EXPECT_EQ(one.get("D8094"), 20);
  one.world().switch_power(0, false);
  one.world().switch_power(0, true);
  EXPECT_EQ(one.get("D900"), 9);
  one.set("D9002", 0);
  EXPECT_EQ(one.get("D500"), 5);
}

TEST(Super40ncPrograms, OutliveThePower) {
  OneSuper40nc one({.program = "AREA X\nDRV K1000\nEND\nAREA PLC\nLD X12\nOUT Y3\nEND\n"});
  const std::string text = one.it().program_text();
  one.world().switch_power(0, false);
  one.run(5);
  one.world().switch_power(0, true);
  EXPECT_EQ(one.it().program_text(), text);
  one.input("X12", 1);
  one.run(2);
  EXPECT_TRUE(one.output("Y3"));
}

TEST(Super40ncPrograms, ThePlcSwitchStopsTheScan) {
  OneSuper40nc one({.program = "AREA PLC\nLD M8003\nINC D0\nEND\n"});
  one.run(10);
  EXPECT_EQ(one.get("D0"), 10);
  one.input("PLC_RUN", 0);
  one.run(10);
  EXPECT_EQ(one.get("D0"), 10);
  one.input("PLC_RUN", 1);
  one.run(5);
  EXPECT_EQ(one.get("D0"), 15);
}

/// A state in the middle of everything continues in the same way.
TEST(Super40ncPrograms, ASnapshotContinuesAsTheOriginal) {
  const Given given{.set = Set{{"D9003", 2}},
                    .program =
                        "AREA C\nF K20000\nLAB K1\nLIN K20000 K10000\nTMR K50\nLIN K0 K0\nJMP K1\nEND\n"
                        "AREA Z\nVDRV K100\nTMR K700\nVDRV K0\nEND\nAREA U\nDRV K9000\nEND\n"
                        "AREA PLC\nLD M8003\nOUT T0 K300\nLD T0\nPJG * * * *\nINC D0\nEND\n"};
  OneSuper40nc one(given);
  for (const char* run : {"M8000", "M8300", "M8400"}) one.set(run, 1);
  for (const Tick at : {1, 137, 600, 1300}) {
    one.run(at - one.now());
    OneSuper40nc other(given);
    other.run(at);
    const auto saved = one.device().save_state();
    other.device().restore_state(saved);
    EXPECT_TRUE(one.device().same_state(other.device()));
    one.run(40);
    other.run(40);
    EXPECT_EQ(one.device().state_hash(), other.device().state_hash()) << at;
  }
}

/// A snapshot runs its own program, whatever has been loaded since.
TEST(Super40ncPrograms, ARestoredSnapshotHasItsOwnPrograms) {
  const auto program = [](int number) {
    const std::string text = std::to_string(number);
    return "AREA C\nMOV K" + text + " D1\nEND\nAREA PLC\nLD M8003\nMOV K" + text + " D2\nEND\n";
  };
  OneSuper40nc one({.program = program(1)});
  const auto first = one.device().save_state();
  one.it().load_program(program(2));
  const auto second = one.device().save_state();
  const auto expect_program = [&](int number) {
    one.set("M8000", 1);
    one.run(3);
    EXPECT_EQ(one.get("D1"), number);
    EXPECT_EQ(one.get("D2"), number);
  };
  expect_program(2);
  for (const int number : {1, 2, 2, 1, 1}) {
    one.device().restore_state(number == 1 ? first : second);
    expect_program(number);
  }
  one.it().load_program("AREA C\nEND\nAREA PLC\nEND\n");
  one.device().restore_state(first);
  expect_program(1);
}

// --- a line that changes the file, or its own program
// --------------------------------------------------------

/// With every instruction that stores, in every area: the line completes, and the next one runs.
TEST(Super40ncPrograms, ALineThatChangesTheFileIsCarriedOut) {
  struct Store {
    const char* line;
    Value file;  // the file that it selects; 2 was selected
  };
  for (const Store& store : {Store{"MOV K1 D9001", 1}, Store{"MOV K1 D8002", 1}, Store{"FMV K1 D9001 K1", 1},
                             Store{"ADD D9001 K2 D9001", 4}, Store{"SUB D9001 K1 D9001", 1},
                             Store{"MUL D9001 K2 D9001", 4}, Store{"DIV D9001 K2 D9001", 1},
                             Store{"INC D9001", 3}, Store{"DEC D9001", 1}, Store{"ZRST D9001 D9001", 0}}) {
    for (const std::string area : {"C", "X", "PLC"}) {
      SCOPED_TRACE(area + ": " + store.line);
      const std::string lines = std::string(store.line) + "\nINC D5\nEND\n";
      std::string program = "AREA " + area + "\n" + (area == "PLC" ? "LDP M10\n" : "") + lines;
      for (int file = 0; file < 5; ++file) program += "FILE " + std::to_string(file) + "\n" + lines;
      OneSuper40nc one({.set = {{"D9001", 2}}, .program = program});
      one.run(2);
      one.set(area == "C" ? "M8000" : area == "X" ? "M8100" : "M10", 1);
      one.run(10);
      EXPECT_EQ(one.get("D9001"), store.file);
      EXPECT_EQ(one.get("D5"), 1);
      EXPECT_EQ(one.get("D8094"), 0);
    }
  }
}

TEST(Super40ncPrograms, ALineContinuesOnlyWhereItsPointerStands) {
  OneSuper40nc reset({.program = "AREA C\nMOV K1 D9001\nINC D5\nEND\nFILE 1\nMOV K1 D9001\nINC D5\nEND\n",
                      .choices = {{"file_change_running", "resets_c"}}});
  reset.set("M8000", 1);
  reset.run(10);
  EXPECT_EQ(reset.get("D9001"), 1);
  EXPECT_EQ(reset.get("D5"), 0);
  EXPECT_EQ(reset.get("D8000"), 0);
  EXPECT_FALSE(reset.on("M8000"));
  EXPECT_EQ(reset.it().state().steps.programs[0].phase, interpreter::super_40nc::Phase::idle);

  OneSuper40nc moved({.program = "AREA C\nMOV K3 D8000\nINC D5\nINC D6\nINC D7\nEND\n",
                      .choices = {{"pointer_write_running", "goes_on_there"}}});
  moved.set("M8000", 1);
  moved.run(10);
  EXPECT_EQ(moved.get("D5"), 0);
  EXPECT_EQ(moved.get("D6"), 1);
  EXPECT_EQ(moved.get("D7"), 1);
}

/// The user table replaces C, and is gone when it ends; the line belongs to X.
TEST(Super40ncPrograms, ALineMayHaveADirectCommandCarriedOut) {
  OneSuper40nc one({.program = "AREA X\nMOV K105 D8020\nINC D5\nMOV K100 D8020\nINC D5\nEND\n",
                    .choices = {{"user_table", "on"}}});
  one.set("M8100", 1);
  one.run(10);
  EXPECT_EQ(one.get("D5"), 2);
  EXPECT_FALSE(one.on("M8100"));
}

}  // namespace programs_test
}  // namespace understudy::emulator::models::super_40nc
