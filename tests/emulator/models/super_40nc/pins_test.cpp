// Terminals that exist only by choice (pins.cpp), and the parameters that use them.
#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/one_super40nc.h"

namespace understudy::emulator::models::super_40nc {
namespace pins_test {

Given with_pins(std::vector<std::pair<std::string, Value>> set = {}, const std::string& program = "") {
  return {.set = std::move(set), .program = program, .choices = {{"pins_fitted", "also_clr_ltc_and_erc"}}};
}

TEST(Super40ncPins, AreThereWhereTheyAreChosen) {
  const std::pair<std::string, std::string> kChosen[] = {{"dog_inputs", "terminals_of_their_own"},
                                                         {"analog_counts", "5_v"},
                                                         {"servo_on", "an_output_per_axis"},
                                                         {"pins_fitted", "also_clr_ltc_and_erc"}};
  const std::vector<std::vector<const char*>> kNames{
      {"DOG_X", "DOG_U"}, {"Vin1", "Vin3"}, {"SVON_X", "SVON_U"}, {"CLR_X", "LTC_Y", "ERC_U"}};
  for (std::size_t chosen = 0; chosen < kNames.size(); ++chosen) {
    OneSuper40nc one({.choices = {kChosen[chosen]}});
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      for (const char* const name : kNames[i]) {
        const bool is_present = one.device().terminals()->has_terminal(find_terminal(model(), name));
        EXPECT_EQ(is_present, i == chosen) << name << " with " << kChosen[chosen].first;
      }
    }
    EXPECT_TRUE(one.device().terminals()->has_terminal(find_terminal(model(), "PLC_RUN")));
  }
}

/// D9x09: CLR at its rising or falling edge, while it is ON, while it is OFF; D9x27: of which counters.
TEST(Super40ncPins, ClrClearsTheCountersThatAreNamed) {
  struct Case {
    Value mode;
    bool at_on, while_on, at_off, while_off;  // whether COUNTER1 is 0 then
  };
  for (const Case& each : {Case{0, true, false, false, false}, Case{1, false, false, true, false},
                           Case{2, true, true, false, false}, Case{3, false, false, true, true}}) {
    OneSuper40nc one(with_pins({{"D9109", each.mode}, {"D9127", 1}}));
    one.run(3);
    const auto is_cleared = [&] {
      const bool zero = one.get("D8140") == 0;
      one.set("D8140", 50);
      one.set("D8143", 60);
      return zero;
    };
    (void)is_cleared();
    one.input("CLR_X", 1);
    one.run(1);
    EXPECT_EQ(one.on("M8152"), true);
    EXPECT_EQ(is_cleared(), each.at_on) << each.mode;
    one.run(2);
    EXPECT_EQ(is_cleared(), each.while_on) << each.mode;
    EXPECT_EQ(one.get("D8143"), 60) << "is not named";
    one.input("CLR_X", 0);
    one.run(1);
    EXPECT_EQ(is_cleared(), each.at_off) << each.mode;
    one.run(2);
    EXPECT_EQ(is_cleared(), each.while_off) << each.mode;
  }
}

TEST(Super40ncPins, LtcLatchesAtItsEdgeIfD9x50SaysSo) {
  for (const Value source : {0, 1}) {
    OneSuper40nc one(with_pins({{"D9150", source}}));
    one.run(3);
    one.set("D8140", 50);
    one.input("LTC_X", 1);
    one.run(2);
    EXPECT_TRUE(one.on("M8153"));
    EXPECT_EQ(one.get("D8165"), source == 0 ? 50 : 0);
    one.set("D8140", 80);
    one.run(5);
    EXPECT_EQ(one.get("D8165"), source == 0 ? 50 : 0) << "an edge, not a level";
  }
}

/// D9x04, D9x06: ERC after a stop without a ramp, for its time.
TEST(Super40ncPins, ErcComesBehindASuddenStop) {
  struct Case {
    Value automatic, by_ramp, width;
    int ticks;  // the time for which it is ON
  };
  for (const Case& each : {Case{1, 0, 4, 13}, Case{1, 0, 0, 1}, Case{1, 0, 6, 104}, Case{0, 0, 4, 0},
                           Case{1, 1, 4, 0}, Case{1, 0, 7, 200}}) {
    OneSuper40nc one(with_pins({{"D9104", each.automatic}, {"D9101", each.by_ramp}, {"D9106", each.width}},
                               "AREA X\nRPM K100\nDRV K50000\nEND\n"));
    one.set("M8100", 1);
    one.run(100);
    one.input("X1", 1);
    int ticks = 0;
    for (int i = 0; i < 200; ++i) {
      one.run(1);
      ticks += one.output("ERC_X") ? 1 : 0;
      EXPECT_EQ(one.output("ERC_X"), one.on("M8149"));
    }
    EXPECT_EQ(ticks, each.ticks) << each.automatic << each.by_ramp << each.width;
    one.set("M8104", 1);
    one.run(3);
    EXPECT_FALSE(one.output("ERC_X")) << "a level ends with the next start";
  }
}

/// An alarm stops as D9x03 says, CEMG always at once; D9x04 applies to both.
TEST(Super40ncPins, ErcComesBehindAlarmsAndCemg) {
  for (const char* const input : {"ALM_X", "CEMG"}) {
    const bool is_alarm = input[0] == 'A';
    for (const Value automatic : {0, 1}) {
      for (const Value by_ramp : {0, 1}) {
        OneSuper40nc one(with_pins({{"D9104", automatic}, {"D9103", by_ramp}, {"D9101", 1 - by_ramp}},
                                   "AREA X\nRPM K100\nDRV K50000\nEND\n"));
        one.set("M8100", 1);
        one.run(100);
        one.input(input, 1);
        bool came = false;
        for (int i = 0; i < 100; ++i) {
          one.run(1);
          came = came || one.output("ERC_X");
        }
        EXPECT_EQ(came, automatic == 1 && (!is_alarm || by_ramp == 0)) << input << automatic << by_ramp;
        EXPECT_FALSE(one.output("ERC_Y")) << "Y stood";
      }
    }
  }
}

/// D9x05: at the end of homing.
TEST(Super40ncPins, ErcComesWhenHomeIsFound) {
  for (const Value automatic : {0, 1}) {
    OneSuper40nc one(with_pins({{"D9105", automatic}, {"D9121", 0}}));
    one.run(3);
    one.set("M8105", 1);
    one.run(50);
    one.input("X0", 1);
    bool came = false;
    for (int i = 0; i < 300; ++i) {
      one.run(1);
      came = came || one.output("ERC_X");
    }
    EXPECT_TRUE(one.on("M8195"));
    EXPECT_EQ(came, automatic == 1);
  }
}

TEST(Super40ncPins, WithoutThemNothingOfThemActs) {
  OneSuper40nc one({.set = {{"D9109", 2}, {"D9127", 15}, {"D9150", 0}}});
  one.run(3);
  one.set("D8140", 50);
  one.input("CLR_X", 1);
  one.input("LTC_X", 1);
  one.run(5);
  EXPECT_EQ(one.get("D8140"), 50);
  EXPECT_EQ(one.get("D8165"), 0);
  EXPECT_FALSE(one.on("M8152"));
  EXPECT_FALSE(one.on("M8153"));
}

}  // namespace pins_test
}  // namespace understudy::emulator::models::super_40nc
