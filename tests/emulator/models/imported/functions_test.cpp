// Functions beyond plain reads and writes, and the orders of words and bytes that rows may have.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "emulator/world/stations/server.h"
#include "tests/emulator/models/imported/one_described.h"
#include "tests/emulator/world/stations/pdus.h"

namespace understudy::emulator::models::imported {
namespace functions_test {

const std::string kList =
    "address,name,access,type,order,min,max,default\n"
    "0,FLAGS,R/W,u16,,,,0x0012\n"
    "1,LEVEL,R/W,u16,,0,100,7\n"
    "2,SERIAL,R,u16,,,,0x1234\n"
    "3,SWAPPED,R/W,u16,ba,,,0x0102\n"
    "4,PLAIN,R/W,u32,,,,0x01020304\n"
    "6,LOW_FIRST,R/W,u32,cdab,,,0x01020304\n"
    "8,BADC,R/W,u32,badc,,,0x01020304\n"
    "10,DCBA,R/W,u32,dcba,,,0x01020304\n";
const std::string kLine =
    "line: { functions: [3, 6, 8, 16, 17, 22, 23, 43], most: { 23: 8 }, server_id: me,\n"
    "        identity: { vendor: V, product: P, revision: R1, model_name: M } }\n";

struct Served {
  OneDescribed world{model_file::model_with(kList, kLine)};
  std::string ask(std::string_view pdu) { return world::answer(world.device(), world::hex(pdu)); }
};

struct Case {
  std::string_view request;
  std::string_view reply;
};

TEST(ImportedFunctions, AnswerAsTheStandardSays) {
  const Case kCases[] = {
      {"08 00 00 A5 37", "08 00 00 A5 37"},  // 6.8: the request itself
      {"08 00 00", "08 00 00"},
      {"08 00 01 00 00", "88 01"},
      {"08 00", "88 03"},
      {"11", "11 03 6D 65 FF"},
      {"11 00", "91 03"},
      {"16 00 00 00 F2 00 25", "16 00 00 00 F2 00 25"},  // 6.16: 0x12 becomes 0x17
      {"03 00 00 00 01", "03 02 00 17"},
      {"16 00 01 FF 00 00 65", "96 03"},  // 101 is out of range
      {"16 00 02 00 00 00 00", "96 02"},
      {"16 00 20 00 00 00 00", "96 02"},
      {"16 00 00 00 F2", "96 03"},
      {"17 00 00 00 02 00 01 00 01 02 00 09", "17 04 00 17 00 09"},  // it writes first
      {"17 00 20 00 01 00 01 00 01 02 00 0A", "97 02"},
      {"17 00 00 00 01 00 01 00 01 02 00 65", "97 03"},
      {"17 00 00 00 09 00 01 00 01 02 00 0A", "97 03"},
      {"17 00 00 00 01 00 01 00 02 02 00 0A", "97 03"},
      {"17 00 00 00 01 00 01 00 00 00", "97 03"},
      {"17 00 00 00", "97 03"},
      {"03 00 01 00 01", "03 02 00 09"},  // the refused ones have written nothing
      {"2B 0E 01 00", "2B 0E 01 82 00 00 03 00 01 56 01 01 50 02 02 52 31"},
      {"2B 0E 02 03", "2B 0E 02 82 00 00 04 00 01 56 01 01 50 02 02 52 31 05 01 4D"},
      {"2B 0E 04 05", "2B 0E 04 82 00 00 01 05 01 4D"},
      {"2B 0E 04 03", "AB 02"},
      {"2B 0E 05 00", "AB 03"},
      {"2B 0D 01 00", "AB 01"},
      {"2B 0E 01", "AB 03"},
      {"18 00 00", "98 01"},
  };
  Served it;
  for (const Case& one : kCases) EXPECT_EQ(it.ask(one.request), one.reply) << one.request;
}

TEST(ImportedFunctions, AreUnknownUnlessListed) {
  OneDescribed world{model_file::model_with(kList, "")};
  for (const std::string_view pdu : {"08 00 00", "11", "16 00 00 00 F2 00 25", "2B 0E 01 00"}) {
    const std::string reply = world::answer(world.device(), world::hex(pdu));
    EXPECT_EQ(reply.substr(2), " 01") << reply;
  }
}

TEST(ImportedOrders, BelongToTheirRows) {
  Served it;
  EXPECT_EQ(it.ask("03 00 03 00 09"), "03 12 02 01 01 02 03 04 03 04 01 02 02 01 04 03 04 03 02 01");
  EXPECT_EQ(it.world.read("SWAPPED"), 0x0102);
  for (const char* const name : {"PLAIN", "LOW_FIRST", "BADC", "DCBA"})
    EXPECT_EQ(it.world.read(name), 0x01020304) << name;
  EXPECT_EQ(it.world.read("LOW_FIRST_H"), 0x0102);
  it.ask("10 00 03 00 09 12 12 11 11 12 13 14 13 14 11 12 12 11 14 13 14 13 12 11");
  EXPECT_EQ(it.world.read("SWAPPED"), 0x1112);
  for (const char* const name : {"PLAIN", "LOW_FIRST", "BADC", "DCBA"})
    EXPECT_EQ(it.world.read(name), 0x11121314) << name;
  it.world.write("BADC", 0x21222324);
  it.world.write("DCBA_L", 0x3132);
  it.world.write("SWAPPED", 0x4142);
  EXPECT_EQ(it.ask("03 00 08 00 04"), "03 08 22 21 24 23 32 31 12 11");
  EXPECT_EQ(it.ask("03 00 03 00 01"), "03 02 42 41");
  EXPECT_EQ(it.ask("06 00 0A 31 51"), "06 00 0A 31 51");  // one word alone
  EXPECT_EQ(it.world.read("DCBA"), 0x11125131);
}

}  // namespace functions_test
}  // namespace understudy::emulator::models::imported
