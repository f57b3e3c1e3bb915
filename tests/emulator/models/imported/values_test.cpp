// Values that hosts write to described registers: binary-coded decimals, and halves of 32 bits.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "emulator/world/stations/server.h"
#include "tests/emulator/models/imported/one_described.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::models::imported {
namespace values_test {

struct Case {
  std::string_view request;
  std::string_view reply;
};

const std::string kDecimals =
    "address,name,type,min,max,default,access\n"
    "0,A,bcd,10,2000,100,R/W\n"
    "1,B,bcd32,,,12345678,R/W\n"
    "3,C,bcd,,,,R/W\n"
    "4,D,bcd,,,,R/W\n"
    "5,PLAIN,u16,,,,R/W\n"
    "6,STATUS,u16,,,,R\n";

TEST(ImportedValues, OfBinaryCodedDecimalsHaveDigitsOnly) {
  const Case kCases[] = {
      {"03 00 00 00 03", "03 06 01 00 12 34 56 78"},
      {"06 00 00 20 00", "06 00 00 20 00"},
      {"06 00 00 20 01", "86 03"},  // 2001
      {"06 00 00 00 09", "86 03"},  // 9
      {"06 00 00 1A BC", "86 03"},
      {"06 00 00 00 AB", "86 03"},
      {"06 00 01 00 0A", "86 03"},
      {"10 00 01 00 02 04 99 99 99 99", "10 00 01 00 02"},
      {"10 00 01 00 02 04 00 00 F0 00", "90 03"},
      {"10 00 00 00 03 06 00 11 00 22 0A 00", "90 03"},
      {"03 00 00 00 03", "03 06 20 00 99 99 99 99"},  // the refused ones have written nothing
      {"16 00 03 00 00 00 0C", "96 03"},
      {"06 00 05 AB CD", "06 00 05 AB CD"},  // not a decimal register
  };
  OneDescribed it(model_file::model_with(kDecimals, "line: { functions: [3, 6, 16, 22] }\n"));
  for (const Case& one : kCases)
    EXPECT_EQ(world::answer(it.device(), world::hex(one.request)), one.reply) << one.request;
  OneDescribed stored(model_file::model_with(kDecimals, "map: { out_of_range: stored }\n"));
  EXPECT_EQ(world::answer(stored.device(), world::hex("06 00 00 1A BC")), "06 00 00 1A BC");
}

TEST(ImportedValues, OfBinaryCodedDecimalsMoveAxes) {
  OneDescribed it(model_file::model_with(
      kDecimals,
      "axes: { M: { target: A, speed: 5000, start: C == 12, position: D, busy: STATUS.0 } }\n"
      "shows: { STATUS.1: A == 100 }\n"));
  EXPECT_EQ(it.read("STATUS"), 2);
  EXPECT_EQ(world::answer(it.device(), world::hex("06 00 03 00 0C")), "86 03");
  EXPECT_EQ(world::answer(it.device(), world::hex("06 00 03 00 12")), "06 00 03 00 12");
  it.advance(1000);
  EXPECT_EQ(it.read("STATUS"), 2);
  EXPECT_EQ(world::answer(it.device(), world::hex("03 00 04 00 01")), "03 02 01 00");
  EXPECT_EQ(world::answer(it.device(), world::hex("06 00 04 02 50")), "06 00 04 02 50");
  EXPECT_EQ(world::answer(it.device(), world::hex("03 00 04 00 01")), "03 02 02 50");
}

struct HalfCase {
  std::string_view halves;
  std::string_view reply;    // to `06 0000 7FFF`, which makes 2147418112 of the whole
  std::string_view allowed;  // to `06 0000 0001`, which makes 65536
  std::string_view real;     // to `06 0002 7FC0`, which makes NaN
  std::string_view tail;     // to function 10 from the middle of T to the middle of F
};

TEST(ImportedValues, OfHalvesAreJudgedAsTheModelSays) {
  const std::string list = "address,name,type,min,max,default\n0,T,s32,-100000,100000,0\n2,F,f32,-1,1,0\n";
  const HalfCase kCases[] = {
      {"alone", "06 00 00 7F FF", "06 00 00 00 01", "06 00 02 7F C0", "10 00 01 00 02"},
      {"judged", "86 03", "06 00 00 00 01", "86 03", "90 03"},
      {"whole", "86 02", "86 02", "86 02", "90 02"},
  };
  for (const HalfCase& one : kCases) {
    const std::string more = "map: { halves: " + std::string(one.halves) + " }\n";
    OneDescribed it(model_file::model_with(list, more));
    const auto ask = [&](std::string_view pdu) { return world::answer(it.device(), world::hex(pdu)); };
    EXPECT_EQ(ask("06 00 00 7F FF"), one.reply) << one.halves;
    EXPECT_EQ(ask("10 00 00 00 02 04 00 00 00 00"), "10 00 00 00 02") << one.halves;
    EXPECT_EQ(ask("10 00 00 00 02 04 7F FF 00 00"), "90 03") << one.halves;
    EXPECT_EQ(ask("06 00 00 00 01"), one.allowed) << one.halves;
    EXPECT_EQ(ask("06 00 02 7F C0"), one.real) << one.halves;
    EXPECT_EQ(ask("10 00 01 00 02 04 00 00 7F C0"), one.tail) << one.halves;
  }
}

}  // namespace values_test
}  // namespace understudy::emulator::models::imported
