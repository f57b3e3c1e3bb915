// SUPER-40NC on its two lines: stations, functions, halves, and the frames that its manual prints.
#include <gtest/gtest.h>

#include "tests/emulator/models/super_40nc/one_super40nc.h"
#include "tests/interpreter/facts.h"

namespace understudy::emulator::models::super_40nc {
namespace wire_test {

constexpr std::size_t kRs232 = OneSuper40nc::kRs232;
constexpr std::size_t kRs485 = OneSuper40nc::kRs485;

/// 33 of the 34 printed checksums are right.
TEST(Super40ncWire, PrintedFramesAreServed) {
  int served = 0;
  int dropped = 0;
  for (const Fact& fact : read_facts(TEST_FACTS "/models/super_40nc/printed_frames.csv")) {
    if (fact.at("checksum") == "none") continue;
    OneSuper40nc one;
    const world::Bytes frame = world::hex(fact.at("frame"));
    one.send_raw(kRs232, frame);
    const std::string reply = one.came(kRs232);
    if (fact.at("checksum") == "no") {
      EXPECT_EQ(reply, "");
      EXPECT_EQ(one.get("D8097"), 1);
      EXPECT_EQ(one.get("D8098"), 0);
      ++dropped;
      continue;
    }
    const std::string request = world::text(std::span(frame).first(frame.size() - 2));
    EXPECT_EQ(reply, frame[1] == 0x03 ? "00 03 04 00 00 00 00" : request);  // otherwise an echo
    ++served;
  }
  EXPECT_EQ(served, 33);
  EXPECT_EQ(dropped, 1);
}

TEST(Super40ncWire, PrintedReadsHaveTheirPrintedReplies) {
  OneSuper40nc one;
  const world::Bytes printed = world::hex("CD 6B B2 0E 1B");
  for (int i = 0; i < 37; ++i) one.set("M" + std::to_string(i), printed[i / 8] >> (i % 8) & 1);
  EXPECT_EQ(one.ask(kRs232, "00 01 03 E8 00 25"), "00 01 05 CD 6B B2 0E 1B");
  const world::Bytes inputs = world::hex("AC DB 35");
  for (int i = 0; i < 24; ++i) one.input("X" + std::to_string(i), inputs[i / 8] >> (i % 8) & 1);
  one.run(1);
  EXPECT_EQ(one.ask(kRs485, "00 02 00 00 00 18"), "00 02 03 AC DB 35");
  EXPECT_EQ(one.ask(kRs485, "00 02 00 01 00 15"), "00 02 03 D6 ED 1A");  // as printed
  one.set("D53", 0x22B);
  EXPECT_EQ(one.ask(kRs232, "00 03 00 6A 00 02"), "00 03 04 02 2B 00 00");
  EXPECT_EQ(one.ask(kRs232, "00 10 07 D0 00 04 08 00 0A 01 02 09 0B 07 08"), "00 10 07 D0 00 04");
  EXPECT_EQ(one.get("holding.T0"), 0x0102000A);
  EXPECT_EQ(one.get("holding.T1"), 0x0708090B);
}

TEST(Super40ncWire, StationNumberChangesAfterItsReply) {
  OneSuper40nc one;
  EXPECT_EQ(one.ask(kRs232, "00 06 23 28 00 05"), "00 06 23 28 00 05");
  EXPECT_EQ(one.ask(kRs232, "05 03 23 28 00 02"), "05 03 04 00 05 00 00");
  EXPECT_EQ(one.ask(kRs485, "05 05 07 D0 FF 00"), "05 05 07 D0 FF 00");
  EXPECT_EQ(one.ask(kRs232, "00 06 00 00 00 07"), "");  // a broadcast: obeyed silently
  EXPECT_EQ(one.get("D0"), 7);
  EXPECT_EQ(one.ask(kRs232, "04 06 00 00 00 08"), "");
  EXPECT_EQ(one.get("D0"), 7);
}

TEST(Super40ncWire, FunctionsAndHolesAreRefusedByNumber) {
  struct Case {
    const char* request;
    const char* reply;
  };
  const Case cases[] = {{"00 04 00 00 00 01", "00 84 01"},
                        {"00 07", "00 87 01"},
                        {"00 01 00 20 00 01", "00 81 02"},
                        {"00 01 00 1F 00 02", "00 81 02"},
                        {"00 01 01 47 00 01", "00 01 01 00"},
                        {"00 01 01 48 00 01", "00 81 02"},
                        {"00 02 00 30 00 01", "00 82 02"},
                        {"00 03 08 50 00 01", "00 83 02"},
                        {"00 03 20 08 00 01", "00 83 02"},
                        {"00 03 27 0F 00 01", "00 03 02 00 00"},
                        {"00 03 27 10 00 01", "00 83 02"},
                        {"00 03 00 00 00 7E", "00 83 03"},
                        {"00 05 00 20 FF 00", "00 85 02"},
                        {"00 05 00 00 12 34", "00 85 03"},
                        {"00 0F 00 00 00 0A 02 01 02", "00 0F 00 00 00 0A"}};
  for (const auto& [request, reply] : cases) {
    OneSuper40nc one;
    EXPECT_EQ(one.ask(kRs485, request), reply) << request;
  }
}

TEST(Super40ncWire, AHalfIsWrittenAlone) {
  OneSuper40nc one;
  one.set("D10", -1);
  EXPECT_EQ(one.ask(kRs232, "00 06 00 14 00 05"), "00 06 00 14 00 05");
  EXPECT_EQ(one.get("D10"), -65531);  // FFFF 0005
  EXPECT_EQ(one.ask(kRs232, "00 06 00 15 00 00"), "00 06 00 15 00 00");
  EXPECT_EQ(one.get("D10"), 5);
}

TEST(Super40ncWire, ReadOnlyItemsAnswerAndIgnore) {
  OneSuper40nc one;
  EXPECT_EQ(one.ask(kRs232, "00 05 07 D3 00 00"), "00 05 07 D3 00 00");  // M8003
  EXPECT_TRUE(one.on("M8003"));
  // D8098, D8099 and behind them a register that can be written.
  EXPECT_EQ(one.ask(kRs232, "00 10 1C 1C 00 04 08 00 09 00 00 00 09 00 00"), "00 10 1C 1C 00 04");
  EXPECT_EQ(one.get("D8098"), 0);
  EXPECT_EQ(one.get("D8099"), 100);
}

TEST(Super40ncWire, ErrorsAreCountedByThePort) {
  OneSuper40nc one;
  one.send_raw(kRs485, world::hex("00 03 00 00 00 02 00 00"));
  one.send_raw(kRs485, world::hex("00 03 00 00 00 02 00 01"));
  one.send_raw(kRs232, world::hex("00 03 00 00 00 02 00 00"));
  EXPECT_EQ(one.get("D8097"), 1);
  EXPECT_EQ(one.get("D8098"), 2);
}

TEST(Super40ncWire, ValuesBeyondTheirRangeAreStored) {
  OneSuper40nc one;
  one.set("D9153", 12);
  EXPECT_EQ(one.get("D9153"), 12);
  one.set("D9170", -5);  // pulses per revolution: 200 in use
  EXPECT_EQ(one.get("D9170"), -5);
  one.set("M8103", 1);
  one.run(1010);  // 50 rpm
  EXPECT_NEAR(static_cast<double>(one.get("D8117")), 50.0 * 200 / 60, 2);
}

}  // namespace wire_test
}  // namespace understudy::emulator::models::super_40nc
