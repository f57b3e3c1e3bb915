// Details: each of the panel's parameters, levels that act once, late comparators, who moves an axis, pauses
// within a ramp.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "emulator/device/model.h"
#include "emulator/device/program_language.h"
#include "interpreter/super_40nc/instructions.h"
#include "tests/emulator/models/super_40nc/one_super40nc.h"
#include "tests/interpreter/facts.h"

namespace understudy::emulator::models::super_40nc {
namespace fine_points_test {

constexpr std::array<const char*, 4> kAxes{"X", "Y", "Z", "U"};

/// The numbers of 《基本參數說明》 and 《X(Y/Z/U)軸參數說明》, in the registers' units.
TEST(Super40ncFinePoints, PanelParametersAreTheManuals) {
  std::map<std::string, const NamedParameterRow*> rows;
  for (const NamedParameterRow& row : model().named_parameters) rows[std::string(row.number)] = &row;
  for (const auto& fact : read_facts(TEST_FACTS "/models/super_40nc/panel_parameters.csv")) {
    const bool is_of_axes = fact.at("number")[0] == 'X';
    for (std::size_t axis = 0; axis < (is_of_axes ? 4U : 1U); ++axis) {
      std::string number = fact.at("number");
      std::string name = fact.at("register");
      if (is_of_axes) {
        number = kAxes[axis] + number.substr(1);
        name.replace(name.find('x'), 1, std::to_string(axis + 1));
      }
      ASSERT_TRUE(rows.contains(number)) << number;
      const NamedParameterRow& row = *rows[number];
      EXPECT_EQ(row.name, name) << number;
      EXPECT_EQ(row.min, fact.at("least")) << number;
      EXPECT_EQ(row.max, fact.at("most")) << number;
      // If the table of D9 has another value, the meaning decides for the panel's; otherwise the factory
      // value is the panel's.
      const std::string reported = "on the panel's page ";
      const std::size_t place = row.meaning.find(reported);
      const bool is_told = place != std::string_view::npos;
      EXPECT_EQ(is_told ? row.meaning.substr(place + reported.size()) : row.factory, fact.at("panel"))
          << number;
      EXPECT_TRUE(!is_told || row.factory != fact.at("panel")) << number << " " << row.factory;
      rows.erase(number);
    }
  }
  EXPECT_TRUE(rows.empty());
}

TEST(Super40ncFinePoints, InstructionsAreReportedFromTheFirst) {
  const auto reported = model().language->instructions();
  ASSERT_EQ(reported.size(), interpreter::super_40nc::kInstructions.size());
  for (std::size_t i = 0; i < reported.size(); ++i) {
    EXPECT_EQ(reported[i].mnemonic, interpreter::super_40nc::kInstructions[i].mnemonic);
    EXPECT_EQ(reported[i].meaning, interpreter::super_40nc::kInstructions[i].meaning);
  }
}

TEST(Super40ncFinePoints, EveryProgramHasItsEndSignal) {
  for (int axis = 0; axis < 4; ++axis) {
    const std::string program = std::string("AREA ") + kAxes[static_cast<std::size_t>(axis)] + "\nEND";
    OneSuper40nc one({.program = program});
    for (int other = 0; other < 4; ++other) one.set("D9" + std::to_string(100 * other + 192), 50);
    one.set("M8" + std::to_string(100 * axis + 100), 1);
    one.run(5);
    for (int other = 0; other < 4; ++other) {
      EXPECT_EQ(one.output("Y" + std::to_string(4 + other)), other == axis) << axis << " " << other;
    }
    one.run(60);
    EXPECT_FALSE(one.output("Y" + std::to_string(4 + axis)));
  }
}

/// M8006 and M8008 act when they come ON, not while they are ON.
TEST(Super40ncFinePoints, RisingContactsActOnce) {
  OneSuper40nc one({.program = "AREA C\nTMR K10000\nEND"});
  one.set("M8008", 1);
  one.run(5);
  one.set("D9179", 77);
  one.run(5);
  EXPECT_EQ(one.get("D9179"), 77);
  one.set("M8000", 1);
  one.run(5);
  one.set("M8006", 1);
  one.run(5);
  EXPECT_FALSE(one.on("M8000"));
  one.set("M8000", 1);
  one.run(5);
  EXPECT_TRUE(one.on("M8000"));
}

/// Comparators 1 and 2 as soft limits of COUNTER2, which is checked at the end of a tick.
TEST(Super40ncFinePoints, SoftLimitsOfAnotherCounterStop) {
  for (const int direction : {+1, -1}) {
    OneSuper40nc one;
    for (const auto& [name, value] : {std::pair{"D9123", 1},
                                      {"D9131", 1},
                                      {"D9132", 6},
                                      {"D9133", 1},
                                      {"D9135", 1},
                                      {"D9136", 6},
                                      {"D9137", 1},
                                      {"D8144", 500},
                                      {"D8145", -500}})
      one.set(name, value);
    one.set(direction > 0 ? "M8103" : "M8104", 1);
    one.run(1000);
    EXPECT_FALSE(one.on("M8120")) << direction;
    EXPECT_EQ(one.get("D8094"), direction > 0 ? 13 : 14);
    EXPECT_NEAR(static_cast<double>(one.get("D8141")), direction * 502.0, 4.0);
  }
}

/// A comparator that is set after its value was passed has not met it.
TEST(Super40ncFinePoints, AComparatorThatComesLateMeetsNothing) {
  for (const int number : {1, 3}) {
    OneSuper40nc one({.set = {{"D9123", 1}}});  // COUNTER2: pulses
    one.set("M8103", 1);
    one.run(300);
    ASSERT_GT(one.get("D8141"), 500);
    one.set(number == 1 ? "D8144" : "D8146", 100);
    one.set(number == 1 ? "D9131" : "D9139", 1);
    one.set(number == 1 ? "D9133" : "D9141", 1);
    one.set(number == 1 ? "D9132" : "D9140", 1);
    one.run(100);
    EXPECT_TRUE(one.on("M8120")) << number;
    EXPECT_EQ(one.get("D8094"), 0) << number;
  }
}

TEST(Super40ncFinePoints, AHomeTakesWhatIsSetForItsStart) {
  for (const Value direction : {1, 3}) {
    OneSuper40nc one;
    one.set("D9100", direction);
    one.set("M8105", 1);
    one.run(100);
    EXPECT_EQ(one.it().pulses_this_tick(0) > 0, direction == 1);
    EXPECT_GT(one.get("D8140"), 0);
  }
}

/// An axis that C's VDRV turns becomes X's with X's own VDRV: the STOP key of C leaves it.
TEST(Super40ncFinePoints, ATurningAxisIsWhoseLineWasLast) {
  for (const bool is_taken_over : {false, true}) {
    OneSuper40nc one({.set = {{"D9003", 1}}, .program = "AREA C\nVDRV K100\nEND\nAREA X\nVDRV K50\nEND"});
    one.set("M8000", 1);
    one.run(300);
    one.set("D9003", 0);
    if (is_taken_over) one.set("M8100", 1);
    one.run(100);
    one.press("M8596");
    EXPECT_EQ(one.on("M8120"), is_taken_over);
  }
}

/// X13 above the speed: it runs at X13 without a ramp, like the chip's FL.
TEST(Super40ncFinePoints, AMotionWithoutARampFeedsAtFl) {
  OneSuper40nc one({.set = {{"D9176", 3000}}, .program = "AREA X\nRPM K100\nDRV K5000\nEND"});
  one.set("M8100", 1);
  one.run(50);
  EXPECT_EQ(one.get("D8164"), 10);
}

/// It continues from its present speed.
TEST(Super40ncFinePoints, APauseThatIsTakenBackInItsRampContinues) {
  OneSuper40nc one({.program = "AREA X\nRPM K500\nDRV K50000\nEND"});
  one.set("M8100", 1);
  one.run(200);
  one.set("M8588", 1);
  one.run(10);
  one.set("M8588", 0);
  const double slowed = one.device().axes()->speed_pps(0);
  EXPECT_LT(slowed, 30'000);
  EXPECT_GT(slowed, 20'000);
  one.set("M8100", 1);
  one.run(2);
  EXPECT_GT(one.device().axes()->speed_pps(0), slowed);
  one.run_while("M8100");
  EXPECT_EQ(one.get("D8117"), 50'000);
}

/// In the text that it names, whatever base the text uses.
TEST(Super40ncFinePoints, APlaceIsALineOfTheText) {
  for (const char* base : {"", " BASE 500", " BASE 0"}) {
    OneSuper40nc one({.program = std::string("AREA X") + base + "\nNOP\nTMR K10000\nEND"});
    one.set("M8100", 1);
    one.run(5);
    std::istringstream text(one.it().program_text());
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    for (const ProgramLocation& place : one.it().program_locations()) {
      if (place.program != "X") continue;
      ASSERT_GT(place.line, 0) << base;
      EXPECT_NE(lines[static_cast<std::size_t>(place.line) - 1].find("TMR"), std::string::npos) << base;
    }
  }
}

/// Observers see why a program stopped, or which line it has skipped, next to its line.
TEST(Super40ncFinePoints, AnObserverSeesWhatWentWrong) {
  using enum ProgramLocation::State;
  struct Case {
    const char* area;
    const char* lines;
    const char* contact;
    ProgramLocation::State state;
    const char* text;
    const char* why;
  };
  for (const Case& it : {
           Case{"X", "NOP\nDRV K100\nEND\n", "M8100", stopped, "DRV K100",
                "D8094 = 16 at step 1501: an axis that this program does not own, by D9003 (C21)"},
           Case{"X", "DRV K100\nTMR K9999\nEND\n", "M8100", waiting, "TMR K9999",
                "D8094 = 16 at step 1500: an axis that this program does not own, by D9003 (C21)"},
           Case{"C", "CW K500 K0 K70 K0\nEND\n", "M8000", stopped, "CW K500 K0 K70 K0",
                "D8094 = 17 at step 0: an impossible arc"},
           Case{"U", "NOP\nJMP K5\nEND\n", "M8400", failed, "JMP K5",
                "D8094 = 3 at step 3001: a label that does not exist"},
           Case{"U", "NOP\nEND\n", "M8400", stopped, "", ""},
       }) {
    OneSuper40nc one(
        {.set = {{"D9003", 2}, {"D9016", 0}}, .program = std::string("AREA ") + it.area + "\n" + it.lines});
    one.set(it.contact, 1);
    one.run(5);
    const std::vector<ProgramLocation> program_locations = one.it().program_locations();
    ASSERT_EQ(program_locations.size(), 1U);
    EXPECT_EQ(program_locations[0].state, it.state) << it.lines;
    EXPECT_EQ(program_locations[0].text, it.text) << it.lines;
    EXPECT_EQ(program_locations[0].why, it.why) << it.lines;
    EXPECT_EQ(program_locations[0].line > 0, *it.text != 0) << it.lines;
  }
}

/// A limit is reported for the program that it stops, not for an axis at rest or a jog; M8002 stops
/// everything.
TEST(Super40ncFinePoints, AnObserverSeesWhatStoppedAProgram) {
  OneSuper40nc one({.program = "AREA C\nNOP\nEND\nAREA X\nDRV K90000\nEND\n"});
  const auto why = [&](std::size_t program) { return one.it().program_locations().at(program).why; };
  one.set("M8100", 1);
  one.run(50);
  one.input("X1", true);
  one.run(5);
  EXPECT_EQ(why(0), "");
  EXPECT_EQ(why(1), "D8094 = 11 at step 1500: the positive limit");
  EXPECT_EQ(one.it().program_locations().at(1).state, ProgramLocation::State::failed);
  one.set("M8103", 1);
  one.run(5);
  EXPECT_EQ(one.get("D8094"), 11);
  EXPECT_EQ(why(0) + why(1), "");
  one.set("M8002", 1);
  one.run(5);
  EXPECT_EQ(why(0), "D8094 = 19: M8002, emergency stop");
  EXPECT_EQ(why(1), why(0));
}

/// If a new zero has moved a target during the move, the target is not the base of the next move: the present
/// position is.
TEST(Super40ncFinePoints, APositionSetOnTheWayIsTheNextBase) {
  for (const char* line : {"DRV", "LIN"}) {
    for (const char* set : {"PSET K0", "MOV K0 D8117", "MOV K0 D8140"}) {
      const std::string program = std::string(line) == "DRV"
                                      ? "AREA X\nRPM K200\nDRV K10000\nINCC\nDRV K100\nEND\n"
                                      : "AREA C\nF K10000\nLIN K10000\nINCC\nLIN K100\nEND\n";
      OneSuper40nc one({.set = {{"D9003", std::string(line) == "DRV" ? 0 : 1}},
                        .program = program + "AREA PLC\nLDP M1\nMOV D8117 D10\n" + set + "\nEND"});
      const char* const contact = std::string(line) == "DRV" ? "M8100" : "M8000";
      one.set(contact, 1);
      one.run(300);
      one.set("M1", 1);
      one.run_while(contact);
      EXPECT_GT(one.get("D10"), 1000) << line << " " << set;
      EXPECT_EQ(one.get("D8117"), 10'100 - one.get("D10")) << line << " " << set;
    }
  }
}

/// It was never in memory, so leaving its number does not save an empty one, whatever the capacity is by
/// then.
TEST(Super40ncFinePoints, AFileThatWasTooLongIsFoundAgain) {
  for (const bool loses_power : {false, true}) {
    OneSuper40nc one({.program = "AREA C\nEND\nFILE 1\nINC D1\nINC D1\nINC D1\nINC D1\nEND"});
    one.set("D9045", 3);
    one.set("D9001", 1);
    EXPECT_EQ(one.get("D8094"), 10);
    one.run(5);
    if (loses_power) one.world().switch_power(0, false);
    if (loses_power) one.world().switch_power(0, true);
    one.set("D9045", 1500);
    one.set("D9001", 0);
    one.run(5);
    one.set("D9001", 1);
    one.run(5);
    one.set("M8000", 1);
    one.run(5);
    EXPECT_EQ(one.get("D1"), 4) << loses_power;
  }
}

TEST(Super40ncFinePoints, DevicesDifferByOneRegister) {
  OneSuper40nc a;
  OneSuper40nc b;
  EXPECT_TRUE(a.it().same_state(b.it()));
  b.set("D7", 1);
  EXPECT_FALSE(a.it().same_state(b.it()));
}

}  // namespace fine_points_test
}  // namespace understudy::emulator::models::super_40nc
