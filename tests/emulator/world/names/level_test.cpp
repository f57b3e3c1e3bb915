// Levels of inputs as people write them.
#include "emulator/world/names/level.h"

#include <gtest/gtest.h>

#include <vector>

namespace understudy::emulator::world {
namespace level_test {

using Kind = TerminalRow::Kind;

TEST(Level, OfADigitalInputIsOnOrOff) {
  for (const Kind kind : {Kind::digital_in, Kind::dip_switch}) {
    for (const char* text : {"on", "true", "1", "0x1"}) EXPECT_EQ(parse_level(text, kind), 1) << text;
    for (const char* text : {"off", "false", "0", "-0"}) EXPECT_EQ(parse_level(text, kind), 0) << text;
    for (const char* text : {"", "On", "ON", "yes", "high", "1.0", "on ", " on", "+1", "1V", "0mV", "V"}) {
      EXPECT_EQ(parse_level(text, kind), std::nullopt) << text;
    }
    EXPECT_EQ(parse_level("2", kind), 2) << "a number; other code checks whether the input accepts it";
    EXPECT_EQ(level_example(kind), "on or off");
  }
}

TEST(Level, OfAnAnalogInputIsAVoltage) {
  struct Case {
    const char* text;
    std::int64_t millivolts;
  };
  for (const auto& [text, millivolts] : std::vector<Case>{{"0V", 0},
                                                          {"0.000V", 0},
                                                          {"1V", 1000},
                                                          {"10V", 10'000},
                                                          {"2.5V", 2500},
                                                          {"2.50V", 2500},
                                                          {"2.05V", 2050},
                                                          {"2.005V", 2005},
                                                          {"0.001V", 1},
                                                          {"9.999V", 9999},
                                                          {"02.5V", 2500},
                                                          {"999999V", 999'999'000},
                                                          {"2500mV", 2500},
                                                          {"0mV", 0},
                                                          {"-5mV", -5},
                                                          {"2500", 2500},
                                                          {"0x10", 16},
                                                          {"-1", -1}}) {
    EXPECT_EQ(parse_level(text, Kind::analog_in), millivolts) << text;
  }
  for (const char* text : {"",
                           "V",
                           "mV",
                           ".5V",
                           "5.V",
                           ".V",
                           "2,5V",
                           "2.5",
                           "-2.5V",
                           "-2V",
                           "+2V",
                           "2.5 V",
                           " 2.5V",
                           "2.5v",
                           "2.5W",
                           "2.0005V",
                           "1.2.3V",
                           "1..2V",
                           "1e1V",
                           "0x1.5V",
                           "2.-5V",
                           "1.5mV",
                           "on",
                           "true",
                           "1000000V",
                           "99999999999999999999V",
                           "99999999999999999999mV",
                           "2.5Vm",
                           "2.5VV"}) {
    EXPECT_EQ(parse_level(text, Kind::analog_in), std::nullopt) << text;
  }
  EXPECT_EQ(level_example(Kind::analog_in), "a voltage such as 2.5V");
}

}  // namespace level_test
}  // namespace understudy::emulator::world
